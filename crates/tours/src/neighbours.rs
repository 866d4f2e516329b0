//! The cheapest few arcs out of each node: where local search looks first. O(n²) with a selection per row.

use crate::cost::{Costs, FORBIDDEN};
use crate::work::Work;
use traverse_solve::Interrupt;

/// The cheapest few successors of each node, cheapest first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Neighbours {
    width: usize,
    lists: Vec<usize>,
    ends: Vec<usize>,
}

impl Neighbours {
    /// The `width` cheapest allowed arcs out of each node.
    ///
    /// # Errors
    /// When the budget ends.
    pub fn cheapest(costs: &impl Costs, width: usize, work: &Work<'_>) -> Result<Self, Interrupt> {
        let size = costs.size();
        let mut lists = vec![0; size * width];
        let mut ends = vec![0; size];
        let mut row: Vec<(i64, usize)> = Vec::with_capacity(size);
        for from in 0..size {
            work.breathe()?;
            row.clear();
            row.extend((0..size).filter(|&to| to != from).map(|to| (costs.cost(from, to), to)));
            row.retain(|&(cost, _)| cost != FORBIDDEN);
            if row.len() > width && width > 0 {
                row.select_nth_unstable(width - 1);
                row.truncate(width);
            }
            row.sort_unstable();
            for (at, &(_, to)) in row.iter().take(width).enumerate() {
                lists[from * width + at] = to;
            }
            ends[from] = row.len().min(width);
        }
        Ok(Self { width, lists, ends })
    }

    /// Lists that the caller has chosen, the cheapest arc of each first.
    #[must_use]
    pub(crate) fn from_lists(lists: &[Vec<usize>]) -> Self {
        let width = lists.iter().map(Vec::len).max().unwrap_or(0);
        let padded = |list: &Vec<usize>| {
            let mut row = list.clone();
            row.resize(width, 0);
            row
        };
        Self {
            width,
            lists: lists.iter().flat_map(padded).collect(),
            ends: lists.iter().map(Vec::len).collect(),
        }
    }

    /// The cheapest successors of a node.
    #[must_use]
    pub fn of(&self, node: usize) -> &[usize] {
        &self.lists[node * self.width..][..self.ends[node]]
    }
}
