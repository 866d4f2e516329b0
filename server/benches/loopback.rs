//! What the wire costs: PlanRapidMove over a real socket against the engine alone, one call after the other.
//! `cargo bench -p traverse-server --bench loopback`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a bench stops where it can't go on"
)]

use std::time::{Duration, Instant};
use tonic::transport::Channel;
use traverse_proto::v1::planner_service_client::PlannerServiceClient;
use traverse_proto::v1::{self, GetLimitsRequest};
use traverse_proto::{Limits, PlanQuestion};
use traverse_server::{Config, Engines, Server, TraverseEngines};
use traverse_solve::Budget;

#[tokio::main]
async fn main() {
    let server =
        Server::new(Config { listen: ([127, 0, 0, 1], 0).into(), ..Config::default() }).expect("sound");
    let listener = server.bind().await.expect("a free port");
    let uri = format!("http://{}", listener.local_addr().expect("bound"));
    tokio::spawn(server.serve(listener, std::future::pending()));
    let mut client = PlannerServiceClient::connect(uri).await.expect("it listens");

    let floor = limits(&mut client).await;
    println!("GetLimits, the floor of a call: {floor:.1?}");
    println!("{:>9} {:>12} {:>12} {:>12} {:>8}", "obstacles", "call", "decoded", "engine", "ratio");
    for side in [3, 10, 32, 100] {
        let request = grid(side);
        let call = call(&mut client, &request).await;
        let (decoded, engine) = in_process(&request);
        let ratio = call.as_secs_f64() / (decoded + engine).as_secs_f64();
        println!("{:>9} {call:>12.1?} {decoded:>12.1?} {engine:>12.1?} {ratio:>8.2}", side * side);
    }
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

const CALLS: usize = 200;

async fn limits(client: &mut PlannerServiceClient<Channel>) -> Duration {
    let mut times = Vec::new();
    for _ in 0..CALLS {
        let began = Instant::now();
        client.get_limits(GetLimitsRequest::default()).await.expect("answered");
        times.push(began.elapsed());
    }
    median(times)
}

async fn call(client: &mut PlannerServiceClient<Channel>, request: &v1::PlanRapidMoveRequest) -> Duration {
    let mut times = Vec::new();
    for _ in 0..CALLS {
        let request = request.clone();
        let began = Instant::now();
        client.plan_rapid_move(request).await.expect("answered");
        times.push(began.elapsed());
    }
    median(times)
}

/// Reading and validating the request, and planning, without a socket.
fn in_process(request: &v1::PlanRapidMoveRequest) -> (Duration, Duration) {
    let budget = Budget::unlimited();
    let (mut decoded, mut planned) = (Vec::new(), Vec::new());
    for _ in 0..CALLS {
        let request = request.clone();
        let began = Instant::now();
        let question = PlanQuestion::from_wire(request, &Limits::default(), &budget).expect("sound");
        decoded.push(began.elapsed());
        let began = Instant::now();
        TraverseEngines.plan_rapid_move(&question.scene, &question.query, &budget).expect("planned");
        planned.push(began.elapsed());
    }
    (median(decoded), median(planned))
}

/// Octagons on a grid, from one corner to the other.
fn grid(side: usize) -> v1::PlanRapidMoveRequest {
    let octagon = |i: usize| {
        let (x, y) = ((i % side) as f64 * 30.0, (i / side) as f64 * 30.0);
        let corners = [(4, 0), (10, 0), (14, 4), (14, 10), (10, 14), (4, 14), (0, 10), (0, 4)];
        let xy_mm =
            corners.iter().flat_map(|&(dx, dy)| [x + f64::from(dx) + (i % 7) as f64, y + f64::from(dy)]);
        let outer = v1::Ring { xy_mm: xy_mm.collect(), bulges: vec![] };
        let shape = v1::Polygon { outer: Some(outer), holes: vec![] };
        v1::Obstacle { id: format!("o{i}"), shape: Some(shape), clearance_mm: None, top_z_mm: None }
    };
    let end = side as f64 * 30.0;
    v1::PlanRapidMoveRequest {
        scene: Some(v1::Scene {
            obstacles: (0..side * side).map(octagon).collect(),
            clearance_mm: 2.0,
            ..Default::default()
        }),
        start: Some(v1::Point { x_mm: -10.0, y_mm: -8.0 }),
        target: Some(v1::Point { x_mm: end, y_mm: end - 7.0 }),
        ..Default::default()
    }
}
