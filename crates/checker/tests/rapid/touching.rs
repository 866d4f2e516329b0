//! Clearance 0 between things that touch.

use crate::making::*;
use traverse_checker::ViolationReason::{BetweenTouchingObstacles, InsideObstacle};
use traverse_geometry::{Ring, Scene};

fn chess(x: f64, y: f64) -> Scene {
    scene(0.0, vec![rectangle(x - 10.0, y, x, y + 10.0), rectangle(x, y - 10.0, x + 10.0, y)])
}

#[test]
fn not_between_squares_that_touch_in_a_corner() {
    for (x, y) in [(0.0, 0.0), (20_000.3, -19_999.7)] {
        let scene = chess(x, y);
        let at = |dx: f64, dy: f64| (x + dx, y + dy);
        let found = refuses(&scene, &line(&[at(-5.0, -5.0), at(5.0, 5.0)]), BetweenTouchingObstacles);
        assert_eq!(found.violations.len(), 1, "{:?}", found.violations);
        refuses(&scene, &line(&[at(-5.0, -5.0), at(0.0, 0.0), at(5.0, 5.0)]), BetweenTouchingObstacles);
        refuses(&scene, &line(&[at(-5.0, -5.0), at(0.0, 0.0), at(1.0, 9.0)]), BetweenTouchingObstacles);
        refuses(&scene, &line(&[at(-9.0, 0.0), at(0.0, 0.0), at(9.0, 0.0)]), BetweenTouchingObstacles);
        refuses(&scene, &line(&[at(-9.0, 0.0), at(0.0, 0.0), at(0.0, 9.0)]), BetweenTouchingObstacles);
        refuses(&scene, &line(&[at(-9.0, 0.0), at(9.0, 0.0)]), BetweenTouchingObstacles);
        accepts(&scene, &line(&[at(-9.0, 0.0), at(0.0, 0.0), at(0.0, -9.0)]));
        accepts(&scene, &line(&[at(-5.0, -5.0), at(0.0, 0.0), at(-4.0, -5.0)]));
        accepts(&scene, &line(&[at(-5.0, -5.0), at(0.0, 0.0)]));
        accepts(&scene, &line(&[at(0.0, 0.0), at(5.0, 5.0)]));
        accepts(&scene, &line(&[at(0.0, 0.0), at(0.0, 5.0)]));
        accepts(&scene, &line(&[at(0.0, 0.0)]));
    }
}

#[test]
fn not_along_a_seam() {
    let scene = scene(0.0, vec![rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)]);
    refuses(&scene, &line(&[(10.0, -5.0), (10.0, 15.0)]), BetweenTouchingObstacles);
    refuses(&scene, &line(&[(10.0, 0.0), (10.0, 10.0)]), BetweenTouchingObstacles);
    refuses(&scene, &line(&[(10.0, 3.0), (10.0, 7.0)]), BetweenTouchingObstacles);
    accepts(&scene, &line(&[(0.0, 10.0), (20.0, 10.0)]));
    accepts(&scene, &line(&[(5.0, 12.0), (10.0, 10.0), (15.0, 12.0)]));
    accepts(&scene, &line(&[(10.0, 12.0), (10.0, 10.0)]));
    refuses(&scene, &line(&[(5.0, 5.0), (15.0, 5.0)]), InsideObstacle);
}

#[test]
fn not_along_a_seam_on_a_slant_of_unequal_plates() {
    // The seam lies on y = x; its ends differ but all of them lie on it exactly.
    let lower = ring(&[(0.0, 0.0), (12.0, 0.0), (12.0, 12.0)]);
    let upper = ring(&[(2.0, 2.0), (8.0, 8.0), (0.0, 8.0)]);
    let scene = scene(0.0, vec![lower, upper]);
    refuses(&scene, &line(&[(0.0, 0.0), (12.0, 12.0)]), BetweenTouchingObstacles);
    refuses(&scene, &line(&[(3.0, 3.0), (7.0, 7.0)]), BetweenTouchingObstacles);
    accepts(&scene, &line(&[(0.0, 0.0), (2.0, 2.0), (0.0, 8.0)]));
    accepts(&scene, &line(&[(0.0, 8.0), (8.0, 8.0), (12.0, 12.0)]));
}

#[test]
fn not_where_a_corner_touches_the_middle_of_an_edge() {
    let scene =
        scene(0.0, vec![rectangle(0.0, 0.0, 10.0, 10.0), ring(&[(5.0, 10.0), (8.0, 20.0), (2.0, 20.0)])]);
    refuses(&scene, &line(&[(0.0, 10.0), (10.0, 10.0)]), BetweenTouchingObstacles);
    refuses(&scene, &line(&[(0.0, 12.0), (5.0, 10.0), (10.0, 12.0)]), BetweenTouchingObstacles);
    accepts(&scene, &line(&[(0.0, 10.0), (5.0, 10.0), (2.0, 20.0)]));
    accepts(&scene, &line(&[(0.0, 10.0), (5.0, 10.0)]));
}

