//! A balanced tree of bounding boxes: which pairs of boxes meet, and which boxes meet a given one.
//!
//! Built top-down by splitting at the median of the longer side of the centres; depth is at most log2 n whatever the
//! input. Cost: O(n log n) to build, 80 bytes per box. Queries are paid for in [`Work`], so that no input can make
//! them run for long.

use crate::Bounds;
use std::ops::ControlFlow;

/// Boxes in one leaf.
const LEAF_SIZE: usize = 8;

/// Subtrees larger than this ask whether to go on before they are split.
const ITEMS_PER_QUESTION: usize = 4096;

/// Units of work between two questions whether to go on: well under a millisecond.
const UNITS_PER_QUESTION: u64 = 1 << 14;

/// What a search may still spend, counted in box tests, as long as its caller wants it to go on.
pub(crate) struct Work<'a> {
    left: u64,
    ask_at: u64,
    go_on: &'a dyn Fn() -> bool,
}

impl<'a> Work<'a> {
    pub(crate) fn new(limit: u64, go_on: &'a dyn Fn() -> bool) -> Self {
        Self { left: limit, ask_at: limit, go_on }
    }

    /// The question whether to go on.
    pub(crate) fn question(&self) -> &'a dyn Fn() -> bool {
        self.go_on
    }

    /// Spends `units`; breaks when they are not there.
    #[inline]
    pub(crate) fn spend(&mut self, units: u64) -> ControlFlow<()> {
        if self.left < units {
            self.left = 0;
            return ControlFlow::Break(());
        }
        self.left -= units;
        if self.left <= self.ask_at {
            self.ask_at = self.left.saturating_sub(UNITS_PER_QUESTION);
            if !(self.go_on)() {
                self.left = 0;
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    /// Whether a search was broken off: for want of work, or because nobody wants it any more.
    pub(crate) fn is_spent(&self) -> bool {
        self.left == 0
    }
}

struct Node {
    bounds: Bounds,
    first: usize,
    last: usize,
    /// The right child; the left one follows its parent. Absent in a leaf.
    right: Option<usize>,
}

/// The tree. Items are the indices of the boxes that it was built from.
pub(crate) struct BoxTree {
    items: Vec<u32>,
    /// In the order of `items`.
    boxes: Vec<Bounds>,
    nodes: Vec<Node>,
}

impl BoxTree {
    /// The tree over `boxes`. When `go_on` says no, what is left stays one leaf: whoever asks the same question with
    /// its [`Work`] breaks off before it gets there.
    pub(crate) fn new(boxes: &[Bounds], go_on: &dyn Fn() -> bool) -> Self {
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len() / 2 + 1);
        if !items.is_empty() {
            build(boxes, &mut items, 0, &mut nodes, go_on);
        }
        let boxes = items.iter().map(|&item| boxes[item as usize]).collect();
        Self { items, boxes, nodes }
    }

    /// Calls `visit` once for every unordered pair of different items whose boxes meet, until it breaks or the work
    /// is spent.
    pub(crate) fn pairs(
        &self,
        work: &mut Work<'_>,
        visit: &mut dyn FnMut(&mut Work<'_>, usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.nodes.is_empty() { ControlFlow::Continue(()) } else { self.within(0, work, visit) }
    }

    fn within(
        &self,
        node: usize,
        work: &mut Work<'_>,
        visit: &mut dyn FnMut(&mut Work<'_>, usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Node { first, last, right, .. } = self.nodes[node];
        match right {
            Some(right) => {
                self.within(node + 1, work, visit)?;
                self.within(right, work, visit)?;
                self.between(node + 1, right, work, visit)
            }
            None => {
                for a in first..last {
                    for b in a + 1..last {
                        self.test(a, b, work, visit)?;
                    }
                }
                ControlFlow::Continue(())
            }
        }
    }

    fn between(
        &self,
        a: usize,
        b: usize,
        work: &mut Work<'_>,
        visit: &mut dyn FnMut(&mut Work<'_>, usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        work.spend(1)?;
        let (left, right) = (&self.nodes[a], &self.nodes[b]);
        if !left.bounds.meets(&right.bounds) {
            return ControlFlow::Continue(());
        }
        let wider_left = left.last - left.first >= right.last - right.first;
        match (left.right, right.right) {
            (Some(split), _) if wider_left || right.right.is_none() => {
                self.between(a + 1, b, work, visit)?;
                self.between(split, b, work, visit)
            }
            (_, Some(split)) => {
                self.between(a, b + 1, work, visit)?;
                self.between(a, split, work, visit)
            }
            _ => {
                for i in left.first..left.last {
                    if self.boxes[i].meets(&right.bounds) {
                        for j in right.first..right.last {
                            self.test(i, j, work, visit)?;
                        }
                    }
                }
                ControlFlow::Continue(())
            }
        }
    }

    #[inline]
    fn test(
        &self,
        a: usize,
        b: usize,
        work: &mut Work<'_>,
        visit: &mut dyn FnMut(&mut Work<'_>, usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        work.spend(1)?;
        if self.boxes[a].meets(&self.boxes[b]) {
            visit(work, self.items[a] as usize, self.items[b] as usize)
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Calls `visit` for every item whose box meets `target`, until the work is spent.
    pub(crate) fn meeting(
        &self,
        target: &Bounds,
        work: &mut Work<'_>,
        visit: &mut dyn FnMut(usize),
    ) -> ControlFlow<()> {
        let mut open = vec![0];
        while let Some(index) = open.pop() {
            work.spend(1)?;
            let Some(node) = self.nodes.get(index).filter(|node| node.bounds.meets(target)) else { continue };
            match node.right {
                Some(right) => open.extend([right, index + 1]),
                None => {
                    for i in node.first..node.last {
                        if self.boxes[i].meets(target) {
                            visit(self.items[i] as usize);
                        }
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}

fn build(boxes: &[Bounds], items: &mut [u32], first: usize, nodes: &mut Vec<Node>, go_on: &dyn Fn() -> bool) {
    let (mut bounds, mut centers) = (Bounds::EMPTY, Bounds::EMPTY);
    for &item in items.iter() {
        let of_item = boxes[item as usize];
        bounds = bounds.union(of_item);
        centers = centers.with(of_item.center());
    }
    let node = nodes.len();
    nodes.push(Node { bounds, first, last: first + items.len(), right: None });
    if items.len() <= LEAF_SIZE || (items.len() > ITEMS_PER_QUESTION && !go_on()) {
        return;
    }
    let half = items.len() / 2;
    let axis = usize::from(centers.size().y > centers.size().x);
    let key = |item: u32| boxes[item as usize].min[axis] + boxes[item as usize].max[axis];
    items.select_nth_unstable_by(half, |&a, &b| key(a).total_cmp(&key(b)));
    let (left, right) = items.split_at_mut(half);
    build(boxes, left, first, nodes, go_on);
    nodes[node].right = Some(nodes.len());
    build(boxes, right, first + half, nodes, go_on);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;
    use proptest::prelude::*;

    fn boxes() -> impl Strategy<Value = Vec<Bounds>> {
        let one = (0..40i32, 0..40i32, 0..9i32, 0..9i32).prop_map(|(x, y, width, height)| {
            let corner = Point::new(f64::from(x), f64::from(y));
            Bounds::of([corner, Point::new(corner.x + f64::from(width), corner.y + f64::from(height))])
        });
        prop::collection::vec(one, 0..120)
    }

    proptest! {
        #[test]
        fn every_meeting_pair_comes_once(boxes in boxes()) {
            let mut found = Vec::new();
            let done = BoxTree::new(&boxes, &|| true).pairs(&mut Work::new(u64::MAX, &|| true), &mut |_, a, b| {
                found.push((a.min(b), a.max(b)));
                ControlFlow::Continue(())
            });
            prop_assert!(done.is_continue());
            found.sort_unstable();
            let all = (0..boxes.len()).flat_map(|a| (a + 1..boxes.len()).map(move |b| (a, b)));
            let expected: Vec<_> = all.filter(|&(a, b)| boxes[a].meets(&boxes[b])).collect();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn every_box_at_a_target_comes_once(boxes in boxes()) {
            let target = Bounds::of([Point::new(10.0, 10.0), Point::new(20.0, 14.0)]);
            let mut found = Vec::new();
            let done = BoxTree::new(&boxes, &|| true).meeting(&target, &mut Work::new(u64::MAX, &|| true), &mut |i| found.push(i));
            prop_assert!(done.is_continue());
            found.sort_unstable();
            let expected: Vec<_> = (0..boxes.len()).filter(|&i| boxes[i].meets(&target)).collect();
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn spent_work_breaks_off() {
        let same = vec![Bounds::of([Point::origin()]); 1000];
        let mut work = Work::new(1000, &|| true);
        assert!(
            BoxTree::new(&same, &|| true)
                .pairs(&mut work, &mut |_, _, _| ControlFlow::Continue(()))
                .is_break()
        );
        assert!(work.is_spent());
    }

    #[test]
    fn a_search_that_nobody_wants_breaks_off() {
        let same = vec![Bounds::of([Point::origin()]); 1000];
        let mut work = Work::new(u64::MAX, &|| false);
        let mut seen = 0;
        let outcome = BoxTree::new(&same, &|| true).pairs(&mut work, &mut |_, _, _| {
            seen += 1;
            ControlFlow::Continue(())
        });
        assert!(outcome.is_break() && work.is_spent());
        assert_eq!(seen, 0);
    }
}
