//! What the services call to get answers: the engines, behind a trait so that tests can put one in that waits, counts or
//! panics.

use traverse_checker::{PathCheck, check_rapid_move};
use traverse_geometry::Scene;
use traverse_planner::{Answer, RapidMove, Refusal, Stats, plan_rapid_move};
use traverse_proto::CheckQuestion;
use traverse_solve::{Budget, Silent};

/// The engines. Each call runs on a worker of the pool, checks `budget` often and returns soon after it ends.
pub trait Engines: Send + Sync + 'static {
    /// Plans one rapid move.
    ///
    /// # Errors
    /// As [`plan_rapid_move`].
    fn plan_rapid_move(
        &self,
        scene: &Scene,
        query: &RapidMove,
        budget: &Budget,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        plan_rapid_move(scene, query, budget, &mut Silent)
    }

    /// Checks one rapid move.
    fn check_rapid_move(&self, question: &CheckQuestion, budget: &Budget) -> PathCheck {
        let _ = budget;
        check_rapid_move(
            &question.scene,
            question.start,
            question.target,
            &question.path,
            question.tolerance_mm,
        )
    }
}

/// The engines of this product.
#[derive(Clone, Copy, Debug, Default)]
pub struct TraverseEngines;

impl Engines for TraverseEngines {}
