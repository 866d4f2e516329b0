//! A tour as an array of nodes with the position of each: what local search changes.
//!
//! The only change is to swap two neighbouring segments, which keeps the direction of every arc: pure 3-opt moves,
//! Or-opt and the double bridge are all made of it. Of the three segments that a swap parts the circle into,
//! swapping any two neighbours gives the same tour, so the longest one stays where it is: O(n) at worst, the length
//! of what moves in practice.

/// A tour as an array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TourArray {
    order: Vec<usize>,
    position: Vec<usize>,
    scratch: Vec<usize>,
}

/// Two neighbouring segments that were swapped: where the first began, and how long they were.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Swap {
    start: usize,
    first: usize,
    second: usize,
}

impl TourArray {
    pub(crate) fn new(order: Vec<usize>) -> Self {
        let mut position = vec![0; order.len()];
        for (at, &node) in order.iter().enumerate() {
            position[node] = at;
        }
        Self { order, position, scratch: vec![] }
    }

    pub(crate) fn order(&self) -> &[usize] {
        &self.order
    }

    pub(crate) fn len(&self) -> usize {
        self.order.len()
    }

    pub(crate) fn at(&self, position: usize) -> usize {
        self.order[position]
    }

    pub(crate) fn next(&self, node: usize) -> usize {
        let at = self.position[node] + 1;
        self.order[if at == self.order.len() { 0 } else { at }]
    }

    pub(crate) fn previous(&self, node: usize) -> usize {
        let at = self.position[node];
        self.order[if at == 0 { self.order.len() - 1 } else { at - 1 }]
    }

    /// How many steps lead from one node to another, along the tour.
    pub(crate) fn steps(&self, from: usize, to: usize) -> usize {
        let (from, to) = (self.position[from], self.position[to]);
        if to >= from { to - from } else { to + self.order.len() - from }
    }

    /// Swaps the segment that begins at `node` and has `first` nodes with the `second` nodes behind it.
    pub(crate) fn swap(&mut self, node: usize, first: usize, second: usize) -> Swap {
        let size = self.order.len();
        debug_assert!(first > 0 && second > 0 && first + second <= size, "invariant: segments don't overlap");
        let start = self.position[node];
        let third = size - first - second;
        let made = if third >= first && third >= second {
            Swap { start, first, second }
        } else if first >= second {
            Swap { start: self.wrapped(start + first), first: second, second: third }
        } else {
            Swap { start: self.wrapped(start + first + second), first: third, second: first }
        };
        self.apply(made);
        made
    }

    /// Takes a swap back, the last one made first.
    pub(crate) fn undo(&mut self, swap: Swap) {
        self.apply(Swap { start: swap.start, first: swap.second, second: swap.first });
    }

    fn apply(&mut self, Swap { start, first, second }: Swap) {
        let mut scratch = std::mem::take(&mut self.scratch);
        scratch.clear();
        let whole = first + second;
        for step in (first..whole).chain(0..first) {
            scratch.push(self.order[self.wrapped(start + step)]);
        }
        for (step, &node) in scratch.iter().enumerate() {
            let at = self.wrapped(start + step);
            self.order[at] = node;
            self.position[node] = at;
        }
        self.scratch = scratch;
    }

    fn wrapped(&self, at: usize) -> usize {
        if at >= self.order.len() { at - self.order.len() } else { at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swap_gives_the_same_circle_whichever_segments_move_and_can_be_undone() {
        let size = 9;
        for node in 0..size {
            for first in 1..size {
                for second in 1..=size - first {
                    let mut tour = TourArray::new((0..size).collect());
                    let before = tour.clone();
                    let swap = tour.swap(node, first, second);
                    let turned: Vec<usize> = (0..size).map(|step| (node + step) % size).collect();
                    let expected =
                        [&turned[first..first + second], &turned[..first], &turned[first + second..]]
                            .concat();
                    for (step, &at) in expected.iter().enumerate() {
                        assert_eq!(tour.next(at), expected[(step + 1) % size], "{node} {first} {second}");
                        assert_eq!(tour.previous(tour.next(at)), at);
                    }
                    tour.undo(swap);
                    assert_eq!(tour.order(), before.order());
                }
            }
        }
    }
}
