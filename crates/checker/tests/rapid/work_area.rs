//! The work area: inside it, with its border's clearance, round its holes.

use crate::making::*;
use traverse_checker::ViolationReason::{
    BetweenTouchingObstacles, InsideObstacle, OutsideWorkArea, TooClose,
};
use traverse_checker::check_rapid_move;
use traverse_geometry::WORK_AREA_ID;
use traverse_geometry::{Point, Scene};

fn area(clearance_mm: f64) -> Scene {
    let shape = polygon(
        rectangle(0.0, 0.0, 100.0, 100.0),
        vec![rectangle(40.0, 40.0, 60.0, 60.0), disc(80.0, 80.0, 5.0)],
    );
    Scene { work_area: Some(shape), ..scene(clearance_mm, vec![]) }
}

#[test]
fn the_border_keeps_its_clearance() {
    let area = area(2.0);
    accepts(&area, &line(&[(2.0, 2.0), (98.0, 2.0), (98.0, 98.0), (2.0, 98.0), (2.0, 2.0)]));
    let near = refuses(&area, &line(&[(2.0, 1.5), (98.0, 1.5)]), TooClose);
    assert_eq!(near.violations[0].obstacle.as_deref(), Some(WORK_AREA_ID));
    close(near.violations[0].amount, 0.5);
    let out = refuses(&area, &line(&[(50.0, 20.0), (50.0, -3.0)]), OutsideWorkArea);
    assert!(out.violations[0].amount > 4.0 && out.violations[0].amount <= 5.0);
    let far = refuses(&area, &line(&[(500.0, 20.0), (500.0, 30.0)]), OutsideWorkArea);
    close(far.violations[0].amount, 402.0);
}

#[test]
fn holes_of_the_area_are_outside() {
    let area = area(2.0);
    refuses(&area, &line(&[(45.0, 50.0), (55.0, 50.0)]), OutsideWorkArea);
    refuses(&area, &line(&[(30.0, 50.0), (70.0, 50.0)]), OutsideWorkArea);
    accepts(&area, &line(&[(30.0, 38.0), (70.0, 38.0)]));
    refuses(&area, &line(&[(30.0, 38.5), (70.0, 38.5)]), TooClose);
    accepts(&area, &arc(line(&[(87.0, 80.0)]), (80.0, 80.0), 360.0));
    refuses(&area, &arc(line(&[(86.5, 80.0)]), (80.0, 80.0), 360.0), TooClose);
}

#[test]
fn the_border_may_have_its_own_clearance() {
    let mut own = area(2.0);
    own.work_area_clearance_mm = Some(0.0);
    accepts(&own, &line(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)]));
    accepts(&own, &line(&[(0.0, 50.0), (40.0, 60.0), (60.0, 60.0)]));
    refuses(&own, &line(&[(0.0, 50.0), (-1.0, 50.0)]), OutsideWorkArea);
    refuses(&own, &line(&[(0.0, 0.0), (100.0, -1e-5)]), OutsideWorkArea);
}

#[test]
fn reflex_corners_of_the_area_are_mitred() {
    let shape = polygon(
        ring(&[(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (10.0, 20.0), (10.0, 10.0), (0.0, 10.0)]),
        vec![],
    );
    let round = Scene { work_area: Some(shape), ..scene(2.0, vec![]) };
    let corner = to(arc(line(&[(5.0, 8.0), (10.0, 8.0)]), (10.0, 10.0), 90.0), 12.0, 15.0);
    accepts(&round, &corner);
    let sharp = mitred(round, None);
    refuses(&sharp, &corner, TooClose);
    accepts(&sharp, &line(&[(5.0, 8.0), (12.0, 8.0), (12.0, 15.0)]));
    refuses(&sharp, &line(&[(5.0, 8.0), (11.0, 8.0), (12.0, 9.0), (12.0, 15.0)]), TooClose);
    // Its outer corners have no mitres: they are concave as seen from the tool.
    accepts(&sharp, &line(&[(2.0, 8.0), (2.0, 2.0), (18.0, 2.0), (18.0, 18.0)]));
}

#[test]
fn outside_is_found_though_the_path_never_meets_the_border() {
    let check = refuses(&area(0.0), &line(&[(200.0, 0.0), (200.0, 50.0), (300.0, 50.0)]), OutsideWorkArea);
    assert_eq!(check.violations.len(), 2);
}

#[test]
fn obstacles_in_the_area_count_too() {
    let mut both = area(2.0);
    both.obstacles = scene(2.0, vec![rectangle(10.0, 10.0, 20.0, 20.0)]).obstacles;
    refuses(&both, &line(&[(15.0, 5.0), (15.0, 30.0)]), InsideObstacle);
    accepts(&both, &line(&[(15.0, 8.0), (15.0, 2.0)]));
}

#[test]
fn an_obstacle_that_touches_the_border_closes_it_at_clearance_0() {
    let mut both = area(0.0);
    both.obstacles = scene(0.0, vec![ring(&[(10.0, 0.0), (15.0, 10.0), (5.0, 10.0)])]).obstacles;
    refuses(&both, &line(&[(5.0, 0.0), (15.0, 0.0)]), BetweenTouchingObstacles);
    accepts(&both, &line(&[(5.0, 0.0), (10.0, 0.0)]));
    let start = Point::new(10.0, 0.0);
    let path = line(&[(10.0, 0.0), (50.0, 1.0)]);
    assert!(check_rapid_move(&both, start, path.end(), &path, TOLERANCE).is_sound());
}
