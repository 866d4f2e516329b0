//! Generated input through the whole house: decode, validate, plan, check. Whatever comes, nothing breaks, and no plan is answered
//! that the checker rejects.

use crate::http::post;
use crate::request::{obstacle, past_a_block, point};
use http::Response;
use http_body_util::BodyExt;
use prost::Message;
use rand::RngExt;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus as Stream;
use tower::ServiceExt;
use traverse_proto::v1::{self, plan_rapid_move_response::Outcome};
use traverse_server::{Config, HttpService, Server};

const CASES: u64 = 1500;

/// Numbers that break things, and some that do not.
const NUMBERS: [f64; 14] =
    [0.0, -0.0, 1.0, 2.0, 3.0, 5.0, -4.0, 10.0, 1e-300, 1e6, -1e6, 1e308, f64::NAN, f64::INFINITY];

fn number(stream: &mut Stream) -> f64 {
    // Mostly a small grid, where edges touch, coincide and cross.
    if stream.random_range(0..100) < 96 {
        f64::from(stream.random_range(-12_i32..=12))
    } else {
        NUMBERS[stream.random_range(0..NUMBERS.len())]
    }
}

fn ring(stream: &mut Stream) -> v1::Ring {
    let (x, y) = (number(stream), number(stream));
    let (right, top) = (x + number(stream).abs() + 1.0, y + number(stream).abs() + 1.0);
    let mut xy_mm = vec![x, y, right, y, right, top, x, top];
    if stream.random_range(0..4) == 0 {
        xy_mm = (0..stream.random_range(0..9)).map(|_| number(stream)).collect();
    }
    let bulges = if stream.random_range(0..4) == 0 {
        (0..xy_mm.len() / 2).map(|_| f64::from(stream.random_range(-2_i32..=2)) / 2.0).collect()
    } else {
        vec![]
    };
    v1::Ring { xy_mm, bulges }
}

fn request(stream: &mut Stream) -> v1::PlanRapidMoveRequest {
    let shape = |stream: &mut Stream| v1::Polygon { outer: Some(ring(stream)), holes: vec![] };
    let obstacles =
        (0..stream.random_range(0..4)).map(|i| obstacle(&format!("o{i}"), shape(stream))).collect();
    let scene = v1::Scene {
        obstacles,
        clearance_mm: f64::from(stream.random_range(0_i32..=2)),
        corner_style: stream.random_range(0..=2),
        work_area: (stream.random_range(0..8) == 0).then(|| shape(stream)),
        ..Default::default()
    };
    let ends = [0; 4].map(|_| f64::from(stream.random_range(-30_i32..=30)));
    v1::PlanRapidMoveRequest {
        scene: Some(scene),
        start: point(ends[0], ends[1]),
        target: point(ends[2], ends[3]),
        ..past_a_block()
    }
}

async fn call(service: &HttpService, method: &str, message: Vec<u8>) -> Response<bytes::Bytes> {
    let path = format!("/traverse.v1.PlannerService/{method}");
    let answer =
        service.clone().oneshot(post(&path, "application/proto", message)).await.expect("never fails");
    let (head, body) = answer.into_parts();
    Response::from_parts(head, body.collect().await.expect("all of it").to_bytes())
}

#[tokio::test]
async fn no_plan_is_answered_that_the_checker_rejects() {
    let service = Server::new(Config::on_free_port()).expect("sound").http_service();
    let mut planned = 0;
    for seed in 0..CASES {
        let request = request(&mut Stream::seed_from_u64(seed));
        let answer = call(&service, "PlanRapidMove", request.encode_to_vec()).await;
        let text = String::from_utf8_lossy(answer.body()).into_owned();
        assert!([200, 400].contains(&answer.status().as_u16()), "seed {seed}: {text}");
        if answer.status() != 200 {
            continue;
        }
        let answer = v1::PlanRapidMoveResponse::decode(answer.into_body()).expect("its own message");
        let Some(Outcome::Plan(plan)) = answer.outcome else { continue };
        planned += 1;
        let check = v1::CheckRapidMoveRequest { request: Some(request), path: plan.path, tolerance_mm: None };
        let found = call(&service, "CheckRapidMove", check.encode_to_vec()).await;
        let found = v1::CheckRapidMoveResponse::decode(found.into_body()).expect("its own message");
        assert_eq!(found.violations, [], "seed {seed}");
    }
    assert!(planned > CASES / 10, "only {planned} of {CASES} requests were sound");
}

#[tokio::test]
async fn changed_bytes_are_answered_or_refused() {
    let service = Server::new(Config::on_free_port()).expect("sound").http_service();
    let whole = past_a_block().encode_to_vec();
    for seed in 0..CASES {
        let mut stream = Stream::seed_from_u64(seed);
        let mut bytes = whole.clone();
        for _ in 0..stream.random_range(1..6) {
            let at = stream.random_range(0..bytes.len());
            match stream.random_range(0..3) {
                0 => bytes[at] = stream.random(),
                1 => bytes.truncate(at.max(1)),
                _ => bytes.insert(at, stream.random()),
            }
        }
        let answer = call(&service, "PlanRapidMove", bytes).await;
        let text = String::from_utf8_lossy(answer.body()).into_owned();
        assert!([200, 400].contains(&answer.status().as_u16()), "seed {seed}: {text}");
    }
}
