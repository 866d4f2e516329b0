//! What other costs and other ways of running a route take, beside the shortest one, in the same run: one shot each,
//! scattered obstacles at a clearance; the same for tool changes and for alternatives.
//! `cargo bench -p traverse-planner --bench costs`.
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
use traverse_planner::{
    Algorithm, Answer, RapidMove, Refusal, ToolChange, ToolChangeAnswer, plan_rapid_move, plan_tool_change,
};
use traverse_solve::{Budget, Seed, Silent};

/// One obstacle per square of this side, millimetres.
const PITCH: f64 = 50.0;

fn main() {
    println!("one shot, clearance 1.5 mm: median µs (most), ratio to length, share of plans that are proven");
    for (n, queries) in [(10, 100), (100, 60), (1000, 12)] {
        let scene = scattered(n);
        let moves = moves(&scene, queries);
        section(n, "", rules(), &moves, |rules, [start, target]| {
            let query = RapidMove { start, target, algorithm: Algorithm::Exact, rules: rules.clone() };
            match plan_rapid_move(&scene, &query, &Budget::unlimited(), &mut Silent) {
                Ok((Answer::Plan(plan), _)) => Some(plan.cost == plan.lower_bound),
                refused => told(refused.err()),
            }
        });
        let with_others = rules().map(|(name, rules)| (name, RapidRules { alternative_count: 4, ..rules }));
        // Some of these end where memory does, after seconds.
        let few = &moves[..moves.len().min(6)];
        section(n, "4 alternatives, ", with_others, few, |rules, [start, target]| {
            let query = RapidMove { start, target, algorithm: Algorithm::Exact, rules: rules.clone() };
            match plan_rapid_move(&scene, &query, &Budget::unlimited(), &mut Silent) {
                Ok((Answer::Plan(plan), _)) => Some(plan.alternatives.len() == 4),
                refused => told(refused.err()),
            }
        });
        section(n, "tool change, ", rules(), &moves, |rules, [start, target]| {
            let question = ToolChange {
                start,
                target,
                regions: vec![region(&scene)],
                points: Vec::new(),
                place_z_mm: None,
                rules: rules.clone(),
            };
            match plan_tool_change(&scene, &question, &Budget::unlimited(), &mut Silent) {
                Ok((ToolChangeAnswer::Plan(plan), _)) => Some(plan.cost <= plan.lower_bound * (1.0 + 1e-9)),
                refused => told(refused.err()),
            }
        });
    }
}

/// Says why there is no plan.
fn told(refused: Option<Vec<Refusal>>) -> Option<bool> {
    println!("       no plan: {refused:?}");
    None
}

/// Times every rule over all moves; `run` answers whether a plan is proven, or complete.
fn section(
    n: usize,
    what: &str,
    rules: impl IntoIterator<Item = (&'static str, RapidRules)>,
    moves: &[[Point; 2]],
    run: impl Fn(&RapidRules, [Point; 2]) -> Option<bool>,
) {
    let mut shortest = 0.0;
    for (name, rules) in rules {
        let mut times = Vec::new();
        let mut proven = 0;
        for &ends in moves {
            let began = Instant::now();
            let is_proven = run(&rules, ends);
            times.push(began.elapsed().as_secs_f64() * 1e6);
            proven += usize::from(is_proven == Some(true));
        }
        times.sort_by(f64::total_cmp);
        let (median, most) = (times[times.len() / 2], times[times.len() - 1]);
        if shortest == 0.0 {
            shortest = median;
        }
        let proven = 100.0 * proven as f64 / moves.len() as f64;
        let name = format!("{what}{name}");
        println!(
            "{n:>6} {name:<36} {median:>11.1} ({most:>11.1}) {:>7.2} × {proven:>4.0} %",
            median / shortest
        );
    }
}

/// A square in the middle of the scene, three pitches wide: several obstacles lie in it.
fn region(scene: &Scene) -> Polygon {
    let side = (scene.obstacles.len() as f64).sqrt().ceil() * PITCH;
    let [low, high] = [side / 2.0 - 1.5 * PITCH, side / 2.0 + 1.5 * PITCH];
    let corners = [(low, low), (high, low), (high, high), (low, high)];
    let ring = Ring::new(corners.map(|(x, y)| Point::new(x, y)).to_vec(), vec![]).unwrap();
    Polygon::from_ring(ring)
}

fn rules() -> [(&'static str, RapidRules); 6] {
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
    [
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
fn moves(scene: &Scene, count: usize) -> Vec<[Point; 2]> {
    let mut random = Seed(99).stream();
    let columns = (scene.obstacles.len() as f64).sqrt().ceil();
    let mut corner = || {
        let [x, y] = [0, 1].map(|_| random.random_range(0.0..columns).round() * PITCH);
        Point::new(x, y)
    };
    (0..count).map(|_| [corner(), corner() + traverse_geometry::Vector::new(1.0, 2.0)]).collect()
}
