//! Mitred barriers.

use crate::making::*;
use traverse_checker::ViolationReason::{InsideObstacle, TooClose};

#[test]
fn the_published_example_is_accepted_and_its_inside_refused() {
    // Clearance 1 round a part whose control points are those published in 2008.
    // Its flag is an antenna: two wide less twice the clearance.
    let part = ring(&[(5.0, 7.0), (8.0, 7.0), (8.0, 8.0), (10.0, 8.0), (8.0, 8.0), (8.0, 9.0), (5.0, 9.0)]);
    let scene = mitred(scene(1.0, vec![part]), Some(1.0));
    let way = accepts(&scene, &line(&[(6.0, 5.0), (4.0, 6.0), (4.0, 10.0), (6.0, 11.0)]));
    close(way.cost, 4.0 + 2.0 * 5.0_f64.sqrt());
    close(way.smallest_margin_mm.expect("an obstacle"), 0.0);
    let other =
        accepts(&scene, &line(&[(6.0, 5.0), (9.0, 6.0), (11.0, 7.0), (11.0, 9.0), (9.0, 10.0), (6.0, 11.0)]));
    assert!((other.cost - 12.797).abs() < 1e-3);
    refuses(&scene, &line(&[(6.0, 5.0), (6.0, 11.0)]), InsideObstacle);
}

#[test]
fn square_corners_reach_to_their_control_points() {
    let square = scene(2.0, vec![rectangle(0.0, 0.0, 10.0, 10.0)]);
    let cut = line(&[(5.0, 12.0), (10.0, 12.0), (12.0, 10.0), (12.0, 5.0)]);
    let round = to(arc(line(&[(5.0, 12.0), (10.0, 12.0)]), (10.0, 10.0), -90.0), 12.0, 5.0);
    accepts(&square, &round);
    let square = mitred(square, None);
    accepts(&square, &line(&[(5.0, 12.0), (12.0, 12.0), (12.0, 5.0)]));
    close(refuses(&square, &cut, TooClose).violations[0].amount, 1.0);
    // On the arc the greater of both distances is least halfway: 2 · cos 45°.
    close(refuses(&square, &round, TooClose).violations[0].amount, 2.0 - 2.0_f64.sqrt());
    // Along the seam of band and kite.
    refuses(&square, &line(&[(10.0, 10.0), (10.0, 20.0)]), TooClose);
    accepts(&square, &line(&[(10.0, 12.0), (10.0, 20.0)]));
    // Past the control point.
    accepts(&square, &line(&[(8.0, 16.0), (16.0, 8.0)]));
    refuses(&square, &line(&[(8.0, 15.0), (15.0, 8.0)]), TooClose);
}

#[test]
fn needles_are_cut_square_beyond_the_limit() {
    // Half angle with sine 0.2: the control point lies five clearances away.
    let height = 10.0 * (0.2_f64).asin().tan();
    let needle = scene(1.0, vec![ring(&[(0.0, 0.0), (-10.0, height), (-10.0, -height)])]);
    let across = |x: f64| line(&[(x, 20.0), (x, -20.0)]);
    let full = mitred(needle.clone(), None);
    accepts(&full, &across(5.0));
    refuses(&full, &across(5.0 - 1e-4), TooClose);
    let cut = mitred(needle.clone(), Some(3.0));
    accepts(&cut, &across(3.0));
    let near = refuses(&cut, &across(2.5), TooClose);
    close(near.violations[0].amount, 0.5);
    let blunt = mitred(needle, Some(1.0));
    accepts(&blunt, &across(1.0));
    refuses(&blunt, &across(0.9), TooClose);
}

