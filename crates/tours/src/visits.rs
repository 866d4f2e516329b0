//! A network with one node for each visit: what assignment and local search work on.

use crate::cost::{Costs, FORBIDDEN};
use crate::network::Network;
use crate::work::Work;
use traverse_solve::Interrupt;

/// A network with one node for each visit. The arc from a visit to itself stands for one to another visit of its
/// type, so that an assignment is a relaxation for types as well.
#[derive(Clone, Debug)]
pub(crate) struct Visits<'a> {
    network: &'a Network,
    /// The type of each visit.
    pub(crate) type_of: Vec<usize>,
}

impl<'a> Visits<'a> {
    pub(crate) fn of(network: &'a Network) -> Self {
        let copies = |node: usize| std::iter::repeat_n(node, network.counts[node] as usize);
        Self { network, type_of: (0..network.size).flat_map(copies).collect() }
    }

    /// The walk through types that an order of visits is.
    pub(crate) fn walk(&self, order: &[usize]) -> Vec<usize> {
        order.iter().map(|&visit| self.type_of[visit]).collect()
    }

    /// An order of visits that a walk through types is.
    pub(crate) fn order(&self, walk: &[usize]) -> Vec<usize> {
        let mut next = vec![0; self.network.size];
        for (visit, &node) in self.type_of.iter().enumerate().rev() {
            next[node] = visit;
        }
        walk.iter()
            .map(|&node| {
                next[node] += 1;
                next[node] - 1
            })
            .collect()
    }

    /// Duals of types from duals of visits: the largest of each type stays feasible, as all its visits see the
    /// same costs.
    pub(crate) fn type_duals(&self, duals: &[i64]) -> Vec<i64> {
        let mut largest = vec![i64::MIN; self.network.size];
        for (&node, &dual) in self.type_of.iter().zip(duals) {
            largest[node] = largest[node].max(dual);
        }
        largest
    }
}

impl Costs for Visits<'_> {
    fn size(&self) -> usize {
        self.type_of.len()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        self.network.cost(self.type_of[from], self.type_of[to])
    }
}

/// Costs less duals, forbidden arcs so dear that none stays in a tour that can do without: what local search sees.
/// The same tours are best as with the costs, and the arcs that matter are the cheap ones. Never negative when the
/// duals are feasible. Kept as a matrix while that is small, computed when asked for otherwise.
#[derive(Clone, Debug)]
pub(crate) struct GuideCosts<'a, C> {
    costs: &'a C,
    row: &'a [i64],
    column: &'a [i64],
    penalty: i64,
    entries: Vec<i64>,
}

/// Nodes up to which costs are kept as a matrix of 32 MB.
const LARGEST_MATRIX: usize = 2_000;

impl<'a, C: Costs> GuideCosts<'a, C> {
    /// From costs and duals of the same nodes.
    pub(crate) fn of(
        costs: &'a C,
        row: &'a [i64],
        column: &'a [i64],
        work: &Work<'_>,
    ) -> Result<Self, Interrupt> {
        let size = costs.size();
        let mut guide = Self { costs, row, column, penalty: FORBIDDEN, entries: vec![] };
        let mut largest = 1;
        for from in 0..size {
            work.breathe()?;
            for to in 0..size {
                let left = guide.cost(from, to);
                if left != FORBIDDEN {
                    largest = largest.max(left.abs());
                }
            }
        }
        // Sums of as many penalties as there are visits must fit.
        let penalty = largest.saturating_mul(size as i64 + 1).min(i64::MAX / 4 / (size as i64 + 4));
        guide.penalty = penalty;
        if size <= LARGEST_MATRIX {
            let mut entries = Vec::with_capacity(size * size);
            for from in 0..size {
                work.breathe()?;
                entries.extend((0..size).map(|to| guide.cost(from, to)));
            }
            guide.entries = entries;
        }
        Ok(guide)
    }
}

impl<C: Costs> Costs for GuideCosts<'_, C> {
    fn size(&self) -> usize {
        self.costs.size()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        if !self.entries.is_empty() {
            return self.entries[from * self.costs.size() + to];
        }
        match self.costs.cost(from, to) {
            FORBIDDEN => self.penalty,
            cost => cost - self.row[from] - self.column[to],
        }
    }
}
