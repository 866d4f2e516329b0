//! What a session answers in a second: PlanRapidMoves over a real socket, steps sent ahead of their answers, and what
//! share of that is whose. `cargo bench -p traverse-server --bench stream`, with `-- 400` for other counts of obstacles.
//!
//! *By the clock*: with one worker, while this client shares the machine with the server. *By one core*: by the processor time
//! of the whole process, server and client, which other work on the machine hardly changes. *Engine*: the same moves in a
//! prepared scene; *decoded*, *encoded*: messages to questions and answers to messages; all in processor time. The rest is the wire:
//! frames, HTTP/2, the socket, thread switches, and this client.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a bench stops where it can't go on"
)]

use prost::Message;
use rand::RngExt;
use std::time::{Duration, Instant};
use tokio_stream::StreamExt;
use tonic::transport::Channel;
use traverse_planner::{Answer, PreparedScene, Stats};
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::planner_service_client::PlannerServiceClient;
use traverse_proto::v1::{self, PlanRapidMovesRequest};
use traverse_proto::{Limits, StepQuestion, scene_from_wire, step_plan};
use traverse_server::{Config, Server};
use traverse_solve::{Budget, Seed, Silent};

/// Queries of one session.
const QUERIES: usize = 40_000;

/// Different moves among them.
const MOVES: usize = 400;

/// The least of so many counts.
const REPEATS: usize = 3;

/// One obstacle per square of this side, millimetres.
const PITCH: f64 = 50.0;

#[tokio::main]
async fn main() {
    let asked: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let server = Server::new(Config { workers: 1, ..Config::on_free_port() }).expect("sound");
    let listener = server.bind().await.expect("a free port");
    let uri = format!("http://{}", listener.local_addr().expect("bound"));
    tokio::spawn(server.serve(listener, std::future::pending()));
    let mut client = PlannerServiceClient::connect(uri).await.expect("it listens");

    println!("one worker, {QUERIES} queries, the least of {REPEATS}; processor time per query, µs");
    println!(
        "{:>9} {:>9} {:>12} {:>12} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "obstacles",
        "clearance",
        "by the clock",
        "by one core",
        "whole",
        "engine",
        "decoded",
        "encoded",
        "wire"
    );
    let counts = if asked.is_empty() { vec![0, 10, 100, 1000] } else { asked };
    for count in counts {
        for clearance in [0.0, 1.5] {
            measure(&mut client, count, clearance).await;
        }
    }
}

async fn measure(client: &mut PlannerServiceClient<Channel>, count: usize, clearance_mm: f64) {
    let scene = scattered(count, clearance_mm);
    let queries = moves(&scene, count);
    let mut least = [Duration::MAX; 5];
    for _ in 0..REPEATS {
        let (clock, whole) = session(client, &scene, &queries).await;
        let [engine, decoded, encoded] = alone(&scene, &queries);
        for (least, time) in least.iter_mut().zip([clock, whole, engine, decoded, encoded]) {
            *least = time.min(*least);
        }
    }
    let [clock, whole, engine, decoded, encoded] =
        least.map(|time| time.as_secs_f64() * 1e6 / QUERIES as f64);
    println!(
        "{count:>9} {clearance_mm:>9} {:>10.0}/s {:>10.0}/s {whole:>8.1} {engine:>8.1} {decoded:>8.2} {encoded:>8.2} {:>8.1}",
        1e6 / clock,
        1e6 / whole,
        whole - engine - decoded - encoded
    );
}

/// How long a session takes from its first query to its last answer, and the processor time of all of this process.
async fn session(
    client: &mut PlannerServiceClient<Channel>,
    scene: &v1::Scene,
    queries: &[v1::RapidQuery],
) -> (Duration, Duration) {
    let (send, steps) = tokio::sync::mpsc::channel(256);
    let steps = tokio_stream::wrappers::ReceiverStream::new(steps);
    let mut answers = client.plan_rapid_moves(steps).await.expect("opened").into_inner();
    let step = |step| PlanRapidMovesRequest { step_id: "n".to_owned(), step: Some(step) };
    send.send(step(Step::Scene(scene.clone()))).await.expect("open");
    // Every move once, so that what is seen from where is known.
    for query in queries {
        send.send(step(Step::Query(query.clone()))).await.expect("open");
        answers.next().await.expect("an answer").expect("sound");
    }
    answers.next().await.expect("an answer").expect("sound");
    let queries = queries.to_vec();
    let (began, used) = (Instant::now(), processor_time());
    let sending = tokio::spawn(async move {
        for i in 0..QUERIES {
            let query = queries[i % queries.len()].clone();
            send.send(PlanRapidMovesRequest { step_id: "n".to_owned(), step: Some(Step::Query(query)) })
                .await
                .expect("open");
        }
    });
    for _ in 0..QUERIES {
        let answer = answers.next().await.expect("an answer").expect("sound");
        assert!(matches!(answer.outcome, Some(Outcome::Plan(_) | Outcome::NoPath(_))), "{answer:?}");
    }
    let times = (began.elapsed(), processor_time() - used);
    sending.await.expect("no panic");
    times
}

