//! Heights: rise, travel at the best of all levels, descend.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{
    answer, answer_by, assert_close, check_by, disc, mitred, plan, plan_by, point, rectangle, scene, stars,
};
use traverse_checker::ViolationReason;
use traverse_geometry::{CONTACT_TOLERANCE_MM, EndRule, HeightRule, Point, RapidRules, Scene};
use traverse_planner::{Answer, FeasibleClearance, Refusal};
use traverse_solve::Seed;

fn heights(start: f64, target: f64, highest: f64, clearance: f64) -> RapidRules {
    let rule = HeightRule {
        start_z_mm: start,
        target_z_mm: target,
        highest_z_mm: highest,
        clearance_z_mm: clearance,
    };
    RapidRules { heights: Some(rule), ..RapidRules::default() }
}

fn topped(mut scene: Scene, tops: &[Option<f64>]) -> Scene {
    for (obstacle, top) in scene.obstacles.iter_mut().zip(tops) {
        obstacle.top_z_mm = *top;
    }
    scene
}

/// What is in the way at a height, and nothing else.
fn at_height(scene: &Scene, rule: &HeightRule, z: f64) -> Scene {
    let mut left = scene.clone();
    left.obstacles.retain(|obstacle| obstacle.top_z_mm.is_none_or(|top| top + rule.clearance_z_mm > z));
    left
}

/// The cheapest of all levels, one after the other.
fn enumerated(scene: &Scene, rule: &HeightRule, start: Point, target: Point) -> Option<f64> {
    let lowest = rule.start_z_mm.max(rule.target_z_mm);
    let tops = scene.obstacles.iter().filter_map(|obstacle| obstacle.top_z_mm);
    let levels = tops.map(|top| top + rule.clearance_z_mm).chain([lowest]);
    levels
        .filter(|&z| z >= lowest && z <= rule.highest_z_mm)
        .filter_map(|z| match answer(&at_height(scene, rule, z), start, target) {
            Ok(Answer::Plan(plan)) => Some(plan.cost + (z - rule.start_z_mm) + (z - rule.target_z_mm)),
            _ => None,
        })
        .min_by(f64::total_cmp)
}

#[test]
fn a_low_wall_is_passed_over_and_a_high_one_gone_round() {
    let walls = [rectangle(0.0, -100.0, 10.0, 100.0), rectangle(30.0, -20.0, 40.0, 20.0)];
    let scene = topped(scene(walls, 2.0), &[Some(5.0), Some(50.0)]);
    let rules = heights(1.0, 0.0, 60.0, 2.0);
    let found = plan_by(&scene, &rules, point(-10.0, 0.0), point(60.0, 0.0));
    // Up to 7, round the second wall, down.
    let round = plan(&at_height(&scene, &rules.heights.unwrap(), 7.0), point(-10.0, 0.0), point(60.0, 0.0));
    assert_close(found.cost, 6.0 + 7.0 + round.cost, "over one and round the other");
    assert_eq!(found.bending_obstacles, ["o1"]);
    assert_eq!(found.path.start_z_mm, Some(1.0));
    assert_eq!(found.path.steps.first().unwrap().z_mm, Some(7.0));
    assert_eq!(found.path.end_z_mm(), Some(0.0));
    // Too low a ceiling: round both.
    let round = plan_by(&scene, &heights(1.0, 0.0, 6.9, 2.0), point(-10.0, 0.0), point(60.0, 0.0));
    assert!(round.cost > 200.0);
    assert_eq!(round.path.steps.first().unwrap().z_mm, Some(1.0));
}

#[test]
fn straight_up_and_down_and_nowhere() {
    let scene = scene([], 2.0);
    let here = point(3.0, 4.0);
    assert_eq!(plan_by(&scene, &heights(1.0, 9.0, 9.0, 0.0), here, here).cost, 8.0);
    assert_eq!(plan_by(&scene, &heights(9.0, 1.0, 20.0, 0.0), here, here).cost, 8.0);
    let stays = plan_by(&scene, &heights(5.0, 5.0, 20.0, 0.0), here, here);
    assert!(stays.path.steps.is_empty() && stays.cost == 0.0);
}

#[test]
fn an_end_above_a_low_obstacle_is_clear_and_one_beside_it_is_not() {
    let scene = topped(scene([rectangle(0.0, 0.0, 10.0, 10.0)], 2.0), &[Some(5.0)]);
    let (inside, outside) = (point(5.0, 5.0), point(-10.0, 5.0));
    assert_eq!(plan_by(&scene, &heights(7.0, 0.0, 9.0, 2.0), inside, outside).cost, 15.0 + 7.0);
    let refused = answer_by(&scene, &heights(6.9, 0.0, 9.0, 2.0), inside, outside).unwrap_err();
    assert!(matches!(refused[..], [Refusal::EndInsideBarrier { field: "start", .. }]), "{refused:?}");
    // Out of the clearance at its own height, then as ever.
    let rules = RapidRules { leave: EndRule::Nearest, ..heights(0.0, 0.0, 9.0, 2.0) };
    let found = plan_by(&scene, &rules, point(-1.0, 5.0), point(-10.0, 5.0));
    assert_close(found.cost, 9.0, "one millimetre out, eight on");
    assert_eq!(found.path.steps[0].end, point(-2.0, 5.0));
}

#[test]
fn a_seam_is_left_upwards() {
    // At clearance 0 nothing leaves the seam in the plane.
    let blocks = [rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)];
    let scene = topped(scene(blocks, 0.0), &[Some(3.0), Some(3.0)]);
    let found = plan_by(&scene, &heights(0.0, 0.0, 9.0, 1.0), point(10.0, 5.0), point(30.0, 5.0));
    assert_close(found.cost, 20.0 + 8.0, "up, over, down");
}

