//! A square matrix of arc costs, row by row. The diagonal is the arc from a node to another visit of itself: it
//! matters only where a node is visited more than once.

use crate::Finding;
use crate::cost::{Costs, FORBIDDEN, LARGEST_COST, LARGEST_VISITS};

/// A square matrix of arc costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CostMatrix {
    size: usize,
    entries: Vec<i64>,
}

impl CostMatrix {
    /// The matrix of `size` rows that stand one after the other in `entries`.
    ///
    /// # Errors
    /// Every finding: a wrong number of entries, costs beyond [`LARGEST_COST`].
    pub fn new(size: usize, entries: Vec<i64>) -> Result<Self, Vec<Finding>> {
        if size > LARGEST_VISITS {
            return Err(vec![Finding::TooManyVisits { visits: size as u64 }]);
        }
        if entries.len() != size * size {
            return Err(vec![Finding::EntryCount { size, entries: entries.len() }]);
        }
        let findings: Vec<Finding> = entries
            .iter()
            .enumerate()
            .filter(|&(_, &cost)| cost != FORBIDDEN && !(-LARGEST_COST..=LARGEST_COST).contains(&cost))
            .map(|(at, &cost)| Finding::CostTooLarge { from: at / size, to: at % size, cost })
            .take(MOST_FINDINGS)
            .collect();
        if findings.is_empty() { Ok(Self { size, entries }) } else { Err(findings) }
    }

    /// The entries, row by row.
    #[must_use]
    pub fn entries(&self) -> &[i64] {
        &self.entries
    }
}

/// A matrix that is wrong throughout is not listed entry by entry.
const MOST_FINDINGS: usize = 100;

impl Costs for CostMatrix {
    fn size(&self) -> usize {
        self.size
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        self.entries[from * self.size + to]
    }
}
