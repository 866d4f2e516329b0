//! Both cost models of 2009 for ordering sections by the effects of their joins, and the rule that every section in
//! turn is held at the end.
//!
//! With δ_ij the length saved by joining j to i, L0 the sum of all lengths and q sections: χ_ij = L0 / q − δ_ij (here
//! times q, to stay whole), and δ′_ij = M − δ_ij with M the largest effect. For each section k the row of k is made
//! constant, which opens the circuit behind k, and the circuit is solved; the best of all k is the order. One solve
//! of a path through a depot gives the same: that is what the ladder does instead of q solves.

use crate::cost::{FORBIDDEN, LARGEST_COST};
use crate::options::SolveOptions;
use crate::{CostMatrix, Finding, TourSpecification, solve};
use traverse_solve::{Budget, Silent};

/// How effects become costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionModel {
    /// χ: each section's share of the whole length, less the effect.
    ShareOfLength {
        /// The sum of all sections' lengths.
        whole_length: i64,
    },
    /// δ′: what is missing to the largest effect.
    Complement,
}

impl SectionModel {
    fn cost(self, effect: i64, sections: i64, largest: i64) -> i64 {
        match self {
            Self::ShareOfLength { whole_length } => {
                whole_length.saturating_sub(sections.saturating_mul(effect))
            }
            Self::Complement => largest.saturating_sub(effect),
        }
        .clamp(-LARGEST_COST - 1, LARGEST_COST + 1)
    }
}

/// The order of sections with the largest sum of effects and that sum, each section held at the end in turn.
/// `effects` row by row, [`FORBIDDEN`] where a join is; the diagonal means nothing. Nothing when the budget ends
/// before the first order, or there is none. `options` say by which method, `heard` is called with every better order.
///
/// # Errors
/// Effects that are not a square matrix, or too large for exact sums.
pub fn order_with_every_end(
    effects: &[i64],
    sections: usize,
    model: SectionModel,
    options: &SolveOptions,
    budget: &Budget,
    heard: &mut dyn FnMut(&[usize], i64),
) -> Result<Option<(Vec<usize>, i64)>, Vec<Finding>> {
    if effects.len() != sections.saturating_mul(sections) {
        return Err(vec![Finding::EntryCount { size: sections, entries: effects.len() }]);
    }
    let joined = |at: usize| at / sections != at % sections && effects[at] != FORBIDDEN;
    let too_large = |&at: &usize| joined(at) && effects[at].unsigned_abs() > LARGEST_COST as u64;
    if let Some(at) = (0..effects.len()).find(too_large) {
        let (from, to) = (at / sections, at % sections);
        return Err(vec![Finding::CostTooLarge { from, to, cost: effects[at] }]);
    }
    let largest = (0..effects.len()).filter(|&at| joined(at)).map(|at| effects[at]).max().unwrap_or(0);
    let costs: Vec<i64> = (0..effects.len())
        .map(|at| if joined(at) { model.cost(effects[at], sections as i64, largest) } else { FORBIDDEN })
        .collect();
    let mut best: Option<(Vec<usize>, i64)> = None;
    for end in 0..sections {
        let mut opened = costs.clone();
        for to in (0..sections).filter(|&to| to != end) {
            opened[end * sections + to] = 0;
        }
        let specification = TourSpecification {
            last: Some(end),
            ..TourSpecification::cycle(CostMatrix::new(sections, opened)?)
        };
        let answer = solve(&specification, options, budget, &mut Silent)?;
        if let Some(tour) = answer.tour {
            let saved = tour.visits.windows(2).map(|pair| effects[pair[0] * sections + pair[1]]).sum();
            if best.as_ref().is_none_or(|best| saved > best.1) {
                heard(&tour.visits, saved);
                best = Some((tour.visits, saved));
            }
        }
    }
    Ok(best)
}