#[test]
fn no_path_at_the_highest_is_no_path() {
    let ring = [
        rectangle(0.0, 0.0, 100.0, 10.0),
        rectangle(0.0, 90.0, 100.0, 100.0),
        rectangle(0.0, 0.0, 10.0, 100.0),
        rectangle(90.0, 0.0, 100.0, 100.0),
    ];
    let scene = topped(scene(ring, 1.0), &[Some(20.0), Some(30.0), Some(40.0), None]);
    let (start, target) = (point(50.0, 50.0), point(200.0, 50.0));
    let Ok(Answer::NoPath(shut)) = answer_by(&scene, &heights(0.0, 0.0, 20.5, 1.0), start, target) else {
        panic!("a path below the tops")
    };
    assert_eq!(shut.separating_obstacles, ["o0", "o1", "o2", "o3"]);
    assert_eq!(shut.feasible_clearance, FeasibleClearance::None);
    let over = plan_by(&scene, &heights(0.0, 0.0, 21.0, 1.0), start, target);
    assert_eq!(over.path.steps[0].z_mm, Some(21.0));
}

#[test]
fn levels_are_as_enumerated_and_no_lower_one_passes_the_checker() {
    let (mut plans, mut raised, mut refused) = (0, 0, 0);
    for case in 0..250 {
        let mut random = Seed(41).part(case).stream();
        let mut shapes = stars(&mut random, 12, 100.0, 22.0);
        shapes.extend((0..3).map(|_| {
            disc(
                random.random_range(0.0..100.0),
                random.random_range(0.0..100.0),
                random.random_range(3.0..15.0),
            )
        }));
        shapes.push(rectangle(45.0, -30.0, 50.0, 130.0));
        let tops: Vec<Option<f64>> = shapes
            .iter()
            .map(|_| {
                (random.random_range(0.0..1.0) < 0.8).then(|| random.random_range(0.0..40.0_f64).round())
            })
            .collect();
        let base = topped(scene(shapes, [0.0, 0.7, 3.0][case as usize % 3]), &tops);
        let scene = if case % 2 == 0 { base } else { mitred(base) };
        let mut z = || random.random_range(0.0..20.0);
        let (start_z, target_z) = (z(), z());
        let rules = heights(start_z, target_z, 20.0 + 2.0 * z(), 1.5);
        let rule = rules.heights.unwrap();
        let mut end = |x: f64| point(x, random.random_range(0.0..100.0));
        let (start, target) = (end(5.0), end(95.0));
        match answer_by(&scene, &rules, start, target) {
            Err(refusals) => {
                refused += 1;
                let at = |end, z| answer(&at_height(&scene, &rule, z), end, end).is_err();
                assert!(at(start, start_z) || at(target, target_z), "case {case}: {refusals:?}");
            }
            Ok(Answer::NoPath(_)) => {
                assert_eq!(enumerated(&scene, &rule, start, target), None, "case {case}");
            }
            Ok(Answer::Plan(found)) => {
                plans += 1;
                let expected = enumerated(&scene, &rule, start, target).unwrap();
                assert_close(found.cost, expected, &format!("case {case}"));
                let level = found.path.steps.iter().filter_map(|step| step.z_mm).fold(start_z, f64::max);
                if level > start_z.max(target_z) {
                    raised += 1;
                    let mut lower = found.path.clone();
                    for z in lower.steps.iter_mut().filter_map(|step| step.z_mm.as_mut()) {
                        if *z == level {
                            *z -= 10.0 * CONTACT_TOLERANCE_MM;
                        }
                    }
                    let check = check_by(&scene, &rules, start, target, &lower);
                    let too_low = |v: &traverse_checker::Violation| {
                        v.reason == ViolationReason::TooLow && (v.amount - 1e-5).abs() < 1e-9
                    };
                    assert!(check.violations.iter().any(too_low), "case {case}: {:?}", check.violations);
                }
            }
        }
    }
    assert!(plans > 100 && raised > 50 && refused > 10, "{plans} {raised} {refused}");
}

#[test]
fn wrong_heights_are_seen() {
    let scene = scene([], 1.0);
    let (start, target) = (point(0.0, 0.0), point(10.0, 0.0));
    let rules = heights(1.0, 2.0, 5.0, 0.0);
    let sound = plan_by(&scene, &rules, start, target).path;
    let reasons = |path: &traverse_geometry::Path, rules: &RapidRules| {
        let check = check_by(&scene, rules, start, target, path);
        check.violations.iter().map(|violation| violation.reason).collect::<Vec<_>>()
    };
    use ViolationReason::{HeightMismatch, SlantedStep, TooHigh, WrongEnd, WrongStart};
    assert_eq!(reasons(&sound, &RapidRules::default()), [HeightMismatch; 3]);
    let mut flat = traverse_geometry::Path::at(start);
    flat.line_to(target);
    assert_eq!(reasons(&flat, &rules), [HeightMismatch; 2]);
    let mut path = sound.clone();
    path.start_z_mm = Some(0.5);
    assert_eq!(reasons(&path, &rules), [WrongStart]);
    let mut path = sound.clone();
    path.steps.last_mut().unwrap().z_mm = Some(2.5);
    assert_eq!(reasons(&path, &rules), [WrongEnd, SlantedStep]);
    let mut path = sound.clone();
    path.steps[0].z_mm = Some(6.0);
    assert_eq!(reasons(&path, &rules), [TooHigh, SlantedStep]);
}
