//! Stopping: not serving, no new connections, a grace for what runs, then an end.

use crate::bad_input::reason;
use crate::gate::gated;
use crate::request::past_a_block;
use crate::running::{HANG, Running};
use std::time::Duration;
use tokio::net::TcpStream;
use tokio_stream::StreamExt;
use tonic::Code;
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;
use traverse_server::Config;
use traverse_solve::Interrupt;

#[tokio::test]
async fn what_runs_may_end_and_nothing_new_begins() {
    let (engines, mut gate) = gated();
    let config = Config { drain_grace: HANG, ..Config::on_free_port() };
    let server = Running::with(config, engines).await;
    let address = server.address;
    let mut watch = HealthClient::new(server.channel().await);
    let mut watch = watch.watch(HealthCheckRequest::default()).await.expect("served").into_inner();
    assert_eq!(watch.next().await.expect("one").expect("sound").status(), ServingStatus::Serving);
    let mut client = server.client().await;
    let call = tokio::spawn(async move { client.plan_rapid_move(past_a_block()).await });
    gate.begun().await;

    let served = server.stop();
    assert_eq!(watch.next().await.expect("one more").expect("sound").status(), ServingStatus::NotServing);
    // Health changes before the listener closes: ask until it has.
    let refused = async { while TcpStream::connect(address).await.is_ok() {} };
    tokio::time::timeout(HANG, refused).await.expect("it stops listening");
    assert!(!served.is_finished(), "a call is still running");
    gate.open();
    call.await.expect("no panic").expect("it was let through");
    // The watch is still held: it ends by itself and does not hold the grace.
    let end = watch.next().await.expect("one more").expect_err("the end");
    assert_eq!(end.code(), Code::Unavailable, "{end}");
    tokio::time::timeout(HANG, served).await.expect("no hang").expect("no panic").expect("served");
}

#[tokio::test]
async fn after_the_grace_calls_are_cancelled_and_open_streams_do_not_matter() {
    let (engines, mut gate) = gated();
    let config = Config { drain_grace: Duration::from_millis(50), ..Config::on_free_port() };
    let server = Running::with(config, engines).await;
    let mut health = HealthClient::new(server.channel().await);
    let mut watch = health.watch(HealthCheckRequest::default()).await.expect("served").into_inner();
    watch.next().await.expect("one").expect("sound");
    let mut client = server.client().await;
    let call = tokio::spawn(async move { client.plan_rapid_move(past_a_block()).await });
    gate.begun().await;
    let served = server.stop();
    let status = call.await.expect("no panic").expect_err("it was cut short");
    assert_eq!((status.code(), reason(&status).as_str()), (Code::Unavailable, "SERVER_DRAINING"), "{status}");
    assert_eq!(gate.ended().await, Some(Interrupt::Cancelled));
    tokio::time::timeout(HANG, served).await.expect("no hang").expect("no panic").expect("served");
}
