//! Ends inside barriers: the way out that the rules ask for.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{
    answer_by, assert_close, check_by, disc, mitred, plan_by, point, polygon, rectangle, scene, stars,
};
use traverse_checker::ViolationReason;
use traverse_geometry::{Edge, EndRule, Point, RapidRules, Scene, Segment, Vector, unit};
use traverse_planner::{Answer, Refusal};
use traverse_solve::Seed;

fn leave(rule: EndRule) -> RapidRules {
    RapidRules { leave: rule, ..RapidRules::default() }
}

fn nearest() -> RapidRules {
    leave(EndRule::Nearest)
}

fn towards(x: f64, y: f64) -> RapidRules {
    leave(EndRule::Direction(Vector::new(x, y)))
}

/// Where the way out of the start ends.
fn out(scene: &Scene, rules: &RapidRules, start: Point) -> Point {
    plan_by(scene, rules, start, point(500.0, 400.0)).path.steps[0].end
}

fn near(found: Point, expected: Point) {
    assert!((found - expected).norm() < 1e-9, "{found} is not {expected}");
}

fn shut_in(scene: &Scene, rules: &RapidRules, start: Point) -> &'static str {
    match answer_by(scene, rules, start, point(500.0, 400.0)) {
        Err(refusals) => match &refusals[..] {
            [Refusal::EndShutIn { field: "start", why, .. }] => why,
            other => panic!("{other:?}"),
        },
        other => panic!("{other:?}"),
    }
}

#[test]
fn straight_off_a_wall_a_corner_and_an_arc() {
    let block = scene([rectangle(0.0, 0.0, 100.0, 100.0)], 10.0);
    near(out(&block, &nearest(), point(40.0, -4.0)), point(40.0, -10.0));
    near(out(&block, &nearest(), point(-3.0, -4.0)), point(-6.0, -8.0));
    near(out(&block, &nearest(), point(40.0, 0.0)), point(40.0, -10.0));
    near(out(&block, &towards(3.0, -3.0), point(40.0, -4.0)), point(46.0, -10.0));
    near(out(&mitred(block.clone()), &nearest(), point(-3.0, -4.0)), point(-3.0, -10.0));
    // In the spike of a mitred corner, nearer to neither edge than asked.
    near(out(&mitred(block), &nearest(), point(-9.0, -9.5)), point(-9.0, -10.0));
    near(out(&scene([disc(0.0, 0.0, 20.0)], 5.0), &nearest(), point(0.0, 22.0)), point(0.0, 25.0));
}

#[test]
fn an_inner_corner_is_left_across() {
    let angle =
        polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 20.0), (20.0, 20.0), (20.0, 100.0), (0.0, 100.0)]);
    for scene in [scene([angle.clone()], 10.0), mitred(scene([angle], 10.0))] {
        near(out(&scene, &nearest(), point(23.0, 24.0)), point(30.0, 30.0));
        near(out(&scene, &nearest(), point(20.0, 20.0)), point(30.0, 30.0));
        near(out(&scene, &towards(0.0, 1.0), point(31.0, 24.0)), point(31.0, 30.0));
    }
}

#[test]
fn two_barriers_that_overlap_are_left_where_they_meet() {
    let walls = scene([disc(0.0, 0.0, 10.0), disc(26.0, 0.0, 10.0)], 8.0);
    let end = out(&walls, &nearest(), point(13.0, 1.0));
    near(end, point(13.0, (18.0_f64 * 18.0 - 13.0 * 13.0).sqrt()));
    let one = mitred(scene([rectangle(0.0, 0.0, 50.0, 10.0), rectangle(60.0, -50.0, 70.0, 60.0)], 6.0));
    near(out(&one, &nearest(), point(55.0, 15.0)), point(54.0, 16.0));
}

