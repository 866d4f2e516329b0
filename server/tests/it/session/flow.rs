//! Back-pressure, admission, and calls beside sessions.

use super::{Talk, one_block, past, query};
use crate::bad_input::reason;
use crate::gate::gated;
use crate::request::past_a_block;
use crate::running::{HANG, Running};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use tokio_stream::StreamExt;
use tonic::Code;
use tonic_types::StatusExt;
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::{PlanRapidMovesRequest, Scene};
use traverse_server::{Config, RETRY_AFTER, TraverseEngines};

/// Steps that a caller offers who does not read; were they all taken in, it would be ten times what may be on the way.
const STEPS: usize = 150_000;

#[tokio::test]
async fn a_caller_who_does_not_read_is_not_read_from() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let taken = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&taken);
    let steps = (0..STEPS).map(move |i| {
        count.store(i, Ordering::Relaxed);
        let step = match i {
            0 => Step::Scene(Scene::default()),
            _ => Step::Query(query((0.0, 0.0), (i as f64, 1.0))),
        };
        PlanRapidMovesRequest { step_id: i.to_string(), step: Some(step) }
    });
    let mut answers = client.plan_rapid_moves(tokio_stream::iter(steps)).await.expect("opened").into_inner();
    // Until nothing moves any more.
    let mut before = usize::MAX;
    while before != taken.load(Ordering::Relaxed) {
        before = taken.load(Ordering::Relaxed);
        tokio::time::timeout(Duration::from_millis(300), std::future::pending::<()>()).await.ok();
    }
    assert!(before < STEPS / 2, "{before} steps were taken in although nobody reads the answers");
    // And nothing is lost.
    for i in 0..STEPS {
        let answer = tokio::time::timeout(HANG, answers.next()).await.expect("no hang");
        let answer = answer.expect("one for each").expect("sound");
        assert_eq!(answer.step_id, i.to_string());
    }
    assert!(answers.next().await.is_none());
}

#[tokio::test]
async fn there_is_a_place_for_so_many_sessions() {
    let config = Config { session_count: 1, ..Config::on_free_port() };
    let server = Running::with(config, TraverseEngines).await;
    let mut client = server.client().await;
    let mut first = Talk::open(&mut client).await.expect("opened");
    first.changed(Step::Scene(one_block())).await;
    let status = Talk::open(&mut client).await.err().expect("no place");
    assert_eq!((status.code(), reason(&status).as_str()), (Code::ResourceExhausted, "QUEUE_FULL"));
    assert_eq!(status.get_details_retry_info().expect("there").retry_delay, Some(RETRY_AFTER));
    drop(first);
    let again = async {
        loop {
            match Talk::open(&mut client).await {
                Ok(talk) => return talk,
                Err(status) => assert_eq!(reason(&status), "QUEUE_FULL"),
            }
        }
    };
    tokio::time::timeout(HANG, again).await.expect("its place is free again");
}

#[tokio::test]
async fn scenes_of_all_sessions_together_are_bounded() {
    let limits = traverse_proto::Limits { vertex_count: 6, ..Default::default() };
    let config = Config { session_vertex_count: 6, limits, ..Config::on_free_port() };
    let server = Running::with(config, TraverseEngines).await;
    let mut client = server.client().await;
    let mut first = Talk::open(&mut client).await.expect("opened");
    let mut second = Talk::open(&mut client).await.expect("opened");
    first.changed(Step::Scene(one_block())).await;
    let problem = second.problem(Step::Scene(one_block())).await;
    assert_eq!((problem.code, problem.reason.as_str()), (Code::ResourceExhausted.into(), "QUEUE_FULL"));
    assert_eq!(second.problem(Step::Query(past())).await.reason, "SCENE_STALE");
    first.changed(Step::Scene(Scene::default())).await;
    second.changed(Step::Scene(one_block())).await;
}

#[tokio::test]
async fn an_open_session_holds_no_worker() {
    let (engines, mut gate) = gated();
    let config = Config { workers: 1, queued_call_count: 1, ..Config::on_free_port() };
    let server = Running::with(config, engines).await;
    let mut client = server.client().await;
    let mut talk = Talk::open(&mut client).await.expect("opened");
    talk.changed(Step::Scene(one_block())).await;
    gate.open();
    // The only worker is free for calls while the session is open.
    client.plan_rapid_move(past_a_block()).await.expect("planned");
    gate.begun().await;
    assert!(matches!(talk.ask(Step::Query(past())).await, Outcome::Plan(_)));
    gate.begun().await;
}
