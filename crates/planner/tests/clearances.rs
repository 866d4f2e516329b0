//! Lists of clearances, and the most that a path could keep where there is none.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{
    answer, answer_by, disc, mitred, no_path, plan, plan_by, point, polygon, query, rectangle, ring, scene,
};
use traverse_geometry::{CONTACT_TOLERANCE_MM, EndRule, Polygon, RapidRules, Scene};
use traverse_planner::{Answer, FeasibleClearance, RapidMove, Refusal, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

fn choices(clearances_mm: &[f64]) -> RapidRules {
    RapidRules { clearances_mm: clearances_mm.to_vec(), ..RapidRules::default() }
}

/// A room that one gap of width `gap` leads out of.
fn room(gap: f64, clearance: f64) -> Scene {
    let walls = [
        rectangle(0.0, 0.0, 100.0, 10.0),
        rectangle(0.0, 90.0, 100.0, 100.0),
        rectangle(0.0, 0.0, 10.0, 100.0),
        rectangle(90.0, 0.0, 100.0, 50.0),
        rectangle(90.0, 50.0 + gap, 100.0, 100.0),
    ];
    scene(walls, clearance)
}

fn feasible(scene: &Scene) -> f64 {
    let shut = no_path(scene, point(50.0, 50.0), point(300.0, 50.0));
    match shut.feasible_clearance {
        FeasibleClearance::Millimetres(clearance) => clearance,
        other => panic!("{other:?}"),
    }
}

fn assert_just_below(found: f64, expected: f64) {
    assert!(found <= expected + 1e-9 && found > expected - 1.5e-6, "{found} is not just below {expected}");
}

#[test]
fn the_largest_clearance_that_admits_a_path_counts() {
    let (start, target) = (point(50.0, 50.0), point(300.0, 50.0));
    let scene = room(5.0, 9.0);
    let found = plan_by(&scene, &choices(&[4.0, 2.6, 2.4, 1.0]), start, target);
    assert_eq!(found.clearance_mm, 2.4);
    let alone = plan(&Scene { clearance_mm: 2.4, ..scene.clone() }, start, target);
    assert_eq!(found.path, alone.path);
    assert_eq!(plan_by(&scene, &choices(&[2.5]), start, target).clearance_mm, 2.5);
    let shut = answer_by(&scene, &choices(&[4.0, 3.0]), start, target);
    let Ok(Answer::NoPath(shut)) = shut else { panic!("{shut:?}") };
    let FeasibleClearance::Millimetres(feasible) = shut.feasible_clearance else { panic!("{shut:?}") };
    assert_just_below(feasible, 2.5);
}

#[test]
fn an_end_inside_the_larger_barrier_makes_way_for_the_smaller() {
    let scene = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 9.0);
    let (start, target) = (point(-2.0, 5.0), point(30.0, 5.0));
    assert_eq!(plan_by(&scene, &choices(&[5.0, 3.0, 2.0, 1.0]), start, target).clearance_mm, 2.0);
    let refused = answer_by(&scene, &choices(&[5.0, 3.0]), start, target).unwrap_err();
    assert!(
        matches!(refused[..], [Refusal::EndInsideBarrier { depth_mm, .. }] if (depth_mm - 1.0).abs() < 1e-9)
    );
    let rules = RapidRules { leave: EndRule::Nearest, ..choices(&[5.0, 3.0]) };
    assert_eq!(plan_by(&scene, &rules, start, target).clearance_mm, 5.0);
}

#[test]
fn obstacles_keep_clearances_of_their_own() {
    let mut scene = room(5.0, 9.0);
    scene.obstacles[4].clearance_mm = Some(3.0);
    let (start, target) = (point(50.0, 50.0), point(300.0, 50.0));
    assert_eq!(plan_by(&scene, &choices(&[2.5, 2.1, 2.0, 1.0]), start, target).clearance_mm, 2.0);
}

#[test]
fn gaps_of_straight_walls_are_half_as_wide() {
    for gap in [0.5, 3.0, 5.0, 17.25] {
        assert_just_below(feasible(&room(gap, 12.0)), gap / 2.0);
        assert_just_below(feasible(&mitred(room(gap, 12.0))), gap / 2.0);
    }
}

#[test]
fn all_clearances_are_lowered_by_the_same_amount() {
    let mut scene = room(5.0, 12.0);
    scene.obstacles[3].clearance_mm = Some(8.0);
    // 12 − s + 8 − s = 5.
    assert_just_below(feasible(&scene), 12.0 - 7.5);
    scene.obstacles[3].clearance_mm = Some(0.5);
    // Down to 0 there; 12 − s = 5.
    assert_just_below(feasible(&scene), 5.0);
}