/// Engine, decoding and encoding of the same queries, on this thread.
fn alone(scene: &v1::Scene, queries: &[v1::RapidQuery]) -> [Duration; 3] {
    let (limits, budget) = (Limits::default(), Budget::unlimited());
    let scene = scene_from_wire(scene.clone(), &limits, &budget).expect("sound");
    let mut prepared = PreparedScene::new(scene, &budget).expect("unlimited");
    let messages: Vec<Vec<u8>> = queries
        .iter()
        .map(|query| {
            let step = Some(Step::Query(query.clone()));
            PlanRapidMovesRequest { step_id: "n".to_owned(), step }.encode_to_vec()
        })
        .collect();
    let decode = |bytes: &Vec<u8>| {
        let Some(Step::Query(query)) = PlanRapidMovesRequest::decode(bytes.as_slice()).expect("encoded").step
        else {
            panic!("a query was encoded")
        };
        StepQuestion::from_wire(query, &limits, &budget).expect("sound").query
    };
    let questions: Vec<_> = messages.iter().map(decode).collect();
    let mut answers: Vec<(Answer, Stats)> = Vec::new();
    let plan = |prepared: &mut PreparedScene, answers: &mut Vec<_>, i: usize| {
        let answer = prepared.plan(&questions[i], &budget, &mut Silent).expect("free ends");
        if answers.len() < MOVES {
            answers.push(answer);
        }
    };
    (0..questions.len()).for_each(|i| plan(&mut prepared, &mut answers, i));
    let timed = |work: &mut dyn FnMut(usize)| {
        let used = processor_time();
        (0..QUERIES).for_each(|i| work(i % messages.len()));
        processor_time() - used
    };
    let engine = timed(&mut |i| plan(&mut prepared, &mut answers, i));
    let decoded = timed(&mut |i| {
        std::hint::black_box(decode(&messages[i]));
    });
    let mut out = Vec::new();
    let encoded = timed(&mut |i| {
        out.clear();
        let (answer, stats) = &answers[i];
        step_plan(answer, *stats, Duration::ZERO, Duration::ZERO).encode(&mut out).expect("room");
    });
    [engine, decoded, encoded]
}

/// Processor time of all threads of this process so far; zero where the system does not tell it as Linux does.
fn processor_time() -> Duration {
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let nanos = threads.filter_map(|thread| {
        let told = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        told.split_whitespace().next()?.parse::<u64>().ok()
    });
    Duration::from_nanos(nanos.sum())
}

/// Obstacles of 5 to 11 corners, one in each square of a grid.
fn scattered(count: usize, clearance_mm: f64) -> v1::Scene {
    let mut random = Seed(1).stream();
    let side = (count as f64).sqrt().ceil().max(1.0) as usize;
    let obstacle = |i: usize| {
        let at = |k: usize, random: &mut _| (k as f64 + RngExt::random_range(random, 0.4..0.6)) * PITCH;
        let (x, y) = (at(i % side, &mut random), at(i / side, &mut random));
        let corners = random.random_range(5..=11);
        let xy_mm = (0..corners).flat_map(|corner| {
            let angle = std::f64::consts::TAU * f64::from(corner) / f64::from(corners);
            let radius = PITCH * random.random_range(0.2..0.38);
            [x + radius * angle.cos(), y + radius * angle.sin()]
        });
        let outer = v1::Ring { xy_mm: xy_mm.collect(), bulges: vec![] };
        let shape = v1::Polygon { outer: Some(outer), holes: vec![] };
        v1::Obstacle { id: format!("o{i}"), shape: Some(shape), clearance_mm: None, top_z_mm: None }
    };
    let mut obstacle = obstacle;
    v1::Scene { obstacles: (0..count).map(&mut obstacle).collect(), clearance_mm, ..Default::default() }
}

/// Moves between free places.
fn moves(scene: &v1::Scene, count: usize) -> Vec<v1::RapidQuery> {
    let budget = Budget::unlimited();
    let scene = scene_from_wire(scene.clone(), &Limits::default(), &budget).expect("sound");
    let mut prepared = PreparedScene::new(scene, &budget).expect("unlimited");
    let mut random = Seed(2).stream();
    let side = (count as f64).sqrt().ceil().max(1.0) * PITCH;
    let mut moves = Vec::new();
    while moves.len() < MOVES {
        let mut at =
            || Some(v1::Point { x_mm: random.random_range(0.0..side), y_mm: random.random_range(0.0..side) });
        let query = v1::RapidQuery { start: at(), target: at(), rules: None };
        let question = StepQuestion::from_wire(query.clone(), &Limits::default(), &budget).expect("sound");
        if prepared.plan(&question.query, &budget, &mut Silent).is_ok() {
            moves.push(query);
        }
    }
    moves
}