#[test]
fn slits_are_open_down_to_what_coordinates_resolve() {
    for (gap, x) in [(1e-3, 0.0), (1e-5, 0.0), (1e-6, 0.0), (1e-7, 0.0), (1e-7, 1000.0), (1e-3, 20_000.0)] {
        let scene =
            scene(0.0, vec![rectangle(x, 0.0, x + 10.0, 10.0), rectangle(x, 10.0 + gap, x + 10.0, 20.0)]);
        accepts(&scene, &line(&[(x - 5.0, 5.0), (x, 10.0), (x + 10.0, 10.0), (x + 15.0, 5.0)]));
        accepts(&scene, &line(&[(x - 5.0, 5.0), (x, 10.0), (x + 10.0, 10.0 + gap), (x + 15.0, 15.0)]));
        accepts(&scene, &line(&[(x, 10.0 + gap / 2.0), (x + 10.0, 10.0 + gap / 2.0)]));
    }
}

#[test]
fn thin_plates_block_however_thin_they_are() {
    for thickness in [1e-3, 1e-5, 1.5e-6, 1e-7, 1e-9] {
        let scene = scene(0.0, vec![rectangle(0.0, 0.0, 10.0, thickness)]);
        let check = check(&scene, &line(&[(5.0, -5.0), (5.0, 5.0)]));
        assert_eq!(check.violations.len(), 1, "{thickness}: {:?}", check.violations);
        assert_eq!(
            check.violations[0].reason,
            if thickness > 2e-6 { InsideObstacle } else { BetweenTouchingObstacles }
        );
        accepts(&scene, &line(&[(5.0, -5.0), (10.0, 0.0), (10.0, thickness), (5.0, 5.0)]));
        accepts(&scene, &line(&[(-5.0, 0.0), (15.0, 0.0)]));
        accepts(&scene, &line(&[(5.0, -5.0), (5.0, 0.0), (8.0, -5.0)]));
    }
}

fn antenna() -> Ring {
    ring(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 5.0), (10.0, 5.0), (10.0, 10.0), (0.0, 10.0)])
}

#[test]
fn antennas_are_walls() {
    let scene = scene(0.0, vec![antenna()]);
    refuses(&scene, &line(&[(15.0, 0.0), (15.0, 10.0)]), BetweenTouchingObstacles);
    refuses(&scene, &line(&[(14.0, 0.0), (16.0, 10.0)]), BetweenTouchingObstacles);
    // Onto it from one side, along it, and off on the other.
    refuses(&scene, &line(&[(12.0, 0.0), (13.0, 5.0), (17.0, 5.0), (18.0, 10.0)]), BetweenTouchingObstacles);
    accepts(&scene, &line(&[(12.0, 0.0), (13.0, 5.0), (17.0, 5.0), (18.0, 0.0)]));
    accepts(&scene, &line(&[(12.0, 10.0), (13.0, 5.0), (17.0, 5.0), (18.0, 10.0)]));
    // Round its tip.
    accepts(&scene, &line(&[(12.0, 0.0), (20.0, 5.0), (12.0, 10.0)]));
    accepts(&scene, &line(&[(10.0, 0.0), (10.0, 5.0), (20.0, 5.0), (10.0, 5.0), (10.0, 10.0)]));
    accepts(&scene, &line(&[(13.0, 2.0), (13.0, 5.0), (20.0, 5.0), (14.0, 5.0), (12.0, 8.0)]));
    // Off its end straight on.
    accepts(&scene, &line(&[(13.0, 5.0), (30.0, 5.0)]));
    accepts(&scene, &line(&[(20.0, 0.0), (20.0, 10.0)]));
    refuses(&scene, &line(&[(20.0 - 1e-5, 0.0), (20.0 - 1e-5, 10.0)]), BetweenTouchingObstacles);
    // Start and target on it.
    accepts(&scene, &line(&[(15.0, 5.0), (15.0, 10.0)]));
    accepts(&scene, &line(&[(15.0, 5.0), (17.0, 5.0), (17.0, 0.0)]));
    // Through its foot.
    refuses(&scene, &line(&[(10.0, 2.0), (10.0, 8.0)]), BetweenTouchingObstacles);
}

