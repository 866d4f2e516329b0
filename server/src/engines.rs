//! What the services call to get answers: the engines, behind a trait so that tests can put one in that waits, counts or
//! panics.

use traverse_checker::{
    PathCheck, SectionsCheck, check_certified_sections_while, check_rapid_move_by_while, check_sections_while,
};
use traverse_geometry::{Finding, Scene};
use traverse_layout_sequencing::{JoinMatrix, LayoutAnswer, joins, order_sections};
use traverse_planner::{
    Answer, DistanceQuery, DistancesRefusal, PreparedScene, RapidMove, Refusal, Stats, ToolChange,
    ToolChangeAnswer, plan_distances, plan_rapid_move, plan_tool_change,
};
use traverse_proto::{CheckQuestion, CheckSectionsQuestion, OrderQuestion};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

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

    /// Orders the sections of a layout.
    ///
    /// # Errors
    /// As [`order_sections`].
    fn order_sections(
        &self,
        question: &OrderQuestion,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> Result<LayoutAnswer, Vec<Finding>> {
        order_sections(&question.layout, &question.options, budget, observer)
    }

    /// The effects of all ordered pairs of sections.
    ///
    /// # Errors
    /// As [`joins`].
    fn section_joins(&self, question: &OrderQuestion, budget: &Budget) -> Result<JoinMatrix, Interrupt> {
        joins(&question.layout, question.options.effect_model, question.options.threads, budget)
    }

    /// Checks a layout of sections, and what certifies its bound. None: the budget ended first.
    fn check_sections(&self, question: &CheckSectionsQuestion, budget: &Budget) -> Option<SectionsCheck> {
        let go_on = || budget.check(0).is_ok();
        let CheckSectionsQuestion { layout, order, tolerance_mm, bound_claim, .. } = question;
        match bound_claim {
            None => check_sections_while(layout, order, *tolerance_mm, &go_on),
            Some(claim) => check_certified_sections_while(layout, order, claim, *tolerance_mm, &go_on),
        }
    }
}

/// The engines of this product.
#[derive(Clone, Copy, Debug, Default)]
pub struct TraverseEngines;

impl Engines for TraverseEngines {}
