//! How sessions end: deadlines, cancel, drain, panics.

use super::{Talk, one_block, past, within};
use crate::bad_input::reason;
use crate::gate::gated;
use crate::http::post;
use crate::running::{HANG, Running};
use http::HeaderValue;
use prost::Message;
use std::time::{Duration, Instant};
use tonic::Code;
use tonic_types::StatusExt;
use traverse_planner::{Answer, PreparedScene, RapidMove, Refusal, Stats};
use traverse_proto::v1::PlanRapidMovesRequest;
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_server::{Config, Engines};
use traverse_solve::{Budget, Interrupt, Silent};

fn one_worker() -> Config {
    Config { workers: 1, ..Config::on_free_port() }
}

#[tokio::test]
async fn a_querys_time_limit_ends_the_query_and_not_the_session() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(), engines).await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    talk.changed(Step::Scene(one_block())).await;
    let problem = talk.problem(Step::Query(within(past(), 30_000_000))).await;
    assert_eq!(
        (problem.code, problem.reason.as_str()),
        (Code::DeadlineExceeded.into(), "TIME_LIMIT_REACHED")
    );
    assert_eq!(gate.ended().await, Some(Interrupt::Deadline));
    gate.open();
    talk.plan(past()).await;
}

#[tokio::test]
async fn the_calls_timeout_ends_the_session_before_the_caller_gives_up() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(), engines).await;
    // Over gRPC-Web by hand: tonic's own client would give up by itself.
    let steps = [Step::Scene(one_block()), Step::Query(past()), Step::Query(past())];
    let steps = steps.map(|step| PlanRapidMovesRequest { step_id: "a".to_owned(), step: Some(step) });
    let body = steps.map(|step| crate::web::framed(&step.encode_to_vec())).concat();
    let path = "/traverse.v1.PlannerService/PlanRapidMoves";
    let mut request = post(path, "application/grpc-web+proto", body);
    request.headers_mut().insert("grpc-timeout", HeaderValue::from_static("250m"));
    let began = Instant::now();
    let answer = crate::http::send(server.address, request).await;
    assert!(began.elapsed() >= Duration::from_millis(200), "the reserve is all that is kept back");
    assert_eq!(gate.ended().await, Some(Interrupt::Deadline));
    let text = String::from_utf8_lossy(&answer.body);
    assert!(text.contains("grpc-status:4") && text.contains("TIME_LIMIT_REACHED"), "{text}");
}

#[tokio::test]
async fn a_session_that_is_dropped_frees_its_core() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(), engines).await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    talk.changed(Step::Scene(one_block())).await;
    talk.send("waits", Step::Query(past())).await;
    gate.begun().await;
    let dropped = Instant::now();
    drop(talk);
    assert_eq!(gate.ended().await, Some(Interrupt::Cancelled));
    assert!(dropped.elapsed() < Duration::from_secs(5), "{:?}", dropped.elapsed());
}

#[tokio::test]
async fn sessions_end_when_the_server_drains() {
    let (engines, mut gate) = gated();
    let config = Config { drain_grace: HANG, ..Config::on_free_port() };
    let server = Running::with(config, engines).await;
    let mut client = server.client().await;
    let mut idle = Talk::open(&mut client).await.expect("opened");
    idle.changed(Step::Scene(one_block())).await;
    let mut busy = Talk::open(&mut client).await.expect("opened");
    busy.changed(Step::Scene(one_block())).await;
    busy.send("at work", Step::Query(past())).await;
    gate.begun().await;
    let served = server.stop();
    let status = idle.end().await;
    assert_eq!((status.code(), reason(&status).as_str()), (Code::Unavailable, "SERVER_DRAINING"));
    // What is at work may end, and is answered.
    gate.open();
    let answer = busy.next().await.expect("no end").expect("an answer");
    assert_eq!(
        (answer.step_id.as_str(), matches!(answer.outcome, Some(Outcome::Plan(_)))),
        ("at work", true)
    );
    assert_eq!(reason(&busy.end().await), "SERVER_DRAINING");
    tokio::time::timeout(HANG, served).await.expect("no hang").expect("no panic").expect("served");
}

#[tokio::test]
async fn after_the_grace_sessions_at_work_are_cut_short() {
    let (engines, mut gate) = gated();
    let config = Config { drain_grace: Duration::from_millis(50), ..Config::on_free_port() };
    let server = Running::with(config, engines).await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    talk.changed(Step::Scene(one_block())).await;
    talk.send("at work", Step::Query(past())).await;
    gate.begun().await;
    let served = server.stop();
    assert_eq!(talk.end().await.code(), Code::Unavailable);
    assert_eq!(gate.ended().await, Some(Interrupt::Cancelled));
    tokio::time::timeout(HANG, served).await.expect("no hang").expect("no panic").expect("served");
}

#[tokio::test]
async fn a_session_that_is_left_alone_ends() {
    let config = Config { session_idle: Duration::from_millis(50), ..Config::on_free_port() };
    let server = Running::with(config, traverse_server::TraverseEngines).await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    let status = talk.end().await;
    assert_eq!((status.code(), reason(&status).as_str()), (Code::DeadlineExceeded, "SESSION_IDLE"));
}

/// Panics when it starts at the origin.
struct Explosive;

impl Engines for Explosive {
    fn plan_in_scene(
        &self,
        scene: &mut PreparedScene,
        query: &RapidMove,
        budget: &Budget,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        assert!(query.start.coords.norm() > 0.0, "the fuse was lit");
        scene.plan(query, budget, &mut Silent)
    }
}

#[tokio::test]
async fn a_panic_ends_its_session_alone_and_what_came_before_is_answered() {
    let server = Running::with(one_worker(), Explosive).await;
    let mut client = server.client().await;
    let mut other = Talk::open(&mut client).await.expect("opened");
    other.changed(Step::Scene(one_block())).await;
    let mut talk = Talk::open(&mut client).await.expect("opened");
    talk.send("scene", Step::Scene(one_block())).await;
    talk.send("past", Step::Query(past())).await;
    talk.send("deadly", Step::Query(super::query((0.0, 0.0), (15.0, 2.0)))).await;
    for step_id in ["scene", "past"] {
        assert_eq!(talk.next().await.expect("no end").expect("an answer").step_id, step_id);
    }
    let status = talk.next().await.expect_err("it panicked");
    assert_eq!(status.code(), Code::Internal);
    let info = status.get_details_error_info().expect("there");
    assert_eq!(info.reason, "INTERNAL");
    assert!(info.metadata.contains_key("id") && !status.message().contains("fuse"), "{status}");
    other.plan(past()).await;
}
