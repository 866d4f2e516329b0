//! How long work goes on after its caller is gone: the worst of many cancels at random moments, for the largest
//! requests that the limits permit. `cargo bench -p traverse-server --bench cancel [-- WORD…]`: work whose name holds a word.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a bench stops where it can't go on"
)]

use rand::RngExt;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};
use traverse_geometry::Scene;
use traverse_planner::SceneEdit;
use traverse_proto::{CheckQuestion, Limits, OrderQuestion, PlanQuestion, ToolChangeQuestion, v1};
use traverse_server::{Engines, TraverseEngines};
use traverse_solve::{Budget, CancelToken, Seed, Silent};

/// Cancels per request and engine.
const CANCELS: u64 = 40;

fn main() {
    println!("{:<34} {:>10} {:>12} {:>12}", "work", "whole", "median stop", "worst stop");
    for (name, request) in requests() {
        measure(&format!("plan {name}"), |budget| {
            let question = PlanQuestion::from_wire(request.clone(), &Limits::default(), budget);
            question.is_ok_and(|question| {
                TraverseEngines.plan_rapid_move(&question.scene, &question.query, budget).is_ok()
            })
        });
        let steps = vec![line_to(request.target.expect("set"))];
        let path = v1::Path { start: request.start, steps, ..Default::default() };
        let check = v1::CheckRapidMoveRequest {
            request: Some(request.clone()),
            path: Some(path),
            tolerance_mm: None,
        };
        measure(&format!("check {name}"), |budget| {
            let question = CheckQuestion::from_wire(check.clone(), &Limits::default(), budget);
            question.is_ok_and(|question| TraverseEngines.check_rapid_move(&question, budget).is_some())
        });
        let budget = Budget::unlimited();
        let question = PlanQuestion::from_wire(request.clone(), &Limits::default(), &budget).unwrap();
        measure(&format!("session {name}"), |budget| session(&question, budget));
        let change = change(&request);
        measure(&format!("tool change {name}"), |budget| {
            let question = ToolChangeQuestion::from_wire(change.clone(), &Limits::default(), budget);
            question.is_ok_and(|question| {
                TraverseEngines.place_tool_change(&question.scene, &question.change, budget).is_ok()
            })
        });
    }
    let sections = sections(10_000);
    measure("order 10000 sections", |budget| {
        let question = OrderQuestion::from_wire(sections.clone(), &Limits::default(), budget);
        question.is_ok_and(|question| TraverseEngines.order_sections(&question, budget, &mut Silent).is_ok())
    });
}

/// An empty scene to which all obstacles are put; it is triangulated, and one move planned.
fn session(question: &PlanQuestion, budget: &Budget) -> bool {
    let empty = Scene { obstacles: vec![], ..question.scene.clone() };
    let put = question.scene.obstacles.clone();
    let Ok(mut scene) = TraverseEngines.prepare_scene(empty, budget) else { return false };
    scene.edit(SceneEdit { put, remove: vec![] }, budget).is_ok()
        && scene.triangulate(budget).is_ok()
        && TraverseEngines.plan_in_scene(&mut scene, &question.query, budget).is_ok()
}

/// A tool change far aside of a rapid move.
fn change(request: &v1::PlanRapidMoveRequest) -> v1::PlaceToolChangeRequest {
    let xy_mm = vec![-5100.0, 3000.0, -5000.0, 3000.0, -5000.0, 3100.0, -5100.0, 3100.0];
    let outer = Some(v1::Ring { xy_mm, bulges: vec![] });
    v1::PlaceToolChangeRequest {
        scene: request.scene.clone(),
        start: request.start,
        target: request.target,
        regions: vec![v1::Polygon { outer, holes: vec![] }],
        ..Default::default()
    }
}

/// Ragged sections of 16 corners.
fn sections(count: usize) -> v1::OrderSectionsRequest {
    let mut random = Seed(1).stream();
    let sections = (0..count).map(|i| {
        let mut edge = |x: f64| (0..8).map(|_| x + random.random_range(-9.0..9.0)).collect::<Vec<f64>>();
        let (left, right) = (edge(10.0), edge(60.0));
        let up = right.iter().enumerate().map(|(at, &x)| [x, at as f64 * 10.0]);
        let down = left.iter().enumerate().rev().map(|(at, &x)| [x, at as f64 * 10.0]);
        let outer = Some(v1::Ring { xy_mm: up.chain(down).flatten().collect(), bulges: vec![] });
        let shape = Some(v1::Polygon { outer, holes: vec![] });
        let part = v1::Part { id: "p".to_owned(), shape, ..Default::default() };
        v1::Section { id: format!("s{i}"), parts: vec![part], ..Default::default() }
    });
    v1::OrderSectionsRequest { sections: sections.collect(), gap_mm: 1.0, ..Default::default() }
}

