//! A path from the depot back to it, as an array: segments swap, nothing turns round.

use crate::cost::Costs;

/// A path; the depot stands at both ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Path {
    nodes: Vec<usize>,
    position: Vec<usize>,
}

/// Two neighbouring segments that change places: behind `before`, up to `middle`, up to `end`, all positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Exchange {
    pub(super) before: usize,
    pub(super) middle: usize,
    pub(super) end: usize,
}

impl Path {
    /// From a closed walk that begins at the depot.
    pub(super) fn new(mut walk: Vec<usize>) -> Self {
        let mut position = vec![0; walk.len()];
        for (at, &node) in walk.iter().enumerate() {
            position[node] = at;
        }
        if let Some(&depot) = walk.first() {
            walk.push(depot);
        }
        Self { nodes: walk, position }
    }

    pub(super) fn at(&self, position: usize) -> usize {
        self.nodes[position]
    }

    pub(super) fn position(&self, node: usize) -> usize {
        self.position[node]
    }

    /// The position of the depot's second appearance.
    pub(super) fn end(&self) -> usize {
        self.nodes.len() - 1
    }

    /// What the dearest arc costs.
    pub(super) fn dearest(&self, costs: &impl Costs) -> i64 {
        self.nodes.windows(2).map(|pair| costs.cost(pair[0], pair[1])).max().unwrap_or(0)
    }

    /// The walk, depot first, without its return.
    pub(super) fn walk(&self) -> &[usize] {
        &self.nodes[..self.end()]
    }

    pub(super) fn exchange(&mut self, Exchange { before, middle, end }: Exchange) {
        self.nodes[before + 1..=end].rotate_left(middle - before);
        for at in before + 1..=end {
            self.position[self.nodes[at]] = at;
        }
    }
}

impl Exchange {
    /// What puts everything back.
    pub(super) fn undone(self) -> Self {
        Self { middle: self.before + self.end - self.middle, ..self }
    }

    /// The gain of the exchange.
    pub(super) fn saving(self, path: &Path, cost: impl Fn(usize, usize) -> i64) -> i64 {
        let at = |position: usize| path.at(position);
        let Self { before, middle, end } = self;
        cost(at(before), at(before + 1)) + cost(at(middle), at(middle + 1)) + cost(at(end), at(end + 1))
            - cost(at(before), at(middle + 1))
            - cost(at(end), at(before + 1))
            - cost(at(middle), at(end + 1))
    }
}
