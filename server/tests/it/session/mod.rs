//! PlanRapidMoves: sessions over real sockets.

mod edits;
mod ending;
mod flow;
mod protocols;
mod steps;

use crate::request::{obstacle, point, square};
use crate::running::HANG;
use tokio::sync::mpsc::{Sender, channel};
use tokio_stream::wrappers::ReceiverStream;
use tonic::transport::Channel;
use tonic::{Request, Status, Streaming};
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::planner_service_client::PlannerServiceClient;
use traverse_proto::v1::{
    EditScene, PlanRapidMovesRequest, PlanRapidMovesResponse, Problem, RapidPlan, RapidQuery, RapidRules,
    Scene, SceneChanged,
};

/// An open session.
struct Talk {
    steps: Sender<PlanRapidMovesRequest>,
    answers: Streaming<PlanRapidMovesResponse>,
}

impl Talk {
    async fn open(client: &mut PlannerServiceClient<Channel>) -> Result<Self, Status> {
        let (steps, taken) = channel(16);
        let request = Request::new(ReceiverStream::new(taken));
        let answers = client.plan_rapid_moves(request).await?.into_inner();
        Ok(Self { steps, answers })
    }

    async fn send(&self, step_id: &str, step: impl Into<Option<Step>>) {
        let request = PlanRapidMovesRequest { step_id: step_id.to_owned(), step: step.into() };
        self.steps.send(request).await.expect("the session is open");
    }

    async fn next(&mut self) -> Result<Option<PlanRapidMovesResponse>, Status> {
        tokio::time::timeout(HANG, self.answers.message()).await.expect("no hang")
    }

    /// Sends a step and waits for its answer.
    async fn ask(&mut self, step: Step) -> Outcome {
        self.send("asked", step).await;
        let answer = self.next().await.expect("no end").expect("an answer");
        assert_eq!(answer.step_id, "asked");
        answer.outcome.expect("always set")
    }

    async fn plan(&mut self, query: RapidQuery) -> RapidPlan {
        match self.ask(Step::Query(query)).await {
            Outcome::Plan(plan) => plan,
            other => panic!("no plan: {other:?}"),
        }
    }

    async fn changed(&mut self, step: Step) -> SceneChanged {
        match self.ask(step).await {
            Outcome::SceneChanged(changed) => changed,
            other => panic!("no change: {other:?}"),
        }
    }

    async fn problem(&mut self, step: Step) -> Problem {
        match self.ask(step).await {
            Outcome::Problem(problem) => problem,
            other => panic!("no problem: {other:?}"),
        }
    }

    /// The status that ends the session; answers that come before are skipped.
    async fn end(&mut self) -> Status {
        loop {
            match self.next().await {
                Ok(Some(_)) => {}
                Ok(None) => return Status::new(tonic::Code::Ok, ""),
                Err(status) => return status,
            }
        }
    }
}

/// One block of 10 mm, kept 3 mm away from.
fn one_block() -> Scene {
    Scene {
        obstacles: vec![obstacle("block", square(0.0, 0.0, 10.0))],
        clearance_mm: 3.0,
        ..Default::default()
    }
}

fn query(start: (f64, f64), target: (f64, f64)) -> RapidQuery {
    RapidQuery { start: point(start.0, start.1), target: point(target.0, target.1), rules: None }
}

/// Past the block.
fn past() -> RapidQuery {
    query((-5.0, 2.0), (15.0, 2.0))
}

fn within(query: RapidQuery, nanos: i32) -> RapidQuery {
    let limit = prost_types::Duration { seconds: 0, nanos };
    let options = traverse_proto::v1::SolveOptions { time_limit: Some(limit), ..Default::default() };
    RapidQuery { rules: Some(RapidRules { options: Some(options), ..Default::default() }), ..query }
}

fn put(id: &str, x: f64, y: f64, side: f64) -> EditScene {
    EditScene { put_obstacles: vec![obstacle(id, square(x, y, side))], remove_obstacle_ids: vec![] }
}

fn remove(ids: &[&str]) -> EditScene {
    let remove_obstacle_ids = ids.iter().map(|&id| id.to_owned()).collect();
    EditScene { put_obstacles: vec![], remove_obstacle_ids }
}