/// Runs `work` to its end once, or for 2 s, then cancels it at random moments of that time.
fn measure(name: &str, work: impl Fn(&Budget) -> bool + Sync) {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    if !wanted.is_empty() && !wanted.iter().any(|word| name.contains(word.as_str())) {
        return;
    }
    let began = Instant::now();
    work(&Budget { deadline: Some(began + Duration::from_secs(2)), ..Budget::unlimited() });
    let whole = began.elapsed();
    let mut stops: Vec<Duration> = (0..CANCELS)
        .map(|trial| {
            let after = whole.mul_f64(Seed(trial).stream().random_range(0.0..1.0));
            let cancel = CancelToken::new();
            let budget = Budget { cancel: cancel.clone(), ..Budget::unlimited() };
            std::thread::scope(|scope| {
                let worker = scope.spawn(|| {
                    work(&budget);
                    Instant::now()
                });
                std::thread::sleep(after);
                let cancelled = Instant::now();
                cancel.cancel();
                worker.join().expect("no panic").saturating_duration_since(cancelled)
            })
        })
        .collect();
    stops.sort();
    println!(
        "{name:<34} {:>7.1} ms {:>9.1} ms {:>9.1} ms",
        whole.as_secs_f64() * 1e3,
        stops[stops.len() / 2].as_secs_f64() * 1e3,
        stops[stops.len() - 1].as_secs_f64() * 1e3
    );
}

/// Scenes as large as the limits permit: one star, one comb, many squares, touching squares.
fn requests() -> Vec<(&'static str, v1::PlanRapidMoveRequest)> {
    let vertices = Limits::default().vertex_count;
    let star = |i: usize| {
        let radius = if i.is_multiple_of(2) { 4000.0 } else { 4000.2 };
        let angle = TAU * i as f64 / vertices as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let teeth = vertices / 4 - 1;
    let comb = |i: usize| {
        let x = i as f64 * 0.1;
        [x, 100.0, x + 0.05, 100.0, x + 0.05, 99.0, x + 0.1, 99.0]
    };
    let mut comb: Vec<f64> = (0..teeth).flat_map(comb).collect();
    comb.extend([teeth as f64 * 0.1, 200.0, 0.0, 200.0]);
    let squares = |gap: f64| {
        let count = vertices / 4;
        let columns = (count as f64).sqrt() as usize;
        (0..count)
            .map(|i| {
                let (x, y) = ((i % columns) as f64 * (10.0 + gap), (i / columns) as f64 * (10.0 + gap));
                vec![x, y, x + 10.0, y, x + 10.0, y + 10.0, x, y + 10.0]
            })
            .take(Limits::default().obstacle_count)
            .collect::<Vec<_>>()
    };
    vec![
        ("star", request(vec![(0..vertices).flat_map(star).collect()], (-5000.0, 10.0), (5000.0, 10.0))),
        ("comb", request(vec![comb], (-10.0, 99.5), (6300.0, 99.5))),
        ("squares", request(squares(5.0), (-5.0, -5.0), (3400.0, 3400.0))),
        ("touching squares", request(squares(0.0), (-5.0, -5.0), (2400.0, 2400.0))),
    ]
}

fn request(rings: Vec<Vec<f64>>, start: (f64, f64), target: (f64, f64)) -> v1::PlanRapidMoveRequest {
    let obstacles = rings.into_iter().enumerate().map(|(i, xy_mm)| {
        let outer = v1::Ring { xy_mm, bulges: vec![] };
        let shape = v1::Polygon { outer: Some(outer), holes: vec![] };
        v1::Obstacle { id: format!("o{i}"), shape: Some(shape), clearance_mm: None, top_z_mm: None }
    });
    let point = |(x_mm, y_mm): (f64, f64)| Some(v1::Point { x_mm, y_mm });
    v1::PlanRapidMoveRequest {
        scene: Some(v1::Scene { obstacles: obstacles.collect(), clearance_mm: 0.01, ..Default::default() }),
        start: point(start),
        target: point(target),
        ..Default::default()
    }
}

fn line_to(end: v1::Point) -> v1::PathStep {
    v1::PathStep { end: Some(end), ..Default::default() }
}
