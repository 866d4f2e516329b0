//! Answers of a session's steps.

use super::plan::{no_path, rapid_plan, rapid_stats};
use crate::v1::plan_rapid_moves_response::Outcome;
use crate::v1::{PlanRapidMovesResponse, SceneChanged};
use std::time::Duration;
use traverse_planner::{Answer, PreparedScene, Stats};

/// The answer to a query, its step not named yet. `prepare` is the time before the search, `search` its own.
#[must_use]
pub fn step_plan(
    answer: &Answer,
    stats: Stats,
    prepare: Duration,
    search: Duration,
) -> PlanRapidMovesResponse {
    let outcome = match answer {
        Answer::Plan(plan) => Outcome::Plan(rapid_plan(plan)),
        Answer::NoPath(answer) => Outcome::NoPath(no_path(answer)),
    };
    PlanRapidMovesResponse {
        step_id: String::new(),
        outcome: Some(outcome),
        stats: Some(rapid_stats(stats, prepare, search)),
    }
}

/// The answer to a scene or an edit that succeeded as the session's `revision`th, its step not named yet.
#[must_use]
pub fn scene_changed(revision: u64, scene: &PreparedScene) -> PlanRapidMovesResponse {
    let revision = i64::try_from(revision).unwrap_or(i64::MAX);
    let obstacle_count = i32::try_from(scene.obstacle_count()).unwrap_or(i32::MAX);
    let outcome = Outcome::SceneChanged(SceneChanged { revision, obstacle_count });
    PlanRapidMovesResponse { step_id: String::new(), outcome: Some(outcome), stats: None }
}
