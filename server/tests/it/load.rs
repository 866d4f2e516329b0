//! Admission, deadlines, cancel, panics.

use crate::bad_input::reason;
use crate::gate::gated;
use crate::http::{post, send};
use crate::request::{PAST_A_BLOCK, past_a_block, with_time_limit};
use crate::running::{HANG, Running};
use bytes::Bytes;
use http::HeaderValue;
use http_body_util::Full;
use hyper_util::rt::TokioIo;
use prost::Message;
use std::time::{Duration, Instant};
use tokio::net::TcpStream;
use tonic::Code;
use tonic_types::StatusExt;
use traverse_server::{Config, RETRY_AFTER};
use traverse_solve::Interrupt;

const JSON_PATH: &str = "/traverse.v1.PlannerService/PlanRapidMove";

fn one_worker(queued_call_count: usize) -> Config {
    Config { workers: 1, queued_call_count, ..Config::on_free_port() }
}

#[tokio::test]
async fn a_full_queue_answers_at_once_for_all_connections_together() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(1), engines).await;
    let mut first = server.client().await;
    let first = tokio::spawn(async move { first.plan_rapid_move(past_a_block()).await });
    gate.begun().await;
    // One worker is busy: of two more calls one waits and one is refused, whichever comes first.
    let (mut a, mut b) = (server.client().await, server.client().await);
    let mut a = tokio::spawn(async move { a.plan_rapid_move(past_a_block()).await });
    let mut b = tokio::spawn(async move { b.plan_rapid_move(past_a_block()).await });
    let (refused, waiting) = tokio::select! {
        refused = &mut a => (refused, b),
        refused = &mut b => (refused, a),
    };
    let status = refused.expect("no panic").expect_err("the queue is full");
    assert_eq!(
        (status.code(), reason(&status).as_str()),
        (Code::ResourceExhausted, "QUEUE_FULL"),
        "{status}"
    );
    assert_eq!(status.get_details_retry_info().expect("there").retry_delay, Some(RETRY_AFTER));
    let json = send(server.address, post(JSON_PATH, "application/json", PAST_A_BLOCK)).await;
    assert_eq!((json.status.as_u16(), json.reason().as_str()), (429, "QUEUE_FULL"));
    gate.open();
    first.await.expect("no panic").expect("it was let through");
    waiting.await.expect("no panic").expect("it had its turn");
}

#[tokio::test]
async fn the_bodys_time_limit_stops_the_engine() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(4), engines).await;
    let request = with_time_limit(0, 30_000_000);
    let status = server.client().await.plan_rapid_move(request).await.expect_err("too slow");
    assert_eq!(
        (status.code(), reason(&status).as_str()),
        (Code::DeadlineExceeded, "TIME_LIMIT_REACHED"),
        "{status}"
    );
    assert_eq!(gate.ended().await, Some(Interrupt::Deadline));
    let bound = &status.get_details_error_info().expect("there").metadata["lower_bound"];
    assert_eq!(bound, "20", "what is known is told");
}

#[tokio::test]
async fn the_callers_timeout_is_answered_before_the_caller_gives_up() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(4), engines).await;
    // Over gRPC-Web by hand: tonic's own client would give up by itself.
    let mut request =
        post(JSON_PATH, "application/grpc-web+proto", crate::web::framed(&past_a_block().encode_to_vec()));
    request.headers_mut().insert("grpc-timeout", HeaderValue::from_static("200m"));
    let began = Instant::now();
    let answer = send(server.address, request).await;
    assert_eq!(answer.headers["grpc-status"], "4");
    assert_eq!(gate.ended().await, Some(Interrupt::Deadline));
    assert!(began.elapsed() >= Duration::from_millis(150), "the reserve is all that is kept back");

    let mut json = post(JSON_PATH, "application/json", PAST_A_BLOCK);
    json.headers_mut().insert("connect-timeout-ms", HeaderValue::from_static("100"));
    let answer = send(server.address, json).await;
    assert_eq!((answer.status.as_u16(), answer.reason().as_str()), (504, "TIME_LIMIT_REACHED"));
    assert_eq!(gate.ended().await, Some(Interrupt::Deadline));
}

