//! Contact: borders, touching and overlapping obstacles, things of no width, gaps of just the clearance.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use support::{assert_close, disc, mitred, no_path, plan, point, polygon, rectangle, scene};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Scene};

const SQRT_2: f64 = std::f64::consts::SQRT_2;

#[test]
fn slides_along_an_edge_between_points_of_a_border() {
    let block = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 0.0);
    assert_close(plan(&block, point(2.0, 0.0), point(8.0, 0.0)).cost, 6.0, "along an edge");
    assert_close(plan(&block, point(0.0, 0.0), point(10.0, 0.0)).cost, 10.0, "from corner to corner");
    assert_close(plan(&block, point(-5.0, 0.0), point(15.0, 0.0)).cost, 20.0, "past an edge");
    assert_close(plan(&block, point(0.0, 5.0), point(10.0, 5.0)).cost, 20.0, "round three sides");
    assert_close(plan(&block, point(0.0, 0.0), point(10.0, 10.0)).cost, 20.0, "between opposite corners");
    assert_close(plan(&block, point(5.0, 0.0), point(5.0, -7.0)).cost, 7.0, "straight off");
}

#[test]
fn nothing_passes_between_obstacles_that_touch_at_clearance_zero() {
    // Two squares that share a corner: the straight diagonal through it is shut.
    let corner = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 10.0, 20.0, 20.0)], 0.0);
    let around = plan(&corner, point(5.0, 15.0), point(15.0, 5.0));
    let one_way = point(5.0, 15.0) - point(0.0, 10.0);
    let expected = one_way.norm() + 10.0 + 10.0 + (point(15.0, 5.0) - point(10.0, 0.0)).norm();
    assert_close(around.cost, expected, "round a corner contact");
    // Two that share an edge; along the seam is shut too.
    let seam = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)], 0.0);
    let around = plan(&seam, point(10.0, -5.0), point(10.0, 15.0));
    assert_close(around.cost, 10.0 + 2.0 * 125.0_f64.sqrt(), "round a seam");
    // A vertex that touches the middle of an edge.
    let tip = polygon(&[(10.0, 5.0), (20.0, 0.0), (20.0, 10.0)]);
    let tee = scene([rectangle(0.0, 0.0, 10.0, 10.0), tip], 0.0);
    let around = plan(&tee, point(10.5, 2.0), point(10.5, 8.0));
    assert!(around.cost > 15.0, "{}", around.cost);
    // Discs.
    let discs = scene([disc(0.0, 0.0, 5.0), disc(10.0, 0.0, 5.0)], 0.0);
    assert!(plan(&discs, point(5.0, -9.0), point(5.0, 9.0)).cost > 28.0);
}

#[test]
fn an_end_where_obstacles_touch_leaves_on_either_side() {
    let corner = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 10.0, 20.0, 20.0)], 0.0);
    let contact = point(10.0, 10.0);
    assert_close(plan(&corner, contact, point(5.0, 15.0)).cost, 5.0 * SQRT_2, "upper left");
    assert_close(plan(&corner, contact, point(15.0, 5.0)).cost, 5.0 * SQRT_2, "lower right");
    let seam = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)], 0.0);
    let shut = no_path(&seam, point(10.0, 5.0), point(10.0, 15.0));
    assert_eq!(shut.separating_obstacles, ["o0", "o1"]);
}

#[test]
fn an_end_in_a_narrow_notch_gets_out() {
    // A notch of 11 degrees and one of 0.1 degrees.
    for half in [1.0, 0.01] {
        let notch = polygon(&[
            (-20.0, -5.0),
            (20.0, -5.0),
            (20.0, 10.0),
            (half, 10.0),
            (0.0, 0.0),
            (-half, 10.0),
            (-20.0, 10.0),
        ]);
        let way = plan(&scene([notch], 0.0), point(0.0, 0.0), point(15.0, 10.0));
        assert_close(way.cost, (half * half + 100.0).sqrt() + 15.0 - half, "out of the notch");
    }
}

