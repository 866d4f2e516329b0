//! What stands in the log: one line per call, and the id of every fault.

use crate::http::{post, send};
use crate::request::{PAST_A_BLOCK, past_a_block};
use crate::running::Running;
use std::io::Write;
use std::sync::{Arc, Mutex};
use tonic::Code;
use tonic_types::StatusExt;
use tracing_subscriber::fmt::MakeWriter;
use traverse_geometry::Scene;
use traverse_planner::{Answer, RapidMove, Refusal, Stats, plan_rapid_move};
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::{PlanRapidMovesRequest, RapidQuery};
use traverse_server::{Config, Engines};
use traverse_solve::{Budget, Silent};

#[derive(Clone, Default)]
struct Log(Arc<Mutex<Vec<u8>>>);

impl Log {
    fn lines(&self) -> Vec<serde_json::Value> {
        let bytes = self.0.lock().expect("no panic").clone();
        let text = String::from_utf8(bytes).expect("utf-8");
        text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
    }
}

impl Write for Log {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().expect("no panic").extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl<'a> MakeWriter<'a> for Log {
    type Writer = Self;

    fn make_writer(&'a self) -> Self {
        self.clone()
    }
}

/// Panics when it starts at the origin.
struct Explosive;

impl Engines for Explosive {
    fn plan_rapid_move(
        &self,
        scene: &Scene,
        query: &RapidMove,
        budget: &Budget,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        assert!(query.start.coords.norm() > 0.0, "the fuse was lit");
        plan_rapid_move(scene, query, budget, &mut Silent)
    }
}

/// One test, because the log is the process's: workers write to it from their own threads.
#[tokio::test]
async fn one_line_per_call_and_the_id_of_every_fault() {
    let log = Log::default();
    let subscriber = tracing_subscriber::fmt().json().flatten_event(true).with_writer(log.clone()).finish();
    tracing::subscriber::set_global_default(subscriber).expect("no other test sets one");
    let server = Running::with(Config { workers: 1, ..Config::on_free_port() }, Explosive).await;
    let mut client = server.client().await;

    let mut deadly = past_a_block();
    deadly.start = crate::request::point(0.0, 0.0);
    let status = client.plan_rapid_move(deadly.clone()).await.expect_err("it panics");
    assert_eq!(status.code(), Code::Internal);
    let info = status.get_details_error_info().expect("there");
    assert_eq!(info.reason, "INTERNAL");
    assert!(!status.message().contains("fuse"), "what happened inside stays inside: {status}");
    let lines = log.lines();
    let fault = lines.iter().find(|line| line["id"] == info.metadata["id"].as_str());
    let fault = fault.unwrap_or_else(|| panic!("{} is not in the log", info.metadata["id"]));
    assert!(fault["message"].as_str().is_some_and(|text| text.contains("the fuse was lit")), "{fault}");

    // Workers outlive it, and a line says what a call was.
    let unlike_others = format!("{PAST_A_BLOCK}{}", " ".repeat(137));
    let answer = send(
        server.address,
        post("/traverse.v1.PlannerService/PlanRapidMove", "application/json", unlike_others.clone()),
    )
    .await;
    assert_eq!(answer.status.as_u16(), 200);
    let lines = log.lines();
    let line = lines.iter().find(|line| line["bytes"] == unlike_others.len()).expect("its line");
    for (key, value) in
        [("method", "PlanRapidMove"), ("protocol", "json"), ("outcome", "plan"), ("code", "Ok")]
    {
        assert_eq!(line[key], value, "{line}");
    }
    assert_eq!((line["vertices"].as_u64(), line["obstacles"].as_u64()), (Some(4), Some(1)));
    for key in ["queue_ms", "run_ms", "total_ms"] {
        assert!(line[key].is_number(), "{line}");
    }

    // A session has one line, when it is over.
    let step = |step| PlanRapidMovesRequest { step_id: String::new(), step: Some(step) };
    let scene = past_a_block().scene.expect("set");
    let steps = [step(Step::Scene(scene)), step(Step::Query(RapidQuery::default()))];
    let mut answers = client.plan_rapid_moves(tokio_stream::iter(steps)).await.expect("opened").into_inner();
    while answers.message().await.expect("it ends well").is_some() {}
    let lines = log.lines();
    let sessions: Vec<_> = lines.iter().filter(|line| line["method"] == "PlanRapidMoves").collect();
    let [line] = sessions[..] else { panic!("{sessions:?}") };
    for (key, value) in [("protocol", "grpc"), ("outcome", "steps"), ("code", "Ok")] {
        assert_eq!(line[key], value, "{line}");
    }
    assert_eq!((line["steps"].as_u64(), line["refused_steps"].as_u64()), (Some(2), Some(1)));
    assert_eq!((line["vertices"].as_u64(), line["obstacles"].as_u64()), (Some(4), Some(1)));
}