#[tokio::test]
async fn the_servers_limit_counts_when_nobody_names_one_and_when_they_ask_for_more() {
    let (engines, mut gate) = gated();
    let short = Duration::from_millis(30);
    let config = Config { default_time_limit: short, longest_time_limit: short, ..one_worker(4) };
    let server = Running::with(config, engines).await;
    for request in [past_a_block(), with_time_limit(3600, 0), with_time_limit(i64::MAX, 0)] {
        let status = server.client().await.plan_rapid_move(request).await.expect_err("too slow");
        assert_eq!(reason(&status), "TIME_LIMIT_REACHED", "{status}");
        assert_eq!(gate.ended().await, Some(Interrupt::Deadline));
    }
}

#[tokio::test]
async fn waiting_in_the_queue_counts() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(4), engines).await;
    let mut client = server.client().await;
    let mut busy = client.clone();
    let busy = tokio::spawn(async move { busy.plan_rapid_move(past_a_block()).await });
    gate.begun().await;
    let status =
        client.plan_rapid_move(with_time_limit(0, 30_000_000)).await.expect_err("it never had a core");
    assert_eq!(reason(&status), "TIME_LIMIT_REACHED", "{status}");
    gate.open();
    busy.await.expect("no panic").expect("let through");
    assert!(!gate.has_begun(), "what nobody waits for does not run");
}

#[tokio::test]
async fn a_call_that_is_dropped_frees_its_core() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(4), engines).await;
    let mut client = server.client().await;
    let call = tokio::spawn(async move { client.plan_rapid_move(past_a_block()).await });
    gate.begun().await;
    let dropped = Instant::now();
    call.abort();
    assert_eq!(gate.ended().await, Some(Interrupt::Cancelled));
    assert!(dropped.elapsed() < Duration::from_secs(5), "{:?}", dropped.elapsed());
}

#[tokio::test]
async fn a_closed_connection_frees_its_core() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(4), engines).await;
    for content_type in ["application/json", "application/grpc-web+proto"] {
        let stream = TcpStream::connect(server.address).await.expect("it listens");
        let (mut sender, connection) =
            hyper::client::conn::http1::handshake(TokioIo::new(stream)).await.expect("HTTP/1.1");
        let connection = tokio::spawn(connection);
        let body = if content_type == "application/json" {
            Bytes::from(PAST_A_BLOCK)
        } else {
            crate::web::framed(&past_a_block().encode_to_vec())
        };
        let request: http::Request<Full<Bytes>> = post(JSON_PATH, content_type, body);
        let call = tokio::spawn(async move { sender.send_request(request).await.is_ok() });
        gate.begun().await;
        connection.abort();
        assert_eq!(gate.ended().await, Some(Interrupt::Cancelled), "{content_type}");
        call.abort();
    }
}

#[tokio::test]
async fn waiting_calls_whose_caller_is_gone_make_room() {
    let (engines, mut gate) = gated();
    let server = Running::with(one_worker(1), engines).await;
    let mut client = server.client().await;
    let mut busy = client.clone();
    let busy = tokio::spawn(async move { busy.plan_rapid_move(past_a_block()).await });
    gate.begun().await;
    for _ in 0..3 {
        // Each takes the only place in the queue and leaves it again; until the server hears of that, it is full.
        while let Ok(answer) =
            tokio::time::timeout(Duration::from_millis(30), client.plan_rapid_move(past_a_block())).await
        {
            assert_eq!(answer.map_err(|status| reason(&status)).err().as_deref(), Some("QUEUE_FULL"));
        }
    }
    gate.open();
    let last = async {
        while let Err(status) = client.plan_rapid_move(past_a_block()).await {
            assert_eq!(reason(&status), "QUEUE_FULL");
        }
    };
    tokio::time::timeout(HANG, last).await.expect("there is room again");
    busy.await.expect("no panic").expect("let through");
}
