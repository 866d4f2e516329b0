//! What is to be ordered: costs of arcs, how often each node is visited, where the tour begins and ends, what comes
//! before what. Validation reports every finding.

use crate::cost::{Costs, LARGEST_VISITS};
use crate::precedence::Precedence;
use crate::{CostMatrix, Finding};

/// Whether the way back from the last visit to the first is part of the tour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// It is.
    #[default]
    Cycle,
    /// It is not.
    Path,
}

/// What is to be ordered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TourSpecification {
    /// What the arcs cost.
    pub costs: CostMatrix,
    /// How often each node is visited. Empty: once each.
    pub quantities: Vec<u32>,
    /// Cycle or path.
    pub shape: Shape,
    /// The node of the first visit. Absent: any.
    pub first: Option<usize>,
    /// The node of the last visit. Absent: any.
    pub last: Option<usize>,
    /// Pairs (a, b): all visits of a come before all visits of b.
    pub precedence: Vec<(usize, usize)>,
}

impl TourSpecification {
    /// Every node once, back to the first.
    #[must_use]
    pub fn cycle(costs: CostMatrix) -> Self {
        Self { costs, quantities: vec![], shape: Shape::Cycle, first: None, last: None, precedence: vec![] }
    }

    /// Every node once, ends free.
    #[must_use]
    pub fn path(costs: CostMatrix) -> Self {
        Self { shape: Shape::Path, ..Self::cycle(costs) }
    }

    /// How often the node is visited.
    #[must_use]
    pub fn quantity(&self, node: usize) -> u32 {
        self.quantities.get(node).copied().unwrap_or(1)
    }

    /// Everything that is wrong. Empty: it can be solved.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let size = self.costs.size();
        let mut findings = vec![];
        if size == 0 {
            findings.push(Finding::NoNodes);
        }
        if !self.quantities.is_empty() && self.quantities.len() != size {
            findings.push(Finding::QuantityCount { size, quantities: self.quantities.len() });
        }
        let zero = self.quantities.iter().enumerate().filter(|&(_, &quantity)| quantity == 0);
        findings.extend(zero.map(|(node, _)| Finding::NoVisit { node }));
        let visits: u64 = (0..size).map(|node| u64::from(self.quantity(node))).sum();
        if visits > LARGEST_VISITS as u64 {
            findings.push(Finding::TooManyVisits { visits });
        }
        let named = [("first", self.first), ("last", self.last)];
        let ends = named.into_iter().filter_map(|(field, node)| node.map(|node| (field, node)));
        let pairs = self.precedence.iter().flat_map(|&(a, b)| [("precedence", a), ("precedence", b)]);
        let unknown = ends.chain(pairs).filter(|&(_, node)| node >= size);
        findings.extend(unknown.map(|(field, node)| Finding::UnknownNode { field, node, size }));
        if !findings.is_empty() {
            return findings;
        }
        if let (Some(first), Some(last)) = (self.first, self.last)
            && first == last
            && self.quantity(first) == 1
            && visits > 1
        {
            findings.push(Finding::FirstIsLast { node: first });
        }
        self.precedence_findings(&mut findings);
        findings
    }

    fn precedence_findings(&self, findings: &mut Vec<Finding>) {
        if self.precedence.is_empty() {
            return;
        }
        if self.shape == Shape::Cycle && self.first.is_none() && self.last.is_none() {
            findings.push(Finding::PrecedenceWithoutEnds);
        }
        match Precedence::closure(self.costs.size(), &self.precedence) {
            Err(node) => findings.push(Finding::CyclicPrecedence { node }),
            Ok(_) => {
                let against = |&&(before, after): &&(usize, usize)| {
                    self.first == Some(after) || self.last == Some(before)
                };
                let wrong = self.precedence.iter().filter(against);
                findings
                    .extend(wrong.map(|&(before, after)| Finding::PrecedenceAgainstEnds { before, after }));
            }
        }
    }
}