#[test]
fn needles_are_turned_sharply() {
    for half in [1.0, 1e-1, 1e-3, 1e-5, 1e-6, 1e-8] {
        let needle = || ring(&[(0.0, -half), (20.0, 0.0), (0.0, half)]);
        let scene = scene(0.0, vec![needle()]);
        accepts(&scene, &line(&[(0.0, -half), (20.0, 0.0), (0.0, half)]));
        accepts(&scene, &line(&[(0.0, -9.0), (20.0, 0.0), (0.0, 9.0)]));
        accepts(&scene, &arc(line(&[(18.0, -2.0), (20.0, -2.0)]), (20.0, 0.0), 180.0));
        let check = check(&scene, &line(&[(10.0, -5.0), (10.0, 5.0)]));
        assert_eq!(check.violations.len(), 1, "{half}: {:?}", check.violations);
    }
}

#[test]
fn not_between_discs_that_touch() {
    let scene = scene(0.0, vec![disc(-5.0, 0.0, 5.0), disc(5.0, 0.0, 5.0)]);
    refuses(&scene, &line(&[(0.0, -10.0), (0.0, 10.0)]), BetweenTouchingObstacles);
    let between = arc(arc(line(&[(5.0, -5.0)]), (5.0, 0.0), -90.0), (-5.0, 0.0), 90.0);
    refuses(&scene, &between, BetweenTouchingObstacles);
    let back = arc(arc(line(&[(-5.0, -5.0)]), (-5.0, 0.0), 90.0), (5.0, 0.0), 90.0);
    accepts(&scene, &back);
    accepts(&scene, &arc(line(&[(0.0, 0.0)]), (5.0, 0.0), 90.0));
    // A micrometre apart.
    let open = |gap: f64| crate::making::scene(0.0, vec![disc(-5.0 - gap, 0.0, 5.0), disc(5.0, 0.0, 5.0)]);
    accepts(&open(1e-3), &line(&[(-5e-4, -10.0), (-5e-4, 10.0)]));
    accepts(&open(1e-7), &line(&[(-5e-8, -10.0), (-5e-8, 10.0)]));
}

#[test]
fn not_along_a_circular_seam() {
    // A disc in a round bite of the same radius.
    let bite = bulged(
        &[(-10.0, 0.0), (-10.0, -10.0), (10.0, -10.0), (10.0, 0.0), (5.0, 0.0), (-5.0, 0.0)],
        &[0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
    );
    let scene = scene(0.0, vec![bite, disc(0.0, 0.0, 5.0)]);
    refuses(&scene, &arc(line(&[(8.0, 0.0), (5.0, 0.0)]), (0.0, 0.0), -180.0), BetweenTouchingObstacles);
    refuses(&scene, &arc(line(&[(3.0, -4.0)]), (0.0, 0.0), -40.0), BetweenTouchingObstacles);
    accepts(&scene, &to(arc(line(&[(8.0, 0.0), (5.0, 0.0)]), (0.0, 0.0), 180.0), -8.0, 0.0));
}

#[test]
fn one_ring_that_touches_itself_closes() {
    // A C whose jaws meet in a point, and one whose jaws meet along an edge.
    let point = ring(&[
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 10.0),
        (15.0, 9.0),
        (15.0, 5.0),
        (5.0, 5.0),
        (5.0, 15.0),
        (15.0, 15.0),
        (15.0, 11.0),
        (20.0, 10.0),
        (20.0, 20.0),
        (0.0, 20.0),
    ]);
    let scene_point = scene(0.0, vec![point]);
    refuses(&scene_point, &line(&[(10.0, 10.0), (25.0, 10.0)]), BetweenTouchingObstacles);
    accepts(&scene_point, &line(&[(10.0, 10.0), (20.0, 10.0)]));
    accepts(&scene_point, &line(&[(20.0, 10.0), (25.0, 10.0)]));
    accepts(&scene_point, &line(&[(25.0, 0.0), (20.0, 10.0), (20.0, 20.0)]));
    let edge = ring(&[
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 10.0),
        (15.0, 10.0),
        (15.0, 5.0),
        (5.0, 5.0),
        (5.0, 15.0),
        (15.0, 15.0),
        (15.0, 10.0),
        (20.0, 10.0),
        (20.0, 20.0),
        (0.0, 20.0),
    ]);
    let scene_edge = scene(0.0, vec![edge]);
    refuses(&scene_edge, &line(&[(10.0, 10.0), (25.0, 10.0)]), BetweenTouchingObstacles);
    refuses(&scene_edge, &line(&[(16.0, 10.0), (19.0, 10.0)]), BetweenTouchingObstacles);
    accepts(&scene_edge, &line(&[(10.0, 10.0), (15.0, 10.0)]));
    accepts(&scene_edge, &line(&[(20.0, 0.0), (20.0, 20.0)]));
}

