//! Branch and bound on assignments: a node's assignment either is one circle, a tour, or is divided so that its
//! circles can't come back.
//!
//! Two ways to divide. `EachArc`: one child for each arc of the shortest circle, without that arc and with those
//! before it (Carpaneto and Toth 1980). `OneArc`: two children, one arc out or in, as in the paper of 2009. The
//! children's assignments come from the parent's by one augmentation, O(n²). Depth first, cheapest child first; open
//! nodes hold 4 n numbers each.

use crate::assignment::{Assignment, Matched, Scratch};
use crate::cost::{Costs, FORBIDDEN};
use crate::patching::circles_of;
use crate::work::Work;
use std::rc::Rc;
use traverse_solve::Interrupt;

/// How a node is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Branching {
    /// One child for each arc of the shortest circle.
    EachArc,
    /// Two children: one arc out, or in.
    OneArc,
}

/// Whom the search tells of tours, and asks what is still of interest.
pub(crate) trait Incumbent {
    /// Tours of this cost and above are of no interest.
    fn upper(&mut self) -> i64;
    /// A tour that is cheaper.
    fn offer(&mut self, order: &[usize], cost: i64);
}

/// Whether all nodes were seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Searched {
    /// Nothing cheaper than the best known is left.
    Everything,
    /// The nodes allowed were used up.
    Part,
}

#[derive(Clone, Copy, Debug)]
enum Decision {
    Out(usize, usize),
    In(usize, usize),
}

struct Link {
    decision: Decision,
    before: Option<Rc<Link>>,
}

struct Node {
    assignment: Assignment,
    bound: i64,
    decisions: Option<Rc<Link>>,
}

/// Costs with the decisions of a node.
struct Decided<'a, C> {
    costs: &'a C,
    out: Vec<bool>,
    next: Vec<usize>,
    previous: Vec<usize>,
    marked: Vec<usize>,
}

const FREE: usize = usize::MAX;

impl<C: Costs> Costs for Decided<'_, C> {
    fn size(&self) -> usize {
        self.costs.size()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        let (next, previous) = (self.next[from], self.previous[to]);
        let open = (next == FREE && previous == FREE) || next == to;
        if open && !self.out[from * self.costs.size() + to] { self.costs.cost(from, to) } else { FORBIDDEN }
    }
}

impl<'a, C: Costs> Decided<'a, C> {
    fn new(costs: &'a C) -> Self {
        let size = costs.size();
        Self {
            costs,
            out: vec![false; size * size],
            next: vec![FREE; size],
            previous: vec![FREE; size],
            marked: vec![],
        }
    }

    fn enter(&mut self, mut link: Option<&Rc<Link>>) {
        let size = self.costs.size();
        for at in std::mem::take(&mut self.marked) {
            self.out[at] = false;
        }
        self.next.fill(FREE);
        self.previous.fill(FREE);
        while let Some(here) = link {
            match here.decision {
                Decision::Out(from, to) => self.close(from * size + to),
                Decision::In(from, to) => {
                    self.next[from] = to;
                    self.previous[to] = from;
                }
            }
            link = here.before.as_ref();
        }
        self.close_circles();
    }

    fn close(&mut self, at: usize) {
        if !std::mem::replace(&mut self.out[at], true) {
            self.marked.push(at);
        }
    }

    /// Arcs that would close a path of decided arcs before it has met all nodes.
    fn close_circles(&mut self) {
        let size = self.costs.size();
        for begin in 0..size {
            if self.previous[begin] != FREE || self.next[begin] == FREE {
                continue;
            }
            let (mut end, mut length) = (begin, 1);
            while self.next[end] != FREE {
                end = self.next[end];
                length += 1;
            }
            if length < size {
                self.close(end * size + begin);
            }
        }
    }
}

/// Searches below the root's assignment, at most `nodes` nodes of it.
pub(crate) fn search(
    costs: &impl Costs,
    root: &Assignment,
    branching: Branching,
    nodes: u64,
    incumbent: &mut dyn Incumbent,
    work: &mut Work<'_>,
) -> Result<Searched, Interrupt> {
    let size = costs.size();
    let mut decided = Decided::new(costs);
    let mut scratch = Scratch::new(size);
    let mut open = vec![Node { assignment: root.clone(), bound: root.bound(), decisions: None }];
    let mut seen = 0;
    while let Some(node) = open.pop() {
        if node.bound >= incumbent.upper() {
            continue;
        }
        if seen >= nodes {
            return Ok(Searched::Part);
        }
        seen += 1;
        work.step()?;
        let circles = circles_of(&node.assignment.successor);
        if circles.len() == 1 {
            incumbent.offer(&circles[0], node.bound);
            continue;
        }
        decided.enter(node.decisions.as_ref());
        let mut children = vec![];
        for (decisions, again) in divide(&node, &circles, &decided, branching) {
            decided.enter(decisions.as_ref());
            let mut assignment = node.assignment.clone();
            if let Some(row) = again {
                assignment.release(row);
                if assignment.augment(&decided, row, &mut scratch, work)? == Matched::None {
                    continue;
                }
            }
            let bound = assignment.bound();
            if bound < incumbent.upper() {
                children.push(Node { assignment, bound, decisions });
            }
        }
        // The last is taken first.
        children.sort_by_key(|child| std::cmp::Reverse(child.bound));
        open.extend(children);
    }
    Ok(Searched::Everything)
}

/// A child: what is decided there, and the row that must find another successor.
type Child = (Option<Rc<Link>>, Option<usize>);

fn divide<C: Costs>(
    node: &Node,
    circles: &[Vec<usize>],
    decided: &Decided<'_, C>,
    branching: Branching,
) -> Vec<Child> {
    let successor = &node.assignment.successor;
    let open = |circle: &[usize]| circle.iter().filter(|&&from| decided.next[from] == FREE).count();
    let Some(circle) = circles.iter().min_by_key(|circle| (open(circle), circle.len())) else {
        return vec![];
    };
    let arcs: Vec<(usize, usize)> = circle
        .iter()
        .filter(|&&from| decided.next[from] == FREE)
        .map(|&from| (from, successor[from]))
        .collect();
    let link = |decision, before: &Option<Rc<Link>>| Some(Rc::new(Link { decision, before: before.clone() }));
    match branching {
        Branching::OneArc => {
            let Some(&(from, to)) = arcs.first() else { return vec![] };
            vec![
                (link(Decision::Out(from, to), &node.decisions), Some(from)),
                // The assignment already has the arc.
                (link(Decision::In(from, to), &node.decisions), None),
            ]
        }
        Branching::EachArc => {
            let mut before = node.decisions.clone();
            let mut children = vec![];
            for (from, to) in arcs {
                children.push((link(Decision::Out(from, to), &before), Some(from)));
                before = link(Decision::In(from, to), &before);
            }
            children
        }
    }
}
