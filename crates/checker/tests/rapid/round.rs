//! Round clearance, and clearance 0 as far as nothing touches.

use crate::making::*;
use traverse_checker::ViolationReason::{InsideObstacle, TooClose};

#[test]
fn a_straight_step_keeps_its_distance() {
    let scene = scene(2.0, vec![rectangle(0.0, 0.0, 10.0, 10.0)]);
    close(
        accepts(&scene, &line(&[(-5.0, 13.0), (15.0, 13.0)])).smallest_margin_mm.expect("an obstacle"),
        1.0,
    );
    close(
        accepts(&scene, &line(&[(-5.0, 12.0), (15.0, 12.0)])).smallest_margin_mm.expect("an obstacle"),
        0.0,
    );
    let near = refuses(&scene, &line(&[(-5.0, 11.5), (15.0, 11.5)]), TooClose);
    close(near.violations[0].amount, 0.5);
    close(near.smallest_margin_mm.expect("an obstacle"), -0.5);
    assert_eq!(near.violations[0].obstacle.as_deref(), Some("a"));
    let through = refuses(&scene, &line(&[(-5.0, 5.0), (15.0, 5.0)]), InsideObstacle);
    close(through.violations[0].amount, 7.0);
    close(through.smallest_margin_mm.expect("an obstacle"), -7.0);
    assert_eq!(through.violations[0].at, Some(p(5.0, 5.0)));
}

#[test]
fn a_corner_is_turned_on_its_arc() {
    let scene = scene(2.0, vec![rectangle(0.0, 0.0, 10.0, 10.0)]);
    let round = to(arc(line(&[(5.0, 12.0), (10.0, 12.0)]), (10.0, 10.0), -90.0), 12.0, 5.0);
    accepts(&scene, &round);
    refuses(&scene, &line(&[(5.0, 12.0), (10.0, 12.0), (12.0, 10.0), (12.0, 5.0)]), TooClose);
    accepts(&scene, &line(&[(5.0, 12.0), (12.0, 12.0), (12.0, 5.0)]));
    // The long way round the same circle cuts through the square.
    refuses(&scene, &arc(line(&[(10.0, 12.0)]), (10.0, 10.0), 270.0), InsideObstacle);
}

#[test]
fn a_disc_is_gone_round() {
    let scene = scene(1.5, vec![disc(3.0, 4.0, 5.0)]);
    accepts(&scene, &arc(line(&[(9.5, 4.0)]), (3.0, 4.0), 360.0));
    accepts(&scene, &arc(line(&[(9.5, 4.0)]), (3.0, 4.0), -200.0));
    refuses(&scene, &arc(line(&[(9.4, 4.0)]), (3.0, 4.0), 360.0), TooClose);
    close(
        refuses(&scene, &arc(line(&[(6.0, 4.0)]), (3.0, 4.0), 30.0), InsideObstacle).violations[0].amount,
        3.5,
    );
    accepts(&scene, &line(&[(-10.0, 10.5), (10.0, 10.5)]));
    refuses(&scene, &line(&[(-10.0, 10.4), (10.0, 10.4)]), TooClose);
}

#[test]
fn a_path_far_inside_is_seen_though_no_border_is_near() {
    let scene = scene(1.0, vec![rectangle(0.0, 0.0, 100.0, 100.0)]);
    let check = refuses(&scene, &line(&[(40.0, 40.0), (60.0, 50.0), (50.0, 60.0)]), InsideObstacle);
    assert_eq!(check.violations.len(), 2);
    // Deepest where the step leaves the lower side for the right one: 46 2/3. Depth is sampled.
    let margin = check.smallest_margin_mm.expect("an obstacle");
    assert!((-47.0 - 2.0 / 3.0..-47.0).contains(&margin), "{margin}");
}

#[test]
fn holes_are_free_and_their_borders_are_not() {
    let mut holed = scene(1.0, vec![]);
    let ring_shape = polygon(disc(0.0, 0.0, 10.0), vec![disc(0.0, 0.0, 6.0)]);
    holed.obstacles.push(traverse_geometry::Obstacle {
        id: "ring".into(),
        shape: ring_shape,
        clearance_mm: None,
        top_z_mm: None,
    });
    accepts(&holed, &line(&[(-4.0, 0.0), (4.0, 0.0)]));
    accepts(&holed, &arc(line(&[(5.0, 0.0)]), (0.0, 0.0), 360.0));
    refuses(&holed, &arc(line(&[(5.1, 0.0)]), (0.0, 0.0), 360.0), TooClose);
    close(
        refuses(&holed, &arc(line(&[(8.0, 0.0)]), (0.0, 0.0), 300.0), InsideObstacle).violations[0].amount,
        3.0,
    );
    refuses(&holed, &line(&[(0.0, 0.0), (20.0, 0.0)]), InsideObstacle);
}

