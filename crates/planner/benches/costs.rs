//! What other costs and other ways of running a route take, beside the shortest one, in the same run: one shot each,
//! scattered obstacles at a clearance. `cargo bench -p traverse-planner --bench costs`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a bench stops where it can't go on"
)]

use rand::RngExt;
use std::time::Instant;
use traverse_geometry::{
    ArcOutput, AxisSpeeds, CornerStyle, Kinematics, Obstacle, Point, Polygon, RapidMotion, RapidRules, Ring,
    Scene, TravelCost, unit,
};
use traverse_planner::{Algorithm, Answer, RapidMove, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

/// One obstacle per square of this side, millimetres.
const PITCH: f64 = 50.0;

fn main() {
    println!(
        "one shot, clearance 1.5 mm: median microseconds, ratio to length, share of plans that are proven"
    );
    for (n, queries) in [(100, 200), (1000, 60), (10_000, 10)] {
        let scene = scattered(n);
        let moves = moves(&scene, queries);
        let mut shortest = 0.0;
        for (name, rules) in rules() {
            let mut times = Vec::new();
            let mut proven = 0;
            for &(start, target) in &moves {
                let query = RapidMove { start, target, algorithm: Algorithm::Exact, rules: rules.clone() };
                let began = Instant::now();
                let answer = plan_rapid_move(&scene, &query, &Budget::unlimited(), &mut Silent);
                times.push(began.elapsed().as_secs_f64() * 1e6);
                match answer {
                    Ok((Answer::Plan(plan), _)) => proven += usize::from(plan.cost == plan.lower_bound),
                    other => panic!("no plan: {other:?}"),
                }
            }
            times.sort_by(f64::total_cmp);
            let median = times[times.len() / 2];
            if shortest == 0.0 {
                shortest = median;
            }
            let proven = 100.0 * proven as f64 / moves.len() as f64;
            println!("{n:>6} {name:<24} {median:>11.1} {:>7.2} × {proven:>4.0} %", median / shortest);
        }
    }
}

fn rules() -> Vec<(&'static str, RapidRules)> {
    let axes =
        |x: f64, y: f64| TravelCost::AxisSpeeds(AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 0.0 });
    let limits = Kinematics {
        speed_mm_per_s: 300.0,
        z_mm_per_s: 0.0,
        acceleration_mm_per_s2: 2000.0,
        junction_deviation_mm: 0.02,
        feed_mm_per_s: 100.0,
    };
    let by = |cost| RapidRules { cost, ..RapidRules::default() };
    vec![
        ("length", RapidRules::default()),
        ("length, chords", RapidRules { arcs: ArcOutput::Chords, ..RapidRules::default() }),
        ("axis speeds 1 : 1", by(axes(300.0, 300.0))),
        ("axis speeds 3 : 1", by(axes(300.0, 100.0))),
        (
            "dog-legs, chords",
            RapidRules { motion: RapidMotion::DogLeg, arcs: ArcOutput::Chords, ..by(axes(300.0, 200.0)) },
        ),
        ("kinematics", by(TravelCost::Kinematics(limits))),
    ]
}

/// Stars of 5 to 11 corners, one per square.
fn scattered(n: usize) -> Scene {
    let mut random = Seed(7).stream();
    let columns = (n as f64).sqrt().ceil() as usize;
    let obstacles = (0..n).map(|i| {
        let [column, row] = [i % columns, i / columns].map(|place| (place as f64 + 0.5) * PITCH);
        let corners = random.random_range(5..12);
        let points = (0..corners).map(|k| {
            let angle =
                std::f64::consts::TAU * (f64::from(k) + random.random_range(0.1..0.9)) / f64::from(corners);
            Point::new(column, row) + unit(angle) * random.random_range(8.0..22.0)
        });
        let ring = Ring::new(points.collect(), vec![]).unwrap();
        Obstacle { id: format!("o{i}"), shape: Polygon::from_ring(ring), clearance_mm: None, top_z_mm: None }
    });
    Scene {
        work_area: None,
        obstacles: obstacles.collect(),
        clearance_mm: 1.5,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    }
}

/// Ends beside squares' corners, where nothing is.
fn moves(scene: &Scene, count: usize) -> Vec<(Point, Point)> {
    let mut random = Seed(99).stream();
    let columns = (scene.obstacles.len() as f64).sqrt().ceil();
    let mut corner = || {
        let [x, y] = [0, 1].map(|_| random.random_range(0.0..columns).round() * PITCH);
        Point::new(x, y)
    };
    (0..count).map(|_| (corner(), corner() + traverse_geometry::Vector::new(1.0, 2.0))).collect()
}
