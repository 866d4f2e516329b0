//! PlanRapidMove's answer.

use super::path::path;
use crate::v1::{self, plan_rapid_move_response::Outcome};
use std::time::Duration;
use traverse_geometry::CostUnit;
use traverse_planner::{Answer, FeasibleClearance, NoPath, RapidPlan, Stats};

/// The planner's answer as its message. `prepare` is the time before the search, `search` its own.
#[must_use]
pub fn plan_answer(
    answer: &Answer,
    stats: Stats,
    prepare: Duration,
    search: Duration,
) -> v1::PlanRapidMoveResponse {
    let outcome = match answer {
        Answer::Plan(plan) => Outcome::Plan(rapid_plan(plan)),
        Answer::NoPath(found) => Outcome::NoPath(no_path(found)),
    };
    v1::PlanRapidMoveResponse { outcome: Some(outcome), stats: Some(rapid_stats(stats, prepare, search)) }
}

pub(super) fn rapid_stats(stats: Stats, prepare: Duration, search: Duration) -> v1::RapidStats {
    v1::RapidStats {
        barrier_vertex_count: count(stats.barrier_vertices),
        expanded_node_count: count(stats.expanded_nodes),
        prepare_duration: prepare.try_into().ok(),
        search_duration: search.try_into().ok(),
    }
}

pub(super) fn no_path(no_path: &NoPath) -> v1::NoPath {
    v1::NoPath {
        separating_obstacle_ids: no_path.separating_obstacles.clone(),
        feasible_clearance_mm: match no_path.feasible_clearance {
            FeasibleClearance::Millimetres(clearance) => Some(clearance),
            FeasibleClearance::None | FeasibleClearance::Unknown => None,
        },
        feasible_clearance_unknown: no_path.feasible_clearance == FeasibleClearance::Unknown,
    }
}

/// The answer to a sound request that was only to be validated.
#[must_use]
pub fn sound_answer() -> v1::PlanRapidMoveResponse {
    v1::PlanRapidMoveResponse { outcome: None, stats: None }
}

pub(super) fn rapid_plan(plan: &RapidPlan) -> v1::RapidPlan {
    v1::RapidPlan {
        path: Some(path(&plan.path)),
        cost: plan.cost,
        cost_unit: cost_unit(plan.cost_unit).into(),
        lower_bound: plan.lower_bound,
        clearance_mm: plan.clearance_mm,
        bending_obstacle_ids: plan.bending_obstacles.clone(),
        alternatives: plan.alternatives.iter().map(path).collect(),
        alternative_costs: plan.alternative_costs.clone(),
    }
}

/// What a cost counts.
pub(super) fn cost_unit(unit: CostUnit) -> v1::CostUnit {
    match unit {
        CostUnit::Millimetres => v1::CostUnit::Mm,
        CostUnit::Seconds => v1::CostUnit::Seconds,
    }
}

fn count(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