#[test]
fn overlapping_and_equal_obstacles_are_one_barrier() {
    let square = || rectangle(0.0, 0.0, 10.0, 10.0);
    for clearance in [0.0, 1.5] {
        let (start, target) = (point(-5.0, 5.0), point(15.0, 5.0));
        let once = plan(&scene([square()], clearance), start, target).cost;
        let twice = plan(&scene([square(), square()], clearance), start, target).cost;
        assert_close(twice, once, "equal");
        let halves = [rectangle(0.0, 0.0, 6.0, 10.0), rectangle(4.0, 0.0, 10.0, 10.0)];
        assert_close(plan(&scene(halves, clearance), start, target).cost, once, "overlapping");
        let touching = [rectangle(0.0, 0.0, 5.0, 10.0), rectangle(5.0, 0.0, 10.0, 10.0)];
        assert_close(plan(&scene(touching, clearance), start, target).cost, once, "touching");
        let discs = [disc(5.0, 5.0, 5.0), disc(5.0, 5.0, 5.0)];
        let disc_once = plan(&scene([disc(5.0, 5.0, 5.0)], clearance), start, target).cost;
        assert_close(plan(&scene(discs, clearance), start, target).cost, disc_once, "equal discs");
    }
}

#[test]
fn a_wall_of_no_width_is_a_wall() {
    // A square with an antenna on its right side: out to (20, 5) and back.
    let antenna =
        polygon(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 5.0), (10.0, 5.0), (10.0, 10.0), (0.0, 10.0)]);
    let walled = scene([antenna.clone()], 0.0);
    assert_close(
        plan(&walled, point(15.0, 0.0), point(15.0, 10.0)).cost,
        2.0 * 50.0_f64.sqrt(),
        "round its tip",
    );
    assert_close(plan(&walled, point(12.0, 5.0), point(25.0, 5.0)).cost, 13.0, "along it");
    let wide = scene([antenna], 1.0);
    let way = plan(&wide, point(15.0, 0.0), point(15.0, 10.0));
    assert!(way.cost > 2.0 * 50.0_f64.sqrt() + 0.5, "{}", way.cost);
}

#[test]
fn a_slit_of_no_width_is_shut_and_a_keyhole_joins_a_hole() {
    // A ring of material about a hole, written as one weakly simple ring.
    let keyhole = polygon(&[
        (0.0, 0.0),
        (30.0, 0.0),
        (30.0, 30.0),
        (0.0, 30.0),
        (0.0, 15.0),
        (10.0, 15.0),
        (10.0, 20.0),
        (20.0, 20.0),
        (20.0, 10.0),
        (10.0, 10.0),
        (10.0, 15.0),
        (0.0, 15.0),
    ]);
    for clearance in [0.0, 0.5] {
        let shut = no_path(&scene([keyhole.clone()], clearance), point(15.0, 15.0), point(-5.0, 15.0));
        assert_eq!(shut.separating_obstacles, ["o0"]);
        let inside = plan(&scene([keyhole.clone()], clearance), point(12.0, 12.0), point(18.0, 18.0));
        assert_close(inside.cost, 6.0 * SQRT_2, "inside the hole");
    }
}

#[test]
fn a_ring_that_visits_a_vertex_twice_bends_paths_there() {
    // Two triangles that meet in (0, 0), as one ring.
    let bow = polygon(&[(0.0, 0.0), (-10.0, -5.0), (-10.0, 5.0), (0.0, 0.0), (10.0, 5.0), (10.0, -5.0)]);
    let way = plan(&scene([bow], 0.0), point(-1.0, 3.0), point(1.0, 3.0));
    assert_close(way.cost, 2.0, "above");
}

#[test]
fn a_slit_of_a_micrometre_is_open_until_the_clearance_fills_it() {
    let slit =
        |clearance| scene([rectangle(-50.0, 0.0, 0.0, 10.0), rectangle(0.001, 0.0, 50.0, 10.0)], clearance);
    let (start, target) = (point(0.0005, -5.0), point(0.0005, 15.0));
    for clearance in [0.0, 0.0004, 0.0005] {
        assert_close(plan(&slit(clearance), start, target).cost, 20.0, "through");
    }
    assert!(plan(&slit(0.0006), start, target).cost > 50.0);
    assert!(plan(&mitred(slit(0.0006)), start, target).cost > 50.0);
    assert_close(plan(&mitred(slit(0.0005)), start, target).cost, 20.0, "mitred through");
}

