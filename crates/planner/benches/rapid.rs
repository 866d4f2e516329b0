//! Rapid moves against a peer, in the same run: Traverse's one-shot and prepared plans beside navigation meshes by the
//! crate `polyanya` (plain and merged). Prints microseconds and ratios. `cargo bench -p traverse-planner --bench rapid`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a bench stops where it can't go on"
)]

use glam::Vec2;
use polyanya::{Mesh, Triangulation};
use rand::RngExt;
use std::time::Instant;
use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, RapidRules, Ring, Scene, unit};
use traverse_planner::{Algorithm, Answer, PreparedScene, RapidMove, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

/// One obstacle per square of this side, millimetres.
const PITCH: f64 = 50.0;

fn main() {
    let full = std::env::args().any(|argument| argument == "--full");
    println!("one shot: a validated scene in, one path out; µs, median (90th percentile)");
    println!(
        "{:>6} {:>20} {:>20} {:>12} {:>9}",
        "N", "traverse", "polyanya build+query", "ratio", "clearance"
    );
    for (n, queries) in [(10, 400), (100, 400), (1000, 100), (10_000, if full { 40 } else { 10 })] {
        one_shot(n, queries);
    }
    println!("\nprepared: µs per query, least of 3 repeats, median (99th percentile)");
    println!(
        "{:>6} {:>18} {:>18} {:>18} {:>8} {:>9} {:>10}",
        "N", "traverse", "polyanya", "merged", "ratio", "clearance", "links"
    );
    for (n, queries) in [(10, 400), (100, 400), (1000, 200), (10_000, if full { 200 } else { 50 })] {
        prepared(n, queries);
    }
    println!("\nedits at N = 10000: µs, median (90th percentile)");
    edits(10_000, if full { 400 } else { 100 });
}

fn one_shot(n: usize, queries: usize) {
    let scene = scattered(n, 0.0);
    let cleared = Scene { clearance_mm: 1.5, ..scene.clone() };
    let moves = moves(&scene, queries);
    let (mut ours, mut theirs, mut round) = (Vec::new(), Vec::new(), Vec::new());
    for (at, query) in moves.iter().enumerate() {
        ours.push(timed(|| plan(&scene, query)).0);
        round.push(timed(|| plan(&cleared, query)).0);
        // Building a mesh takes far longer than a query: some of them do for the median.
        if at % (1 + n / 500) == 0 {
            theirs.push(timed(|| mesh(&scene, false).path(to_vec2(query.start), to_vec2(query.target))).0);
        }
    }
    let [ours, theirs, round] = [ours, theirs, round].map(sorted);
    println!(
        "{n:>6} {:>11.1} ({:>6.0}) {:>11.1} ({:>6.0}) {:>12.4} {:>8.2}x",
        share(&ours, 0.5),
        share(&ours, 0.9),
        share(&theirs, 0.5),
        share(&theirs, 0.9),
        share(&ours, 0.5) / share(&theirs, 0.5),
        share(&round, 0.5) / share(&ours, 0.5)
    );
}

fn prepared(n: usize, queries: usize) {
    let scene = scattered(n, 0.0);
    let moves = moves(&scene, queries);
    let (plain, merged) = (mesh(&scene, false), mesh(&scene, true));
    let mut kept = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
    let cleared = Scene { clearance_mm: 1.5, ..scene };
    let mut round = PreparedScene::new(cleared, &Budget::unlimited()).unwrap();
    let mut least = vec![[f64::INFINITY; 4]; moves.len()];
    for repeat in 0..4 {
        for (query, least) in moves.iter().zip(&mut least) {
            let (from, to) = (to_vec2(query.start), to_vec2(query.target));
            let times = [
                timed(|| kept.plan(query, &Budget::unlimited(), &mut Silent).is_ok()).0,
                timed(|| plain.path(from, to).map(|path| path.length)).0,
                timed(|| merged.path(from, to).map(|path| path.length)).0,
                timed(|| round.plan(query, &Budget::unlimited(), &mut Silent).is_ok()).0,
            ];
            // The first round works out what is seen from where.
            if repeat > 0 {
                least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
            }
        }
    }
    let of = |which: usize| sorted(least.iter().map(|times| times[which]).collect());
    let [ours, plain, merged, round] = [of(0), of(1), of(2), of(3)];
    let cell = |times: &[f64]| format!("{:>8.1} ({:>7.0})", share(times, 0.5), share(times, 0.99));
    println!(
        "{n:>6} {} {} {} {:>8.2} {:>8.2}x {:>10}",
        cell(&ours),
        cell(&plain),
        cell(&merged),
        share(&ours, 0.5) / share(&merged, 0.5),
        share(&round, 0.5) / share(&ours, 0.5),
        kept.link_count()
    );
}

fn edits(n: usize, count: usize) {
    let scene = scattered(n, 0.0);
    let moves = moves(&scene, 50);
    let mut kept = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
    let ask =
        |kept: &mut PreparedScene, query| timed(|| kept.plan(query, &Budget::unlimited(), &mut Silent)).0;
    for query in moves.iter().chain(&moves) {
        ask(&mut kept, query);
    }
    let mut random = Seed(5).stream();
    let (mut removed, mut put, mut slower) = (Vec::new(), Vec::new(), Vec::new());
    for round in 0..count {
        let obstacle = &scene.obstacles[random.random_range(0..n)];
        let query = &moves[round % moves.len()];
        let before = ask(&mut kept, query);
        removed.push(timed(|| kept.remove_obstacle(&obstacle.id)).0);
        slower.push(ask(&mut kept, query) - before);
        let again = obstacle.clone();
        put.push(timed(|| kept.put_obstacle(again, &Budget::unlimited())).0);
        slower.push(ask(&mut kept, query) - before);
    }
    for (name, times) in [("remove", removed), ("put", put), ("next query slower by", slower)] {
        let times = sorted(times);
        println!("{name:>22} {:>9.1} ({:>7.1})", share(&times, 0.5), share(&times, 0.9));
    }
}

/// Star-shaped obstacles of 5 to 11 corners, one in every square of a field, within a work area.
fn scattered(n: usize, clearance_mm: f64) -> Scene {
    let mut random = Seed(n as u64).stream();
    let columns = (n as f64).sqrt().ceil();
    let obstacles = (0..n)
        .map(|i| {
            let (column, row) = ((i as f64) % columns, ((i as f64) / columns).floor());
            let aside = || Point::new((column + 0.5) * PITCH, (row + 0.5) * PITCH);
            let size: f64 = random.random_range(8.0..20.0);
            let free = PITCH / 2.0 - size - 2.0;
            let jitter = |random: &mut dyn FnMut() -> f64| random() * free;
            let mut draw = || random.random_range(-1.0..1.0);
            let center = aside() + traverse_geometry::Vector::new(jitter(&mut draw), jitter(&mut draw));
            let corners = random.random_range(5..12);
            let step = std::f64::consts::TAU / f64::from(corners);
            let points = (0..corners).map(|corner| {
                let angle = step * (f64::from(corner) + random.random_range(0.1..0.9));
                center + unit(angle) * size * random.random_range(0.4..1.0)
            });
            let ring = Ring::new(points.collect(), vec![]).unwrap();
            Obstacle {
                id: format!("o{i}"),
                shape: Polygon::from_ring(ring),
                clearance_mm: None,
                top_z_mm: None,
            }
        })
        .collect();
    let side = columns * PITCH + 10.0;
    let border = [(-10.0, -10.0), (side, -10.0), (side, side), (-10.0, side)];
    let border = Ring::new(border.map(|(x, y)| Point::new(x, y)).to_vec(), vec![]).unwrap();
    Scene {
        work_area: Some(Polygon::from_ring(border)),
        obstacles,
        clearance_mm,
        work_area_clearance_mm: Some(0.0),
        corner_style: CornerStyle::Round,
    }
}

/// Moves between free points, some millimetres away from everything.
fn moves(scene: &Scene, count: usize) -> Vec<RapidMove> {
    let mut random = Seed(99).stream();
    let bounds = scene.work_area.as_ref().unwrap().bounds();
    let mut free = || loop {
        let x = random.random_range(bounds.min.x + 3.0..bounds.max.x - 3.0);
        let p = Point::new(x, random.random_range(bounds.min.y + 3.0..bounds.max.y - 3.0));
        if scene.obstacles.iter().all(|obstacle| !obstacle.shape.bounds().grown(2.0).contains(p)) {
            return p;
        }
    };
    (0..count)
        .map(|_| RapidMove {
            start: free(),
            target: free(),
            algorithm: Algorithm::Exact,
            rules: RapidRules::default(),
        })
        .collect()
}

fn plan(scene: &Scene, query: &RapidMove) -> f64 {
    match plan_rapid_move(scene, query, &Budget::unlimited(), &mut Silent) {
        Ok((Answer::Plan(plan), _)) => plan.cost,
        other => panic!("no plan: {other:?}"),
    }
}

fn mesh(scene: &Scene, merged: bool) -> Mesh {
    let ring = |ring: &Ring| ring.vertices().iter().map(|&p| to_vec2(p)).collect::<Vec<_>>();
    let mut triangulation = Triangulation::from_outer_edges(&ring(scene.work_area.as_ref().unwrap().outer()));
    triangulation.add_obstacles(scene.obstacles.iter().map(|obstacle| ring(obstacle.shape.outer())));
    let mut mesh = triangulation.as_navmesh();
    if merged {
        for layer in &mut mesh.layers {
            while layer.merge_polygons() {}
        }
    }
    mesh.bake();
    mesh
}

fn to_vec2(p: Point) -> Vec2 {
    Vec2::new(p.x as f32, p.y as f32)
}

/// Microseconds that `work` takes, and what it gives.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let began = Instant::now();
    let result = std::hint::black_box(work());
    (began.elapsed().as_secs_f64() * 1e6, result)
}

fn sorted(mut times: Vec<f64>) -> Vec<f64> {
    times.sort_by(f64::total_cmp);
    times
}

fn share(sorted: &[f64], share: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * share) as usize]
}
