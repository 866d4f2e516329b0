//! A network with one node for each visit: what assignment and local search work on.

use crate::cost::{Costs, FORBIDDEN};
use crate::network::Network;

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
/// The same tours are best as with the costs, and the arcs that matter are the cheap ones.
#[derive(Clone, Debug)]
pub(crate) struct GuideCosts {
    size: usize,
    entries: Vec<i64>,
}

impl GuideCosts {
    /// From costs of visits and duals of visits.
    pub(crate) fn of(costs: &impl Costs, row: &[i64], column: &[i64]) -> Self {
        let size = costs.size();
        let mut entries = Vec::with_capacity(size * size);
        let mut largest = 1;
        for from in 0..size {
            for to in 0..size {
                let cost = costs.cost(from, to);
                let left = if cost == FORBIDDEN { FORBIDDEN } else { cost - row[from] - column[to] };
                if left != FORBIDDEN {
                    largest = largest.max(left.abs());
                }
                entries.push(left);
            }
        }
        // Sums of as many penalties as there are visits must fit.
        let penalty = largest.saturating_mul(size as i64 + 1).min(i64::MAX / 4 / (size as i64 + 4));
        for entry in &mut entries {
            if *entry == FORBIDDEN {
                *entry = penalty;
            }
        }
        Self { size, entries }
    }
}

impl Costs for GuideCosts {
    fn size(&self) -> usize {
        self.size
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        self.entries[from * self.size + to]
    }
}
