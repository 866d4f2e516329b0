//! What the services call to get answers: the engines, behind a trait so that tests can put one in that waits, counts or
//! panics.

use traverse_checker::{PathCheck, check_rapid_move_by_while};
use traverse_geometry::Scene;
use traverse_planner::{
    Answer, RapidMove, Refusal, Stats, ToolChange, ToolChangeAnswer, plan_rapid_move, plan_tool_change,
};
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

    /// Places one tool change.
    ///
    /// # Errors
    /// As [`plan_tool_change`].
    fn place_tool_change(
        &self,
        scene: &Scene,
        change: &ToolChange,
        budget: &Budget,
    ) -> Result<(ToolChangeAnswer, Stats), Vec<Refusal>> {
        plan_tool_change(scene, change, budget, &mut Silent)
    }

    /// Checks one rapid move. None: the budget ended first.
    fn check_rapid_move(&self, question: &CheckQuestion, budget: &Budget) -> Option<PathCheck> {
        let CheckQuestion { scene, rules, start, target, path, tolerance_mm } = question;
        let go_on = || budget.check(0).is_ok();
        check_rapid_move_by_while(scene, rules, *start, *target, path, *tolerance_mm, &go_on)
    }
}

/// The engines of this product.
#[derive(Clone, Copy, Debug, Default)]
pub struct TraverseEngines;

impl Engines for TraverseEngines {}
