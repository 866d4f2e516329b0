//! Mitred corners against the visibility graph of barriers that are drawn by brute force: convex and hollow obstacles
//! with holes, apart and overlapping, in work areas, with clearances of their own and corners cut square, one shot
//! and prepared.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::parallels::Drawn;
use support::{answer, assert_close, assert_sound, mitred, point, query, scene, star};
use traverse_geometry::{CornerStyle, Point, Polygon, Ring, Scene, unit};
use traverse_planner::{Answer, PreparedScene, Refusal};
use traverse_solve::{Budget, Seed, Silent};

/// Moves tried in each scene.
const MOVES: usize = 4;

/// The field that obstacles stand in, millimetres.
const SIDE: f64 = 90.0;

/// What came of the moves.
#[derive(Default, Debug)]
struct Tally {
    bent: usize,
    without_path: usize,
    refused: usize,
}

impl Tally {
    /// Holds one-shot and prepared plans of the scene against the drawn barriers.
    fn compare(&mut self, scene: &Scene, ends: &[(Point, Point)], what: &str) {
        let drawn = Drawn::of(scene);
        let mut prepared = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
        let pair = |p: Point| (p.x, p.y);
        for &(start, target) in ends {
            let what = format!("{what}, {start} to {target}: {scene:?}");
            let is_held = drawn.covers(pair(start)) || drawn.covers(pair(target));
            let again = prepared.plan(&query(start, target), &Budget::unlimited(), &mut Silent);
            let answers = [answer(scene, start, target), again.map(|(answer, _)| answer)];
            let expected = if is_held { f64::NAN } else { drawn.shortest(pair(start), pair(target)) };
            for answer in &answers {
                match answer {
                    Ok(Answer::Plan(plan)) => {
                        assert!(!is_held, "an end lies inside a barrier: {what}");
                        assert_sound(scene, start, target, plan);
                        assert_close(plan.cost, expected, &what);
                    }
                    Ok(Answer::NoPath(_)) => assert!(expected.is_infinite(), "{expected}: {what}"),
                    Err(refusals) => {
                        let is_inside = |refusal| matches!(refusal, &Refusal::EndInsideBarrier { .. });
                        assert!(is_held && refusals.iter().all(is_inside), "{refusals:?}: {what}");
                    }
                }
            }
            self.refused += usize::from(is_held);
            self.without_path += usize::from(expected.is_infinite());
            self.bent += usize::from(expected.is_finite() && expected > (target - start).norm() * 1.001);
        }
    }
}

/// Corners on a circle: convex.
fn round(random: &mut impl RngExt, center: Point, radius: f64) -> Polygon {
    let corners = random.random_range(3..8);
    let step = std::f64::consts::TAU / f64::from(corners);
    let at = |i| center + unit(step * (f64::from(i) + random.random_range(0.1..0.9))) * radius;
    Polygon::from_ring(Ring::new((0..corners).map(at).collect(), vec![]).unwrap())
}

/// A star with a hole of its own shape, half as large.
fn hollow(random: &mut impl RngExt, center: Point, radius: f64) -> Polygon {
    let corners = random.random_range(5..9);
    let outer = star(random, center, radius, corners);
    let half = outer.outer().vertices().iter().map(|&p| center + (p - center) * 0.5).collect();
    Polygon::new(outer.outer().clone(), vec![Ring::new(half, vec![]).unwrap()]).unwrap()
}

fn shape(random: &mut impl RngExt, center: Point, radius: f64) -> Polygon {
    match random.random_range(0..5) {
        0 | 1 => round(random, center, radius),
        2 => hollow(random, center, radius),
        _ => {
            let corners = random.random_range(3..9);
            star(random, center, radius, corners)
        }
    }
}

/// One in every cell of a grid: apart as long as clearances are small.
fn apart(random: &mut impl RngExt) -> Vec<Polygon> {
    let cells = (0..9).map(|i| point(f64::from(i % 3) * 30.0 + 15.0, f64::from(i / 3) * 30.0 + 15.0));
    cells.map(|center| shape(random, center, 14.0)).collect()
}

fn anywhere(random: &mut impl RngExt) -> Vec<Polygon> {
    let mut shapes = Vec::new();
    for _ in 0..7 {
        let center = point(random.random_range(0.0..SIDE), random.random_range(0.0..SIDE));
        let radius = random.random_range(6.0..20.0);
        shapes.push(shape(random, center, radius));
    }
    shapes
}

/// A border with corners turned inwards, and perhaps an island.
fn work_area(random: &mut impl RngExt) -> Polygon {
    let middle = point(SIDE / 2.0, SIDE / 2.0);
    let corners = random.random_range(5..10);
    let border = star(random, middle, 1.6 * SIDE, corners);
    let island = star(random, middle, 0.2 * SIDE, 5).outer().clone();
    if random.random_bool(0.5) { Polygon::new(border.outer().clone(), vec![island]).unwrap() } else { border }
}

/// Scenes by the number of the case, and moves in them, some of which begin in holes.
fn compare_cases(
    cases: std::ops::Range<u64>,
    clearance_of: impl Fn(&mut dyn FnMut() -> f64) -> f64,
) -> Tally {
    let mut tally = Tally::default();
    for case in cases {
        let mut random = Seed(46).part(case).stream();
        let shapes = if case % 2 == 0 { apart(&mut random) } else { anywhere(&mut random) };
        let mut drawn = || clearance_of(&mut || random.random_range(0.0..1.0));
        let (clearance, own, border) = (drawn(), drawn(), drawn());
        let mut scene = mitred(scene(shapes, clearance));
        if case % 3 == 0 {
            scene.obstacles[0].clearance_mm = Some(own);
        }
        if case % 4 < 2 {
            scene.work_area = Some(work_area(&mut random));
            scene.work_area_clearance_mm = (case % 8 < 4).then_some(border);
        }
        if case % 5 < 2 {
            scene.corner_style = CornerStyle::Miter { limit: Some(random.random_range(1.0..2.5)) };
        }
        let mut at = || {
            if random.random_bool(0.1) {
                return point(15.0, 15.0);
            }
            point(random.random_range(-8.0..SIDE + 8.0), random.random_range(-8.0..SIDE + 8.0))
        };
        let ends: Vec<_> = (0..MOVES).map(|_| (at(), at())).collect();
        tally.compare(&scene, &ends, &format!("case {case}"));
    }
    tally
}

#[test]
fn agrees_with_drawn_barriers_at_clearances() {
    let tally = compare_cases(0..400, |draw| if draw() < 0.1 { 0.0 } else { 0.1 + 4.0 * draw().powi(2) });
    assert!(tally.bent > 400 && tally.without_path > 10 && tally.refused > 100, "{tally:?}");
}

#[test]
fn agrees_with_drawn_barriers_at_clearance_zero() {
    let tally = compare_cases(1000..1250, |_| 0.0);
    assert!(tally.bent > 200 && tally.without_path > 5 && tally.refused > 100, "{tally:?}");
}