#[test]
fn a_slot_is_left_along_its_length() {
    // Walls 8 apart, 6 asked: nothing is clear inside. Nearer to the lower one, exactly along it, out past its end.
    let slot = scene([rectangle(0.0, 0.0, 100.0, 10.0), rectangle(0.0, 18.0, 100.0, 28.0)], 6.0);
    let end = out(&slot, &nearest(), point(90.0, 13.0));
    assert_close(end.y, 13.0, "along the slot");
    // Clear of both corners: (x − 100)² + 3² = 36 and (x − 100)² + 5² = 36.
    assert_close(end.x, 100.0 + 27.0_f64.sqrt(), "past the nearer corner");
    let end = out(&slot, &towards(1.0, 0.0), point(90.0, 13.0));
    assert_close(end.x, 100.0 + 27.0_f64.sqrt(), "in the same direction");
    assert!(shut_in(&slot, &towards(1.0, 0.1), point(90.0, 13.0)).contains("comes nearer"));
    // Closed at both ends.
    let mut closed = slot;
    closed.work_area = None;
    let cell = scene(
        [
            rectangle(0.0, 0.0, 100.0, 10.0),
            rectangle(0.0, 18.0, 100.0, 28.0),
            rectangle(-10.0, 0.0, 0.0, 28.0),
            rectangle(100.0, 0.0, 110.0, 28.0),
        ],
        6.0,
    );
    assert!(shut_in(&cell, &nearest(), point(50.0, 13.0)).contains("every straight way"));
}

#[test]
fn no_plate_is_too_thin_to_stop_it() {
    // The nearest clear ground lies behind a plate of a micrometre.
    let plates = scene([rectangle(0.0, 0.0, 100.0, 1e-3), rectangle(-20.0, 5.0, 120.0, 60.0)], 4.0);
    let end = out(&plates, &nearest(), point(2.0, 1.5));
    assert!(end.y >= 0.0 && end.x < 0.0, "{end}");
    assert!(shut_in(&plates, &towards(0.0, -1.0), point(50.0, 1.5)).contains("crosses an obstacle"));
}

#[test]
fn the_border_of_the_work_area_is_left_inwards() {
    let mut area = scene([], 5.0);
    area.work_area = Some(rectangle(0.0, 0.0, 600.0, 500.0));
    near(out(&area, &nearest(), point(2.0, 100.0)), point(5.0, 100.0));
    near(out(&area, &nearest(), point(1.0, 2.0)), point(5.0, 5.0));
    assert!(shut_in(&area, &nearest(), point(-2.0, 100.0)).contains("outside the work area"));
}

#[test]
fn inside_an_obstacle_there_is_no_way_out() {
    let block = scene([rectangle(0.0, 0.0, 100.0, 100.0)], 10.0);
    assert!(shut_in(&block, &nearest(), point(1.0, 50.0)).contains("inside the obstacle"));
    let refused =
        answer_by(&block, &RapidRules::default(), point(-1.0, 50.0), point(500.0, 0.0)).unwrap_err();
    assert!(matches!(refused[..], [Refusal::EndInsideBarrier { .. }]));
}

#[test]
fn both_ends_have_rules_of_their_own() {
    let block = scene([rectangle(0.0, 0.0, 100.0, 100.0)], 10.0);
    let rules = RapidRules { enter: EndRule::Direction(Vector::new(0.0, 2.0)), ..nearest() };
    let (start, target) = (point(-4.0, 50.0), point(40.0, 103.0));
    let found = plan_by(&block, &rules, start, target);
    near(found.path.steps[0].end, point(-10.0, 50.0));
    let last = found.path.steps.len() - 1;
    near(found.path.steps[last - 1].end, point(40.0, 110.0));
    let middle = plan_by(&block, &RapidRules::default(), point(-10.0, 50.0), point(40.0, 110.0));
    assert_close(found.cost, 6.0 + middle.cost + 7.0, "out, round, in");
    let refused = answer_by(&block, &nearest(), start, target).unwrap_err();
    assert!(matches!(refused[..], [Refusal::EndInsideBarrier { field: "target", .. }]));
    let stays = plan_by(&block, &RapidRules { enter: EndRule::Nearest, ..nearest() }, start, start);
    assert!(stays.path.steps.is_empty());
}