#[test]
fn gaps_inside_one_obstacle_and_between_arcs_count() {
    let c_shape = polygon(&[
        (0.0, 0.0),
        (100.0, 0.0),
        (100.0, 48.0),
        (90.0, 48.0),
        (90.0, 10.0),
        (10.0, 10.0),
        (10.0, 90.0),
        (90.0, 90.0),
        (90.0, 51.0),
        (100.0, 51.0),
        (100.0, 100.0),
        (0.0, 100.0),
    ]);
    assert_just_below(feasible(&scene([c_shape], 8.0)), 1.5);
    let discs = (0..24).map(|i| {
        let angle = f64::from(i) * std::f64::consts::TAU / 24.0;
        disc(50.0 + 90.0 * angle.cos(), 50.0 + 90.0 * angle.sin(), 8.0)
    });
    let gap = 2.0 * 90.0 * (std::f64::consts::PI / 24.0).sin() - 16.0;
    assert_just_below(feasible(&scene(discs, 6.0)), gap / 2.0);
}

#[test]
fn a_closed_room_has_none_and_a_slit_of_nothing_only_zero() {
    let shape = Polygon::new(
        ring(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]),
        vec![ring(&[(10.0, 10.0), (90.0, 10.0), (90.0, 90.0), (10.0, 90.0)])],
    );
    let shut = no_path(&scene([shape.unwrap()], 5.0), point(50.0, 50.0), point(300.0, 50.0));
    assert_eq!(shut.feasible_clearance, FeasibleClearance::None);
    let shut = no_path(&room(0.0, 0.0), point(50.0, 50.0), point(300.0, 50.0));
    assert_eq!(shut.feasible_clearance, FeasibleClearance::None);
    assert_eq!(feasible(&room(1e-4, 5.0)), 0.0);
}

#[test]
fn a_budget_that_ends_leaves_the_answer_standing() {
    let query = RapidMove { ..query(point(50.0, 50.0), point(300.0, 50.0)) };
    let scene = room(5.0, 9.0);
    let (_, stats) = plan_rapid_move(&scene, &query, &Budget::unlimited(), &mut Silent).unwrap();
    let budget = Budget { iterations: Some(stats.expanded_nodes / 2), ..Budget::unlimited() };
    let (answer, _) = plan_rapid_move(&scene, &query, &budget, &mut Silent).unwrap();
    let Answer::NoPath(shut) = answer else { panic!("{answer:?}") };
    assert_eq!(shut.feasible_clearance, FeasibleClearance::Unknown);
    assert!(!shut.separating_obstacles.is_empty());
}

#[test]
fn what_is_feasible_is_planned_and_a_little_more_is_not() {
    let (mut shut_scenes, mut discs_shut) = (0, 0);
    for case in 0..60 {
        let mut random = Seed(77).part(case).stream();
        // A wall of discs and squares right across, in a work area.
        let shapes: Vec<Polygon> = (0..12)
            .map(|i| {
                let (x, y) = (random.random_range(45.0..55.0), 100.0 / 12.0 * (f64::from(i) + 0.5));
                let size = random.random_range(0.5..3.5);
                if case % 2 == 0 {
                    disc(x, y, size)
                } else {
                    rectangle(x - size, y - size, x + size, y + size)
                }
            })
            .collect();
        let mut scene = scene(shapes, 6.0);
        scene.work_area = Some(rectangle(0.0, 0.0, 100.0, 100.0));
        scene.work_area_clearance_mm = (case % 3 == 0).then_some(2.0);
        let (start, target) = (point(10.0, 50.0), point(90.0, 50.0));
        let Ok(Answer::NoPath(shut)) = answer(&scene, start, target) else { continue };
        shut_scenes += 1;
        discs_shut += usize::from(case % 2 == 0);
        let FeasibleClearance::Millimetres(clearance) = shut.feasible_clearance else { panic!("{shut:?}") };
        let at = |clearance_mm: f64| {
            let by = scene.clearance_mm - clearance_mm;
            let work_area_clearance_mm = scene.work_area_clearance_mm.map(|mm| (mm - by).max(0.0));
            Scene { clearance_mm, work_area_clearance_mm, ..scene.clone() }
        };
        plan(&at(clearance), start, target);
        no_path(&at(clearance + 2.0 * CONTACT_TOLERANCE_MM), start, target);
    }
    assert!(shut_scenes > 30 && discs_shut > 10, "{shut_scenes} {discs_shut}");
}
