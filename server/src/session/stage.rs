//! What a session keeps between steps, and how each step is answered by it.

use super::vertices::Share;
use crate::config::Config;
use crate::engines::Engines;
use bytes::Bytes;
use prost::Message;
use std::sync::Arc;
use std::time::{Duration, Instant};
use traverse_geometry::{Finding, Reason};
use traverse_planner::{EditRefusal, PreparedScene};
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::{EditScene, PlanRapidMovesRequest, PlanRapidMovesResponse, RapidQuery, Scene};
use traverse_proto::{
    MessageDescriptor, Procedure, Refused, StepQuestion, check_counts, edit_from_wire, problem,
    scene_changed, scene_from_wire, step_id_of, step_plan,
};
use traverse_solve::{Budget, Interrupt};

/// Longest name of a step, bytes.
const STEP_ID_BYTES: usize = 256;

/// What a session keeps between steps.
pub(super) struct Stage {
    config: Arc<Config>,
    engines: Arc<dyn Engines>,
    input: MessageDescriptor,
    scene: Option<PreparedScene>,
    /// Why queries are refused; none: the scene counts.
    stale: Option<Stale>,
    revision: u64,
    share: Share,
}

/// Why the scene does not count.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stale {
    NoSceneYet,
    SceneRefused,
    EditRefused,
}

impl Stale {
    fn why(self) -> &'static str {
        match self {
            Self::NoSceneYet => "the session has no scene yet: send one first",
            Self::SceneRefused => {
                "the scene before this step was refused, or a step that could not be read: send the scene again"
            }
            Self::EditRefused => {
                "an edit before this step was refused: send it again, mended, or a new scene"
            }
        }
    }
}

/// What came of a step, beside its answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub(super) steps: u64,
    pub(super) refused: u64,
    /// Largest scene so far.
    pub(super) vertices: usize,
    pub(super) obstacles: usize,
}

impl Stage {
    /// Nothing yet.
    pub(super) fn new(
        config: Arc<Config>,
        engines: Arc<dyn Engines>,
        procedure: &Procedure,
        share: Share,
    ) -> Self {
        let stale = Some(Stale::NoSceneYet);
        Self { config, engines, input: procedure.input(), scene: None, stale, revision: 0, share }
    }

    /// Answers a step; `encoded` is its bytes, or why there are none.
    pub(super) fn answer(
        &mut self,
        encoded: Result<Bytes, Refused>,
        budget: &Budget,
        tally: &mut Tally,
    ) -> PlanRapidMovesResponse {
        let begun = Instant::now();
        let (step_id, answer) = match encoded {
            Ok(bytes) => match self.read(&bytes) {
                Ok(PlanRapidMovesRequest { step_id, step }) => (step_id, self.perform(step, begun, budget)),
                Err(refused) => (step_id_of(&bytes), Err(self.unread(refused))),
            },
            Err(refused) => (String::new(), Err(self.unread(refused))),
        };
        tally.steps += 1;
        tally.refused += u64::from(answer.is_err());
        if let Some(scene) = &self.scene {
            tally.vertices = tally.vertices.max(scene.vertex_count());
            tally.obstacles = tally.obstacles.max(scene.obstacle_count());
        }
        let answer = answer.unwrap_or_else(|refused| refusal(&refused));
        PlanRapidMovesResponse { step_id, ..answer }
    }

    fn read(&self, bytes: &Bytes) -> Result<PlanRapidMovesRequest, Refused> {
        check_counts(&self.input, bytes, &self.config.limits)?;
        let request = PlanRapidMovesRequest::decode(bytes.as_ref())
            .map_err(|error| Refused::MalformedMessage { detail: error.to_string() })?;
        check_step_id(&request.step_id)?;
        Ok(request)
    }

    /// A step that can't be read may have been a scene.
    fn unread(&mut self, refused: Refused) -> Refused {
        self.leave_no_scene();
        refused
    }

    fn perform(
        &mut self,
        step: Option<Step>,
        begun: Instant,
        budget: &Budget,
    ) -> Result<PlanRapidMovesResponse, Refused> {
        match step {
            Some(Step::Query(query)) => self.query(query, begun, budget),
            Some(Step::Edit(edit)) => self.edit(edit, budget),
            Some(Step::Scene(scene)) => self.scene(scene, budget),
            None => {
                let message = "it is missing; send a scene, a query or an edit";
                let finding = Finding::new("step", Reason::MissingField, "", message);
                Err(self.unread(Refused::findings_of(vec![finding])))
            }
        }
    }