#[test]
fn obstacles_may_have_their_own_clearance() {
    let mut own = scene(1.0, vec![rectangle(0.0, 0.0, 10.0, 10.0), rectangle(0.0, 20.0, 10.0, 30.0)]);
    own.obstacles[1].clearance_mm = Some(4.0);
    accepts(&own, &line(&[(-5.0, 14.0), (20.0, 14.0)]));
    let near = refuses(&own, &line(&[(-5.0, 18.0), (20.0, 18.0)]), TooClose);
    assert_eq!(near.violations[0].obstacle.as_deref(), Some("b"));
    close(near.violations[0].amount, 2.0);
    own.obstacles[1].clearance_mm = Some(0.0);
    accepts(&own, &line(&[(-5.0, 20.0), (20.0, 20.0)]));
}

#[test]
fn gaps_of_exactly_twice_the_clearance_are_open() {
    for origin in [0.0, 20_000.0] {
        let pair = |gap: f64| {
            let y = origin + 10.0 + gap;
            scene(1.1, vec![rectangle(0.0, origin, 10.0, origin + 10.0), rectangle(0.0, y, 10.0, y + 10.0)])
        };
        let through = line(&[(-5.0, origin + 11.1), (15.0, origin + 11.1)]);
        accepts(&pair(2.2), &through);
        accepts(&pair(2.2 + 1e-9), &through);
        accepts(&pair(2.2 - 1e-6), &through);
        refuses(&pair(2.2 - 1e-4), &through, TooClose);
    }
}

#[test]
fn at_clearance_0_paths_slide_along_edges_and_past_vertices() {
    for (x, y) in [(0.0, 0.0), (20_000.0, -20_000.0)] {
        let scene = scene(0.0, vec![rectangle(x, y, x + 10.0, y + 10.0)]);
        let slide = [(x - 5.0, y + 10.0), (x + 15.0, y + 10.0)];
        close(accepts(&scene, &line(&slide)).smallest_margin_mm.expect("an obstacle"), 0.0);
        let round = [(x, y), (x + 10.0, y), (x + 10.0, y + 10.0), (x, y + 10.0), (x, y)];
        accepts(&scene, &line(&round));
        accepts(&scene, &line(&[(x - 5.0, y + 5.0), (x, y + 10.0), (x + 5.0, y + 15.0)]));
        accepts(
            &scene,
            &line(&[(x - 3.0, y + 9.0), (x, y + 10.0), (x + 10.0, y + 10.0), (x + 11.0, y + 2.0)]),
        );
        refuses(&scene, &line(&[(x, y + 5.0), (x + 10.0, y + 5.0)]), InsideObstacle);
        refuses(&scene, &line(&[(x, y), (x + 10.0, y + 10.0)]), InsideObstacle);
        let deep = refuses(
            &scene,
            &line(&[(x - 5.0, y + 10.0 - 1e-5), (x + 15.0, y + 10.0 - 1e-5)]),
            InsideObstacle,
        );
        assert!((deep.violations[0].amount - 1e-5).abs() < 1e-9);
        accepts(&scene, &line(&[(x - 5.0, y + 10.0 - 9e-7), (x + 15.0, y + 10.0 - 9e-7)]));
    }
}

#[test]
fn at_clearance_0_paths_slide_along_arcs() {
    let one = scene(0.0, vec![disc(0.0, 0.0, 5.0)]);
    accepts(&one, &arc(line(&[(5.0, 0.0)]), (0.0, 0.0), 360.0));
    accepts(&one, &to(arc(line(&[(5.0, -8.0), (5.0, 0.0)]), (0.0, 0.0), 180.0), -5.0, -8.0));
    accepts(&one, &line(&[(-8.0, 5.0), (8.0, 5.0)]));
    refuses(&one, &arc(line(&[(5.0 - 1e-5, 0.0)]), (0.0, 0.0), 360.0), InsideObstacle);
    refuses(&one, &line(&[(-5.0, 0.0), (5.0, 0.0)]), InsideObstacle);
    // A chord of an arc that it should follow.
    let near = std::f64::consts::FRAC_PI_4;
    refuses(&one, &line(&[(5.0, 0.0), (5.0 * near.cos(), 5.0 * near.sin())]), InsideObstacle);
}

#[test]
fn concave_corners_and_pockets_are_entered_as_far_as_they_go() {
    let pocket = || {
        ring(&[
            (0.0, 0.0),
            (30.0, 0.0),
            (30.0, 20.0),
            (20.0, 20.0),
            (20.0, 5.0),
            (10.0, 5.0),
            (10.0, 20.0),
            (0.0, 20.0),
        ])
    };
    accepts(
        &scene(0.0, vec![pocket()]),
        &line(&[(15.0, 30.0), (10.0, 20.0), (10.0, 5.0), (20.0, 5.0), (20.0, 30.0)]),
    );
    let round = scene(2.0, vec![pocket()]);
    accepts(&round, &line(&[(12.0, 20.0), (12.0, 7.0), (18.0, 7.0), (18.0, 20.0)]));
    refuses(&round, &line(&[(12.0, 20.0), (12.0, 6.9), (18.0, 6.9)]), TooClose);
}