#[test]
fn circular_edges_grow_as_circular_edges() {
    let one = mitred(scene(1.5, vec![disc(3.0, 4.0, 5.0)]), None);
    accepts(&one, &arc(line(&[(9.5, 4.0)]), (3.0, 4.0), 360.0));
    refuses(&one, &arc(line(&[(9.4, 4.0)]), (3.0, 4.0), 360.0), TooClose);
    accepts(&one, &line(&[(-10.0, 10.5), (10.0, 10.5)]));
    refuses(&one, &line(&[(-10.0, 10.4), (10.0, 10.4)]), TooClose);
    // A half disc has two right angled corners between arc and straight edge.
    let half = mitred(scene(1.0, vec![bulged(&[(-5.0, 0.0), (5.0, 0.0)], &[0.0, 1.0])]), None);
    accepts(&half, &line(&[(-10.0, -1.0), (10.0, -1.0)]));
    accepts(&half, &line(&[(6.0, -5.0), (6.0, 0.0)]));
    refuses(&half, &line(&[(5.9, -5.0), (5.9, 0.0)]), TooClose);
    refuses(&half, &line(&[(4.0, -3.0), (8.0, 1.0)].map(|(x, y)| (x - 0.25, y + 0.25))), TooClose);
    accepts(&half, &line(&[(4.0, -3.0), (8.0, 1.0)]));
    accepts(&half, &line(&[(4.0, -3.0), (8.0, 1.0)].map(|(x, y)| (x + 0.5, y - 0.5))));
}

#[test]
fn concave_edges_grow_inwards() {
    // A block with a half round bite of radius 5 out of its upper side.
    let bite = bulged(
        &[(-10.0, 0.0), (-10.0, -10.0), (10.0, -10.0), (10.0, 0.0), (5.0, 0.0), (-5.0, 0.0)],
        &[0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
    );
    let one = mitred(scene(1.0, vec![bite]), None);
    // Corners of the bite are right angles: their kites reach one into the bite and one above it.
    accepts(&one, &arc(line(&[(4.0, 0.0)]), (0.0, 0.0), -180.0));
    refuses(&one, &arc(line(&[(4.5, 0.0)]), (0.0, 0.0), -180.0), TooClose);
    accepts(&one, &line(&[(0.0, 5.0), (0.0, -4.0)]));
    refuses(&one, &line(&[(0.0, 5.0), (0.0, -4.1)]), TooClose);
    refuses(&one, &line(&[(0.0, 5.0), (0.0, -5.1)]), InsideObstacle);
    accepts(&one, &line(&[(-20.0, 1.0), (20.0, 1.0)]));
}

#[test]
fn the_tip_of_an_antenna_has_a_barrier_and_the_end_of_a_slit_has_none() {
    let antenna =
        ring(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 5.0), (10.0, 5.0), (10.0, 10.0), (0.0, 10.0)]);
    let one = mitred(scene(1.0, vec![antenna]), Some(2.0));
    accepts(&one, &line(&[(22.0, -5.0), (22.0, 20.0)]));
    refuses(&one, &line(&[(21.9, -5.0), (21.9, 20.0)]), TooClose);
    accepts(&one, &line(&[(11.0, 6.0), (15.0, 6.0)]));
    refuses(&one, &line(&[(12.0, 5.5), (15.0, 5.5)]), TooClose);
    refuses(&one, &line(&[(15.0, 0.0), (15.0, 10.0)]), TooClose);
    let slit =
        ring(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (0.5, 5.0), (10.0, 5.0), (10.0, 10.0), (0.0, 10.0)]);
    let one = mitred(scene(1.0, vec![slit]), None);
    accepts(&one, &line(&[(-1.0, -5.0), (-1.0, 20.0)]));
    accepts(&one, &line(&[(11.0, -5.0), (11.0, 20.0)]));
}

#[test]
fn clearance_0_has_no_mitres() {
    let square = mitred(scene(0.0, vec![rectangle(0.0, 0.0, 10.0, 10.0)]), None);
    accepts(&square, &line(&[(-5.0, 10.0), (15.0, 10.0)]));
    accepts(&square, &line(&[(5.0, 15.0), (10.0, 10.0), (15.0, 5.0)]));
    refuses(&square, &line(&[(5.0, 15.0), (5.0, 5.0)]), InsideObstacle);
}