    fn scene(&mut self, scene: Scene, budget: &Budget) -> Result<PlanRapidMovesResponse, Refused> {
        self.leave_no_scene();
        let budget = self.within(None, budget);
        let scene = scene_from_wire(scene, &self.config.limits, &budget)?;
        self.share.resize(scene.vertex_count())?;
        let scene = self.engines.prepare_scene(scene, &budget).map_err(interrupted)?;
        Ok(self.changed(scene))
    }

    fn edit(&mut self, edit: EditScene, budget: &Budget) -> Result<PlanRapidMovesResponse, Refused> {
        let Some(mut scene) = self.scene.take() else { return Err(self.is_stale()) };
        let budget = self.within(None, budget);
        match self.edited(edit, &mut scene, &budget) {
            Ok(()) => Ok(self.changed(scene)),
            Err(refused) => {
                self.scene = Some(scene);
                self.stale = Some(Stale::EditRefused);
                Err(refused)
            }
        }
    }

    fn edited(&mut self, edit: EditScene, scene: &mut PreparedScene, budget: &Budget) -> Result<(), Refused> {
        let edit = edit_from_wire(edit, scene, &self.config.limits, budget)?;
        let more: usize = edit.put.iter().map(|obstacle| obstacle.shape.vertex_count()).sum();
        self.share.resize(scene.kept_vertex_count() + more)?;
        let edited = scene.edit(edit, budget);
        self.share.resize(scene.kept_vertex_count())?;
        edited.map_err(|refusal| match refusal {
            EditRefusal::Interrupted(interrupt) => interrupted(interrupt),
            EditRefusal::UnknownObstacle { id } => {
                crate::fault::of(&format!("an edit that was validated removes {id}, which is not there"))
            }
        })
    }

    fn query(
        &mut self,
        query: RapidQuery,
        begun: Instant,
        budget: &Budget,
    ) -> Result<PlanRapidMovesResponse, Refused> {
        if self.stale.is_some() {
            return Err(self.is_stale());
        }
        let StepQuestion { query, iteration_limit, time_limit } =
            StepQuestion::from_wire(query, &self.config.limits, budget)?;
        let budget = Budget { iterations: iteration_limit, ..self.within(time_limit, budget) };
        let Some(scene) = &mut self.scene else { return Err(self.is_stale()) };
        let prepare = begun.elapsed();
        let planned = self.engines.plan_in_scene(scene, &query, &budget);
        let search = begun.elapsed() - prepare;
        match planned {
            Ok((answer, stats)) => Ok(step_plan(&answer, stats, prepare, search)),
            Err(refusals) => Err(Refused::by_planner(refusals)
                .unwrap_or_else(|| crate::fault::of("the planner refused without a reason"))),
        }
    }

    fn changed(&mut self, scene: PreparedScene) -> PlanRapidMovesResponse {
        self.stale = None;
        self.revision += 1;
        let answer = scene_changed(self.revision, &scene);
        self.scene = Some(scene);
        answer
    }

    fn leave_no_scene(&mut self) {
        self.scene = None;
        self.stale = Some(Stale::SceneRefused);
        // Giving back is never refused.
        self.share.resize(0).ok();
    }

    fn is_stale(&self) -> Refused {
        Refused::SceneStale { why: self.stale.unwrap_or(Stale::NoSceneYet).why() }
    }

    /// The session's budget, cut to a step's own time limit or the server's.
    fn within(&self, time_limit: Option<Duration>, budget: &Budget) -> Budget {
        let config = &self.config;
        let limit = time_limit.unwrap_or(config.default_time_limit).min(config.longest_time_limit);
        let own = Instant::now().checked_add(limit);
        let deadline = match (own, budget.deadline) {
            (Some(own), Some(session)) => Some(own.min(session)),
            (own, session) => own.or(session),
        };
        Budget { deadline, ..budget.clone() }
    }
}

/// The answer to a refused step.
pub(super) fn refusal(refused: &Refused) -> PlanRapidMovesResponse {
    let outcome = Some(Outcome::Problem(problem(refused, "query.")));
    PlanRapidMovesResponse { outcome, ..Default::default() }
}

fn check_step_id(step_id: &str) -> Result<(), Refused> {
    if step_id.len() <= STEP_ID_BYTES {
        return Ok(());
    }
    let message = format!("it has {} bytes; send at most {STEP_ID_BYTES}", step_id.len());
    Err(Refused::findings_of(vec![Finding::new("step_id", Reason::OutOfRange, step_id.len(), message)]))
}

fn interrupted(interrupt: Interrupt) -> Refused {
    Refused::interrupted(interrupt, None)
}