#[test]
fn the_checker_refuses_ways_out_that_are_none() {
    let block = scene([rectangle(0.0, 0.0, 100.0, 100.0)], 10.0);
    let (start, target) = (point(40.0, -4.0), point(-40.0, -40.0));
    let path = |points: &[(f64, f64)]| {
        let mut path = traverse_geometry::Path::at(start);
        points.iter().for_each(|&(x, y)| path.line_to(point(x, y)));
        path.line_to(target);
        path
    };
    let reasons = |points: &[(f64, f64)], rules: &RapidRules| {
        let check = check_by(&block, rules, start, target, &path(points));
        check
            .violations
            .iter()
            .map(|violation| (violation.reason, violation.field.clone()))
            .collect::<Vec<_>>()
    };
    let too_close = |step: usize| (ViolationReason::TooClose, format!("path.steps[{step}]"));
    assert_eq!(reasons(&[(40.0, -10.0)], &nearest()), []);
    assert_eq!(reasons(&[(40.0, -12.0)], &nearest()), []);
    assert_eq!(reasons(&[(40.0, -10.0)], &RapidRules::default()), [too_close(0)]);
    // Nearer than the start by ten tolerances; not far enough; in again after it was clear.
    assert_eq!(
        reasons(&[(30.0, -3.99999), (30.0, -10.0)], &nearest()),
        [too_close(0), too_close(0), too_close(1)]
    );
    assert_eq!(reasons(&[(40.0, -9.99999)], &nearest()).first(), Some(&too_close(0)));
    let round_the_corner = [(-30.0, -4.0), (-30.0, -20.0)];
    assert_eq!(reasons(&round_the_corner, &nearest()), []);
    assert_eq!(reasons(&[(40.0, -10.0)], &towards(0.0, -3.0)), []);
    let wrong = (ViolationReason::WrongDirection, "path.steps[0]".to_owned());
    assert_eq!(reasons(&[(40.0, -10.0)], &towards(1e-5, -6.0)), [wrong]);
}

#[test]
fn the_checker_refuses_a_way_that_enters_again() {
    // Between two blocks there is a clear window; a straight line on past it is no way out.
    let blocks = scene([rectangle(0.0, 0.0, 20.0, 20.0), rectangle(60.0, 0.0, 80.0, 20.0)], 10.0);
    let start = point(22.0, -2.0);
    let mut path = traverse_geometry::Path::at(start);
    path.line_to(point(72.0, -3.0));
    path.line_to(point(72.0, -30.0));
    let check = check_by(&blocks, &nearest(), start, point(72.0, -30.0), &path);
    assert!(check.violations.iter().any(|violation| violation.reason == ViolationReason::TooClose));
}

/// Straight ways by the original distances alone.
struct Brute<'a> {
    scene: &'a Scene,
    start: Point,
    /// Distance of the start, per obstacle, but at most its clearance.
    kept: Vec<f64>,
}

impl<'a> Brute<'a> {
    fn new(scene: &'a Scene, start: Point) -> Self {
        let kept =
            |o: &traverse_geometry::Obstacle| o.shape.distance_to_border(start).min(scene.clearance_of(o));
        Self { scene, start, kept: scene.obstacles.iter().map(kept).collect() }
    }

    fn is_clear(&self, p: Point) -> bool {
        self.scene
            .obstacles
            .iter()
            .all(|o| o.shape.distance_to_border(p) >= self.scene.clearance_of(o) - 1e-9)
    }

    fn is_legal(&self, end: Point) -> bool {
        let way = Edge::Segment(Segment::new(self.start, end));
        self.scene.obstacles.iter().zip(&self.kept).all(|(o, kept)| {
            o.shape
                .rings()
                .flat_map(traverse_geometry::Ring::edges)
                .all(|edge| edge.distance(&way) >= kept - 1e-9)
        })
    }

