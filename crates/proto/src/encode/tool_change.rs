//! PlaceToolChange: its request, for clients that plan from domain types, and its answer.

use super::path::point;
use super::plan::{cost_unit, no_path, rapid_plan, rapid_stats};
use super::request;
use crate::v1::{self, place_tool_change_response::Outcome};
use std::time::Duration;
use traverse_geometry::Scene;
use traverse_planner::{Stats, ToolChange, ToolChangeAnswer, ToolChangePlan};

/// The request that asks for `change` in `scene`, within the default effort.
#[must_use]
pub fn tool_change_request(scene: &Scene, change: &ToolChange) -> v1::PlaceToolChangeRequest {
    v1::PlaceToolChangeRequest {
        scene: Some(request::scene_message(scene)),
        start: Some(point(change.start)),
        target: Some(point(change.target)),
        regions: change.regions.iter().map(request::polygon).collect(),
        points: change.points.iter().copied().map(point).collect(),
        rules: Some(request::rules(&change.rules)),
        validate_only: false,
        place_z_mm: change.place_z_mm,
    }
}

/// The planner's answer as its message. `prepare` is the time before the search, `search` its own.
#[must_use]
pub fn tool_change_answer(
    answer: &ToolChangeAnswer,
    stats: Stats,
    prepare: Duration,
    search: Duration,
) -> v1::PlaceToolChangeResponse {
    let outcome = match answer {
        ToolChangeAnswer::Plan(plan) => Outcome::Plan(tool_change_plan(plan)),
        ToolChangeAnswer::NoPath(found) => Outcome::NoPath(no_path(found)),
    };
    v1::PlaceToolChangeResponse { outcome: Some(outcome), stats: Some(rapid_stats(stats, prepare, search)) }
}

fn tool_change_plan(plan: &ToolChangePlan) -> v1::ToolChangePlan {
    v1::ToolChangePlan {
        place: Some(point(plan.place)),
        approach: Some(rapid_plan(&plan.approach)),
        departure: Some(rapid_plan(&plan.departure)),
        cost: plan.cost,
        cost_unit: cost_unit(plan.approach.cost_unit).into(),
        lower_bound: plan.lower_bound,
    }
}
