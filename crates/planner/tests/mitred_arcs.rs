//! Mitred barriers of rings with arcs against barriers drawn beforehand; ends on arcs.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{answer, assert_close, mitred, plan, point, scene};
use traverse_geometry::{Edge, Location, Point, Polygon, Ring, Vector, cross};
use traverse_planner::{PreparedScene, Refusal};
use traverse_solve::{Budget, Seed, Silent};

/// How far the ends of a slot's round edges are from half a turn, as bulges say it: smooth, and ever sharper corners.
const OFF_SMOOTH: [f64; 9] = [0.0, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-6, 1e-4, 0.01];

/// A convex ring whose edges bulge outwards, with corners between.
fn bulging(random: &mut impl RngExt, center: Point) -> Ring {
    let corners = random.random_range(3..7);
    let step = std::f64::consts::TAU / f64::from(corners);
    let radius = random.random_range(4.0..12.0);
    let on_circle = |i| center + traverse_geometry::unit(step * f64::from(i)) * radius;
    // An arc of the circle through all corners would have the whole step for its sweep.
    let round = (step / 4.0).tan();
    let bulges =
        (0..corners).map(|_| [0.0, round * random.random_range(0.0..0.9)][random.random_range(0..2)]);
    let bulges = bulges.collect();
    Ring::new((0..corners).map(on_circle).collect(), bulges).unwrap()
}

/// Two straight edges and two that are nearly half circles.
fn slot(at: Point, length: f64, radius: f64, off: f64) -> Ring {
    let corners = [(0.0, -radius), (length, -radius), (length, radius), (0.0, radius)];
    let vertices = corners.map(|(x, y)| at + Vector::new(x, y)).to_vec();
    Ring::new(vertices, vec![0.0, 1.0 - off, 0.0, 1.0 - off]).unwrap()
}

/// The mitred barrier of a convex ring, as a ring: parallels, and the lines that meet in control points.
fn barrier(ring: &Ring, clearance: f64) -> Ring {
    let edges: Vec<Edge> = ring.edges().collect();
    let (mut vertices, mut bulges) = (Vec::new(), Vec::new());
    for (i, edge) in edges.iter().enumerate() {
        let before = edges[(i + edges.len() - 1) % edges.len()].direction_at(1.0);
        let after = edge.direction_at(0.0);
        let normal = |direction: Vector| Vector::new(direction.y, -direction.x);
        let vertex = edge.start();
        let half_turn = cross(before, after).atan2(before.dot(&after)) / 2.0;
        let foot = vertex + normal(before) * clearance;
        let control = foot + before * (clearance * half_turn.tan());
        vertices.extend([foot, control, vertex + normal(after) * clearance]);
        bulges.extend([0.0, 0.0, ring.bulges().get(i).copied().unwrap_or(0.0)]);
    }
    Ring::new(vertices, bulges).unwrap()
}

/// The mitred scene's plans cost what plans round the drawn barriers cost, in fresh and prepared scenes.
fn assert_as_drawn(rings: &[Ring], clearance: f64, ends: impl IntoIterator<Item = (Point, Point)>) {
    let shapes = |rings: Vec<Ring>| rings.into_iter().map(Polygon::from_ring);
    let drawn: Vec<Ring> = rings.iter().map(|ring| barrier(ring, clearance)).collect();
    let asked = mitred(scene(shapes(rings.to_vec()), clearance));
    let expected = scene(shapes(drawn.clone()), 0.0);
    let mut prepared = PreparedScene::new(asked.clone(), &Budget::unlimited()).unwrap();
    for (start, target) in ends {
        let is_free = |p| drawn.iter().all(|ring| ring.locate(p) == Location::Outside);
        if !is_free(start) || !is_free(target) {
            continue;
        }
        let found = plan(&asked, start, target);
        let what = format!("{start} to {target}, {clearance} from {rings:?}");
        assert_close(found.cost, plan(&expected, start, target).cost, &what);
        assert_close(plan(&asked, target, start).cost, found.cost, &what);
        let query = support::query(start, target);
        let (again, _) = prepared.plan(&query, &Budget::unlimited(), &mut Silent).unwrap();
        let traverse_planner::Answer::Plan(again) = again else { panic!("no plan: {what}") };
        assert_close(again.cost, found.cost, &what);
    }
}

fn ends(random: &mut impl RngExt, reach: f64) -> Vec<(Point, Point)> {
    let mut draw = || point(random.random_range(-reach..reach), random.random_range(-reach..reach));
    (0..6).map(|_| (draw(), draw())).collect()
}

#[test]
fn arcs_and_control_points_are_linked_along_the_border() {
    for case in 0..300 {
        let mut random = Seed(31).part(case).stream();
        let rings = [bulging(&mut random, point(0.0, 0.0)), bulging(&mut random, point(14.0, 3.0))];
        let clearance = random.random_range(0.1..4.0);
        let ends = ends(&mut random, 30.0);
        assert_as_drawn(&rings[..1 + case as usize % 2], clearance, ends);
    }
}

#[test]
fn corners_that_are_hardly_any_are_passed() {
    for off in OFF_SMOOTH {
        for (length, radius, clearance) in [(20.0, 5.0, 2.0), (50.0, 500.0, 1.0), (3000.0, 20_000.0, 6.0)] {
            let ring = slot(point(-length / 2.0, 0.0), length, radius, off);
            let mut random = Seed(5).stream();
            assert_as_drawn(&[ring], clearance, ends(&mut random, 3.0 * (length + radius)));
        }
    }
}

#[test]
fn a_control_point_between_an_arc_and_a_line_is_no_shortcut() {
    let ring = Ring::from_xy(&[0.0, 7.0, 2.0, 7.0, 2.0, 8.0, 0.0, 8.0], &[0.4, 0.0, 0.0, 0.0]).unwrap();
    assert_as_drawn(&[ring], 1.0, [(point(4.0, 9.0), point(0.0, 4.0))]);
}

#[test]
fn a_start_on_an_arc_lies_inside_the_mitred_barrier() {
    let corners = [2.1, 6.3, 4.1, 6.3, 4.1, 11.3, 2.1, 11.3];
    let ring = Ring::from_xy(&corners, &[0.0, 0.0, 0.0, 1.0]).unwrap();
    let asked = mitred(scene([Polygon::from_ring(ring)], 0.25));
    let refusals = answer(&asked, point(0.1, 10.3), point(9.1, 15.3)).unwrap_err();
    let [Refusal::EndInsideBarrier { field: "start", depth_mm, .. }] = &refusals[..] else {
        panic!("{refusals:?}")
    };
    assert!((depth_mm - 0.25).abs() < 1e-9, "{depth_mm}");
}
