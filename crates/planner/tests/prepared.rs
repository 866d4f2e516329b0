//! Prepared scenes answer what fresh ones answer, also after edits in any order.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test stops where it can't go on"
)]

mod support;

use rand::RngExt;
use support::{assert_close, assert_sound, disc, mitred, point, query, scene, stars};
use traverse_geometry::{Obstacle, Polygon, Ring, Scene};
use traverse_planner::{Answer, PreparedScene, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

/// What a prepared scene answers is what a fresh one does.
fn assert_same(
    prepared: &mut PreparedScene,
    fresh: &Scene,
    start: (f64, f64),
    target: (f64, f64),
    what: &str,
) {
    let move_ = query(point(start.0, start.1), point(target.0, target.1));
    let budget = Budget::unlimited();
    let found = prepared.plan(&move_, &budget, &mut Silent).map(|(answer, _)| answer);
    let expected = plan_rapid_move(fresh, &move_, &budget, &mut Silent).map(|(answer, _)| answer);
    match (found, expected) {
        (Ok(Answer::Plan(found)), Ok(Answer::Plan(expected))) => {
            assert_close(found.cost, expected.cost, what);
            assert_sound(fresh, move_.start, move_.target, &found);
        }
        (found, expected) => assert_eq!(found, expected, "{what}"),
    }
}

fn somewhere(random: &mut impl RngExt, side: f64) -> (f64, f64) {
    (random.random_range(-10.0..side + 10.0), random.random_range(-10.0..side + 10.0))
}

#[test]
fn prepared_scenes_answer_as_fresh_ones() {
    for seed in 0..120 {
        let mut random = Seed(seed).stream();
        let count = random.random_range(1..40);
        let shapes = stars(&mut random, count, 100.0, 14.0);
        for fresh in [scene(shapes.clone(), 0.0), scene(shapes.clone(), 1.5), mitred(scene(shapes, 1.0))] {
            let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
            if seed % 3 != 0 {
                prepared.triangulate(&Budget::unlimited()).unwrap();
            }
            for _ in 0..12 {
                let (start, target) = (somewhere(&mut random, 100.0), somewhere(&mut random, 100.0));
                assert_same(
                    &mut prepared,
                    &fresh,
                    start,
                    target,
                    &format!("seed {seed} {start:?} {target:?}"),
                );
            }
        }
    }
}

#[test]
fn prepared_discs_answer_as_fresh_ones() {
    for seed in 0..150 {
        let mut random = Seed(seed).stream();
        let discs: Vec<Polygon> = (0..12)
            .map(|_| {
                let radius = random.random_range(1.0..9.0);
                disc(random.random_range(0.0..60.0), random.random_range(0.0..60.0), radius)
            })
            .collect();
        for clearance in [0.0, 1.0, 4.0] {
            let fresh = scene(discs.clone(), clearance);
            let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
            for _ in 0..6 {
                let (start, target) = (somewhere(&mut random, 60.0), somewhere(&mut random, 60.0));
                assert_same(
                    &mut prepared,
                    &fresh,
                    start,
                    target,
                    &format!("seed {seed} {start:?} {target:?}"),
                );
            }
        }
    }
}

#[test]
fn edits_in_random_order_leave_the_scene_as_a_fresh_one() {
    for seed in 0..60 {
        let mut random = Seed(seed).stream();
        let clearance = [0.0, 0.0, 1.0][seed as usize % 3];
        let shapes = stars(&mut random, 25, 100.0, 12.0);
        let mut fresh = scene(shapes, clearance);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        for step in 0..40 {
            if random.random_bool(0.1) {
                prepared.triangulate(&Budget::unlimited()).unwrap();
            }
            match random.random_range(0..4) {
                0 if !fresh.obstacles.is_empty() => {
                    let gone = random.random_range(0..fresh.obstacles.len());
                    let gone = fresh.obstacles.remove(gone);
                    prepared.remove_obstacle(&gone.id).unwrap();
                }
                1 => {
                    // Sometimes far outside of what was there at first, sometimes in place of another.
                    let side = if random.random_bool(0.1) { 400.0 } else { 100.0 };
                    let id = format!("o{}", random.random_range(0..40));
                    let shape = stars(&mut random, 1, side, 12.0).remove(0);
                    let obstacle = Obstacle { id, shape, clearance_mm: None, top_z_mm: None };
                    fresh.obstacles.retain(|other| other.id != obstacle.id);
                    fresh.obstacles.push(obstacle.clone());
                    prepared.put_obstacle(obstacle, &Budget::unlimited()).unwrap();
                }
                _ => {
                    let (start, target) = (somewhere(&mut random, 100.0), somewhere(&mut random, 100.0));
                    let what = format!("seed {seed} step {step} {start:?} {target:?}");
                    assert_same(&mut prepared, &fresh, start, target, &what);
                }
            }
            assert_eq!(prepared.obstacle_count(), fresh.obstacles.len());
        }
    }
}

/// Where an obstacle stood when the scene was triangulated, corners of the mesh lie in the open: moves begin there, too.
#[test]
fn a_start_on_a_corner_of_what_is_gone_is_a_start_like_any() {
    let square =
        |x: f64, y: f64| support::polygon(&[(x, y), (x + 10.0, y), (x + 10.0, y + 10.0), (x, y + 10.0)]);
    let shapes = (0..25).map(|i| square(f64::from(i % 5) * 20.0, f64::from(i / 5) * 20.0));
    let mut fresh = scene(shapes.collect::<Vec<_>>(), 0.0);
    let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
    prepared.triangulate(&Budget::unlimited()).unwrap();
    for gone in ["o12", "o7", "o0"] {
        fresh.obstacles.retain(|obstacle| obstacle.id != gone);
        prepared.remove_obstacle(gone).unwrap();
        for corner in [(40.0, 40.0), (50.0, 50.0), (45.0, 40.0)] {
            for target in [(95.0, 95.0), (-5.0, 33.0), (15.0, 15.0), (45.0, -5.0)] {
                assert_same(&mut prepared, &fresh, corner, target, &format!("{gone} {corner:?} {target:?}"));
            }
        }
    }
}

#[test]
fn an_obstacle_that_is_not_there_can_not_be_removed() {
    let mut prepared = PreparedScene::new(scene([], 0.0), &Budget::unlimited()).unwrap();
    let refusal = prepared.remove_obstacle("vise").unwrap_err();
    assert_eq!(refusal.to_string(), "there is no obstacle \"vise\" to remove");
    assert_same(&mut prepared, &scene([], 0.0), (0.0, 0.0), (3.0, 4.0), "an empty scene");
}

/// At clearance 0 a corner where an arc ends lies on that arc's circle but for rounding, and a place off the border stands
/// for it: which way round the arc is dearer, and where a tangent touches it, hangs on rounding.
#[test]
fn ways_from_and_to_the_ends_of_arcs() {
    let mut plans = 0;
    for seed in 0..700 {
        let mut random = Seed(seed).stream();
        let far = if random.random_bool(0.3) { 20_000.0 } else { 0.0 };
        let middle = point(far, -far);
        let corners = random.random_range(3..9);
        let radius = random.random_range(5.0..30.0);
        let step = std::f64::consts::TAU / f64::from(corners);
        let points = (0..corners).map(|i| {
            middle + traverse_geometry::unit(step * f64::from(i)) * radius * random.random_range(0.6..1.0)
        });
        let points: Vec<_> = points.collect();
        let bulge = |_| random.random_range(-0.2..0.5) * f64::from(random.random_range(0..4).min(1));
        let bulges = (0..corners).map(bulge).collect();
        let Ok(ring) = Ring::new(points, bulges) else { continue };
        let ring = if random.random_bool(0.5) { ring.reversed() } else { ring };
        let fresh = scene([Polygon::from_ring(ring.clone())], 0.0);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        for &corner in ring.vertices() {
            let mut along = || random.random_range(-40.0..40.0);
            let away = (middle.x + along(), middle.y + along());
            let other = ring.vertices()[random.random_range(0..ring.len())];
            let (corner, other) = ((corner.x, corner.y), (other.x, other.y));
            for (start, target) in [(corner, away), (away, corner), (corner, other)] {
                assert_same(
                    &mut prepared,
                    &fresh,
                    start,
                    target,
                    &format!("seed {seed}: {start:?} {target:?}"),
                );
                plans += 1;
            }
        }
    }
    assert!(plans > 5_000, "{plans}");
}
