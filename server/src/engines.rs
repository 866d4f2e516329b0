//! What the services call to get answers: the engines, behind a trait so that tests can put one in that waits, counts or
//! panics.

use traverse_checker::{PathCheck, check_rapid_move_by_while};
use traverse_geometry::Scene;
use traverse_planner::{
    Answer, DistanceQuery, DistancesRefusal, PreparedScene, RapidMove, Refusal, Stats, plan_distances,
    plan_rapid_move,
};
use traverse_proto::CheckQuestion;
use traverse_solve::{Budget, Interrupt, Silent};

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

    /// Takes a session's scene apart.
    ///
    /// # Errors
    /// The budget ended.
    fn prepare_scene(&self, scene: Scene, budget: &Budget) -> Result<PreparedScene, Interrupt> {
        PreparedScene::new(scene, budget)
    }

    /// Plans one rapid move in a session's scene.
    ///
    /// # Errors
    /// As [`plan_rapid_move`].
    fn plan_in_scene(
        &self,
        scene: &mut PreparedScene,
        query: &RapidMove,
        budget: &Budget,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        scene.plan(query, budget, &mut Silent)
    }

    /// Works out shortest costs between many points.
    ///
    /// # Errors
    /// As [`plan_distances`].
    fn plan_distances(
        &self,
        scene: &Scene,
        query: &DistanceQuery,
        budget: &Budget,
    ) -> Result<Vec<f64>, DistancesRefusal> {
        plan_distances(scene, query, budget)
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
