//! A session: the scene once, then moves and changes in program order, sent ahead of their answers.

use crate::traverse::plan_rapid_moves_request::Step;
use crate::traverse::planner_service_client::PlannerServiceClient;
use crate::traverse::{
    EditScene, Obstacle, PlanRapidMovesRequest, PlanRapidMovesResponse, Point, RapidQuery, Scene,
};
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tonic::transport::Channel;
use tonic::{Status, Streaming};

/// Steps that wait to be sent.
const WAITING: usize = 256;

/// The sending half of an open session. When it is dropped the server answers what it has, and ends.
pub struct Steps(Sender<PlanRapidMovesRequest>);

/// Opens a session. The answers come in the order of the steps; read them while you send: a server does not read on from a
/// caller who does not read.
///
/// # Errors
/// The server can't be reached, or has no place for another session.
pub async fn open_session(
    client: &mut PlannerServiceClient<Channel>,
) -> Result<(Steps, Streaming<PlanRapidMovesResponse>), Status> {
    let (send, waiting) = channel(WAITING);
    let answers = client.plan_rapid_moves(Waiting(waiting)).await?.into_inner();
    Ok((Steps(send), answers))
}

impl Steps {
    /// The scene that counts from now on.
    pub async fn scene(&self, step_id: &str, scene: Scene) {
        self.send(step_id, Step::Scene(scene)).await;
    }

    /// A move in the scene as it is then.
    pub async fn plan(&self, step_id: &str, start: Point, target: Point) {
        let query = RapidQuery { start: Some(start), target: Some(target), rules: None };
        self.send(step_id, Step::Query(query)).await;
    }

    /// Adds an obstacle, or replaces the one with the same id.
    pub async fn put(&self, step_id: &str, obstacle: Obstacle) {
        self.send(step_id, Step::Edit(EditScene { put_obstacles: vec![obstacle], ..Default::default() }))
            .await;
    }

    /// Removes an obstacle.
    pub async fn remove(&self, step_id: &str, id: &str) {
        let remove_obstacle_ids = vec![id.to_owned()];
        self.send(step_id, Step::Edit(EditScene { remove_obstacle_ids, ..Default::default() })).await;
    }

    async fn send(&self, step_id: &str, step: Step) {
        // When the session is over its answers say why.
        self.0.send(PlanRapidMovesRequest { step_id: step_id.to_owned(), step: Some(step) }).await.ok();
    }
}

/// The waiting steps as the stream that a call takes.
struct Waiting(Receiver<PlanRapidMovesRequest>);

impl tonic::codegen::tokio_stream::Stream for Waiting {
    type Item = PlanRapidMovesRequest;

    fn poll_next(
        mut self: std::pin::Pin<&mut Self>,
        context: &mut std::task::Context<'_>,
    ) -> std::task::Poll<Option<Self::Item>> {
        self.0.poll_recv(context)
    }
}
