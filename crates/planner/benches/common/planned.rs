//! One plan of a scene that is seen for the first time.

use traverse_geometry::Scene;
use traverse_planner::{Answer, RapidMove, plan_rapid_move};
use traverse_solve::{Budget, Silent};

/// The length of the shortest path.
pub(crate) fn plan(scene: &Scene, query: &RapidMove) -> f64 {
    match plan_rapid_move(scene, query, &Budget::unlimited(), &mut Silent) {
        Ok((Answer::Plan(plan), _)) => plan.cost,
        other => panic!("no plan: {other:?}"),
    }
}