/// A 6 × 6 grid of squares, `gap` apart.
fn grid(gap: f64, clearance: f64) -> Scene {
    let at = |i: u32| f64::from(i) * (10.0 + gap);
    let squares = (0..36)
        .map(|i| rectangle(at(i % 6), at(i / 6), at(i % 6) + 10.0, at(i / 6) + 10.0))
        .collect::<Vec<_>>();
    scene(squares, clearance)
}

#[test]
fn gaps_of_exactly_twice_the_clearance_let_the_tool_through() {
    let clearance = 1.0;
    let (start, target) = (point(-3.0, 35.0), point(75.0, 35.0));
    let through = |gap: f64| {
        let scene = grid(gap, clearance);
        (plan(&scene, start, target).cost, plan(&mitred(scene), start, target).cost)
    };
    let (open, open_mitred) = through(2.0);
    for gap in [2.0_f64.next_up(), 2.0_f64.next_down(), 2.0 + 2.0 * CONTACT_TOLERANCE_MM] {
        let (round, miter) = through(gap);
        assert!(
            (round - open).abs() < 1e-4 && (miter - open_mitred).abs() < 1e-4,
            "{gap}: {round} {miter} {open}"
        );
    }
    let (shut, shut_mitred) = through(2.0 - 2.0 * CONTACT_TOLERANCE_MM);
    assert!(shut > open + 1.0, "{shut} {open}");
    assert!(shut_mitred > open_mitred + 1.0, "{shut_mitred} {open_mitred}");
}

#[test]
fn an_obstacle_over_the_border_joins_with_it() {
    let mut bounded = scene([rectangle(40.0, -10.0, 60.0, 70.0), rectangle(40.0, 70.0, 60.0, 110.0)], 0.0);
    bounded.work_area = Some(rectangle(0.0, 0.0, 100.0, 100.0));
    let shut = no_path(&bounded, point(20.0, 50.0), point(80.0, 50.0));
    assert_eq!(shut.separating_obstacles, ["o0", "o1"]);
    bounded.obstacles.pop();
    let way = plan(&bounded, point(20.0, 50.0), point(80.0, 50.0));
    assert_close(way.cost, 20.0 + 2.0 * 800.0_f64.sqrt(), "through the gap at the top");
}

#[test]
fn obstacles_of_clearance_zero_stand_beside_others() {
    let mut mixed = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(15.0, 0.0, 25.0, 10.0)], 0.0);
    mixed.obstacles[1].clearance_mm = Some(4.99);
    let way = plan(&mixed, point(10.0, -8.0), point(10.0, 18.0));
    assert_close(way.cost, 26.0, "through the gap, along the first");
    // Clearance 0 is the limit of ever smaller ones: where the second asks for the whole gap, nothing is left.
    mixed.obstacles[1].clearance_mm = Some(5.0);
    assert!(plan(&mixed, point(9.0, -8.0), point(9.0, 18.0)).cost > 30.0);
}

#[test]
fn an_end_where_many_obstacles_meet_leaves_through_every_gap() {
    // Twelve thin triangles about the origin.
    let at = |k: u32, part: f64| {
        traverse_geometry::unit((f64::from(k) + part) * std::f64::consts::TAU / 12.0) * 10.0
    };
    let blades = (0..12).map(|k| {
        let (a, b) = (at(k, 0.0), at(k, 0.4));
        polygon(&[(0.0, 0.0), (a.x, a.y), (b.x, b.y)])
    });
    let fan = scene(blades, 0.0);
    for k in 0..12 {
        let gap = at(k, 0.7);
        assert_close(plan(&fan, point(0.0, 0.0), point(gap.x, gap.y)).cost, 10.0, &format!("gap {k}"));
    }
}