    /// The shortest way out found among many directions: an upper bound.
    fn shortest(&self) -> f64 {
        let mut best = f64::INFINITY;
        for i in 0..720 {
            let direction = unit(f64::from(i) * std::f64::consts::TAU / 720.0);
            let steps = 200;
            let longest = f64::min(best, 40.0);
            let clear = (1..=steps)
                .map(|step| longest * f64::from(step) / f64::from(steps))
                .find(|way| self.is_clear(self.start + direction * *way));
            if let Some(way) = clear.filter(|&way| self.is_legal(self.start + direction * way)) {
                best = best.min(way);
            }
        }
        best
    }
}

#[test]
fn no_direction_is_shorter_than_the_nearest_way() {
    let (mut ways, mut shut) = (0, 0);
    for case in 0..240 {
        let mut random = Seed(5).part(case).stream();
        let mut shapes = stars(&mut random, 7, 60.0, 14.0);
        shapes.push(disc(random.random_range(0.0..60.0), random.random_range(0.0..60.0), 7.0));
        let scene = scene(shapes, [1.5, 4.0, 7.0][case as usize % 3]);
        let start = point(random.random_range(0.0..60.0), random.random_range(0.0..60.0));
        if scene.obstacles.iter().any(|o| o.shape.contains(start)) {
            continue;
        }
        let brute = Brute::new(&scene, start);
        if brute.is_clear(start) {
            continue;
        }
        let bound = brute.shortest();
        match answer_by(&scene, &nearest(), start, point(-100.0, -100.0)) {
            Ok(Answer::Plan(plan)) => {
                ways += 1;
                let end = plan.path.steps[0].end;
                let length = (end - start).norm();
                assert!(
                    length <= bound + 1e-6,
                    "case {case}: {length} to {end}, brute {bound}\n{start} {scene:?}"
                );
                // The grid of directions is not far off where ways are wide.
                assert!(bound - length < 0.5 || bound.is_infinite() || bound > 1.05 * length, "case {case}");
                let grown =
                    Brute { scene: &scene, start, kept: brute.kept.iter().map(|kept| kept - 1e-6).collect() };
                assert!(grown.is_legal(end), "case {case}");
            }
            Ok(Answer::NoPath(_)) => ways += 1,
            Err(refusals) => {
                assert!(matches!(refusals[..], [Refusal::EndShutIn { .. }]), "{refusals:?}");
                assert!(bound.is_infinite(), "case {case}: {start}, a way of {bound}\n{scene:?}");
                shut += 1;
            }
        }
    }
    assert!(ways > 40, "{ways} ways, {shut} shut in");
}

#[test]
fn mitred_ways_are_sound_and_turn_with_the_scene() {
    let mut ways = 0;
    for case in 0..150 {
        let mut random = Seed(6).part(case).stream();
        let shapes = stars(&mut random, 6, 60.0, 14.0);
        let scene = mitred(scene(shapes, [1.5, 4.0, 7.0][case as usize % 3]));
        let start = point(random.random_range(0.0..60.0), random.random_range(0.0..60.0));
        if let Ok(Answer::Plan(plan)) = answer_by(&scene, &nearest(), start, point(-200.0, -200.0)) {
            ways += 1;
            let turn = traverse_geometry::Motion::quarter_turns(1);
            let mut turned = scene.clone();
            for obstacle in &mut turned.obstacles {
                obstacle.shape = obstacle.shape.moved(&turn);
            }
            let other = plan_by(&turned, &nearest(), turn.point(start), turn.point(point(-200.0, -200.0)));
            let length =
                |plan: &traverse_planner::RapidPlan| (plan.path.steps[0].end - plan.path.start).norm();
            assert_close(length(&plan), length(&other), &format!("case {case}"));
        }
    }
    assert!(ways > 30, "{ways}");
}
