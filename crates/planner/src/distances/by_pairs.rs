//! Distances by one plan for each pair.

use super::matrix::Matrix;
use super::{DistanceEnd, DistanceQuery, DistancesRefusal};
use crate::{Algorithm, Answer, PreparedScene, RapidMove, Refusal};
use traverse_geometry::Scene;
use traverse_solve::{Budget, Silent};

/// Fills the matrix with the costs of plans. Cost: one plan per pair.
///
/// # Errors
/// As [`super::plan_distances`].
pub(super) fn fill(
    scene: &Scene,
    query: &DistanceQuery,
    matrix: &mut Matrix,
    budget: &Budget,
) -> Result<(), DistancesRefusal> {
    let mut prepared = PreparedScene::new(scene.clone(), budget)?;
    // What other clearances would make of pairs without a path is not asked for.
    let is_asked_once = query.rules.clearances_mm.is_empty() && query.algorithm == Algorithm::Exact;
    let mut ends = Vec::new();
    let mut steps = 0;
    for (row, column) in matrix.open() {
        budget.check(steps)?;
        let query = RapidMove {
            start: query.from[row],
            target: query.targets()[column],
            algorithm: query.algorithm,
            rules: query.rules.clone(),
        };
        let left = budget.iterations.map(|limit| limit.saturating_sub(steps));
        let budget = Budget { iterations: left, ..budget.clone() };
        let answer = if is_asked_once {
            prepared.plan_at_its_clearance(&query, &budget, &mut Silent)
        } else {
            prepared.plan(&query, &budget, &mut Silent)
        };
        match answer {
            Ok((answer, stats)) => {
                steps += stats.expanded_nodes;
                if let Answer::Plan(plan) = answer {
                    matrix.lower(row, column, plan.cost);
                }
            }
            Err(refusals) => {
                for refusal in refusals {
                    ends.push(refused_end(refusal, row, column)?);
                }
            }
        }
    }
    ends.sort_by_key(|&(end, _)| end);
    ends.dedup();
    if ends.is_empty() { Ok(()) } else { Err(DistancesRefusal::Ends(ends)) }
}

fn refused_end(
    refusal: Refusal,
    row: usize,
    column: usize,
) -> Result<(DistanceEnd, Refusal), DistancesRefusal> {
    let end =
        match &refusal {
            Refusal::EndInsideBarrier { field, .. } | Refusal::EndShutIn { field, .. } => {
                if *field == "start" { DistanceEnd::From(row) } else { DistanceEnd::To(column) }
            }
            Refusal::Interrupted { interrupt, .. } => return Err(DistancesRefusal::Interrupted(*interrupt)),
            Refusal::PublishedMethodNotApplicable { .. } | Refusal::NoRoomForDogLegs => {
                return Err(DistancesRefusal::Move(refusal));
            }
        };
    Ok((end, refusal))
}