#[test]
fn overlapping_obstacles_close_too() {
    let scene = scene(0.0, vec![rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0 - 1e-8, 0.0, 20.0, 10.0)]);
    refuses(&scene, &line(&[(10.0, -5.0), (10.0, 15.0)]), BetweenTouchingObstacles);
    accepts(&scene, &line(&[(0.0, 10.0), (20.0, 10.0)]));
}

#[test]
fn three_wedges_in_one_point_part_the_plane() {
    let wedge = |a: (f64, f64), b: (f64, f64)| ring(&[(0.0, 0.0), a, b]);
    let wedges = vec![
        wedge((10.0, -1.0), (10.0, 1.0)),
        wedge((-4.0, 9.0), (-6.0, 8.0)),
        wedge((-6.0, -8.0), (-4.0, -9.0)),
    ];
    let scene = scene(0.0, wedges);
    let ends = [(10.0, 10.0), (-10.0, 0.5), (10.0, -10.0)];
    for (i, &from) in ends.iter().enumerate() {
        for (j, &to) in ends.iter().enumerate() {
            let path = line(&[from, (0.0, 0.0), (to.0 + 0.1, to.1)]);
            if i == j {
                accepts(&scene, &path);
            } else {
                refuses(&scene, &path, BetweenTouchingObstacles);
            }
        }
    }
}

#[test]
fn an_edge_on_both_sides_of_a_hairpin_is_no_passage() {
    // Found by the oracle: the triangle's right edge lies left of the first step and right of the second.
    let scene = scene(0.0, vec![ring(&[(4.0, 3.0), (1.0, 3.0), (4.0, 1.0)])]);
    let path = line(&[(4.0, 2.0), (5.0, 5.0), (4.0, 1.0)]);
    for tolerance in [TOLERANCE, 1e-3, 0.2] {
        let check = traverse_checker::check_rapid_move(&scene, path.start, path.end(), &path, tolerance);
        assert!(check.is_sound(), "{:?}", check.violations);
    }
}

#[test]
fn a_wall_behind_both_legs_of_a_hairpin_is_no_passage() {
    // Found by the oracle: an antenna along the top of a block and beyond, seen from below.
    let wall = ring(&[(1.0, 2.0), (2.0, 2.0), (4.0, 2.0), (2.0, 2.0), (2.0, 3.0), (1.0, 3.0)]);
    let scene = scene(0.0, vec![rectangle(0.0, 0.0, 3.0, 2.0), wall]);
    let path = line(&[(7.0, 1.0), (3.0, 2.0), (9.0, 1.0)]);
    for tolerance in [TOLERANCE, 1e-3, 0.1, 0.2, 0.25] {
        let check = traverse_checker::check_rapid_move(&scene, path.start, path.end(), &path, tolerance);
        assert!(check.is_sound(), "{tolerance}: {:?}", check.violations);
    }
}

#[test]
fn a_polygonised_circle_is_slid_round() {
    for count in [8, 100, 5000] {
        let corner = |i: i32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
            (3.0 + 5.0 * cos, 2.0 + 5.0 * sin)
        };
        let corners: Vec<_> = (0..count).map(corner).collect();
        let scene = scene(0.0, vec![ring(&corners)]);
        let half: Vec<_> = (0..=count / 2).map(corner).collect();
        accepts(&scene, &line(&half));
    }
}

#[test]
fn positive_clearance_asks_distances_only() {
    let touching = Scene { clearance_mm: 1.0, ..chess(0.0, 0.0) };
    accepts(&touching, &line(&[(-11.0, -1.0), (-1.0, -1.0), (-1.0, -11.0)]));
}

#[test]
fn a_path_may_not_pass_where_it_ends_later() {
    // Found by the oracle: through the foot of an antenna, round its tip and back to its foot.
    let scene = scene(0.0, vec![antenna()]);
    let path = line(&[(10.0, 0.0), (10.0, 8.0), (20.0, 5.0), (10.0, 5.0)]);
    refuses(&scene, &path, BetweenTouchingObstacles);
}

#[test]
fn a_seam_behind_an_antenna_is_a_seam() {
    // Found by the oracle.
    let corner = |x: f64, y: f64| {
        ring(&[(x, y), (x + 1.0, y), (x + 2.0, y), (x + 1.0, y), (x + 1.0, y + 1.0), (x, y + 1.0)])
    };
    let scene = scene(0.0, vec![corner(3.0, 1.0), corner(3.0, 0.0), rectangle(4.0, 0.0, 5.0, 2.0)]);
    refuses(&scene, &line(&[(4.0, 1.0), (3.0, 1.0)]), BetweenTouchingObstacles);
    refuses(&scene, &line(&[(4.0, 0.0), (4.0, 1.0)]), BetweenTouchingObstacles);
}
