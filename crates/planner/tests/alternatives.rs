//! Other ways round: counted by hand, against all taut paths of small scenes, sound, the same in prepared scenes.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use std::f64::consts::TAU;
use support::oracle::Norm;
use support::taut::Taut;
use support::{answer_by, assert_close, check_by, disc, mitred, point, rectangle, scene, star};
use traverse_geometry::{HeightRule, Path, Point, Polygon, RapidRules, Scene};
use traverse_planner::{Answer, PreparedScene, RapidPlan, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

/// The seed of a scene among whose taut paths is one that comes back along an arc on which it went the other way: it
/// does not cross itself, and touches itself all the same.
const RUNS_TWICE_ALONG_AN_ARC: u64 = 646;

fn rules(count: usize) -> RapidRules {
    RapidRules { alternative_count: count, ..RapidRules::default() }
}

/// A plan with alternatives; each of them is checked, none is shorter than one before it.
fn planned(scene: &Scene, rules: &RapidRules, start: Point, target: Point) -> Option<RapidPlan> {
    let Ok(Answer::Plan(plan)) = answer_by(scene, rules, start, target) else { return None };
    let mut last = plan.cost * (1.0 - 1e-12);
    for way in &plan.alternatives {
        let check = check_by(scene, rules, start, target, way);
        assert!(check.violations.is_empty(), "{:#?}\n{way:?}\n{scene:?}", check.violations);
        assert!(way.length() >= last - 1e-9, "{} after {last}", way.length());
        last = way.length();
        assert!(!touches_itself(way), "{way:?}\n{scene:?}");
    }
    assert!(plan.alternatives.len() <= rules.alternative_count);
    Some(plan)
}

/// Whether pieces of the path meet that do not follow each other.
fn touches_itself(path: &Path) -> bool {
    let edges: Vec<_> = path.edges().collect();
    (0..edges.len()).any(|i| edges[i + 1..].iter().skip(1).any(|later| edges[i].distance(later) < 1e-9))
}

fn lengths(scene: &Scene, count: usize, start: Point, target: Point) -> Vec<f64> {
    let plan = planned(scene, &rules(count), start, target).unwrap();
    plan.alternatives.iter().map(Path::length).collect()
}

#[test]
fn a_block_has_one_other_way_and_two_have_three() {
    let (start, target) = (point(-10.0, 1.0), point(40.0, 1.0));
    for clearance in [0.0, 2.0] {
        for style in [scene, |shapes, clearance| mitred(scene(shapes, clearance))] {
            let one = style(vec![rectangle(0.0, -5.0, 10.0, 6.0)], clearance);
            assert_eq!(lengths(&one, 16, start, target).len(), 1);
            let two =
                style(vec![rectangle(0.0, -5.0, 10.0, 6.0), rectangle(18.0, -8.0, 26.0, 5.0)], clearance);
            assert_eq!(lengths(&two, 16, start, target).len(), 3);
            assert_eq!(lengths(&two, 2, start, target).len(), 2);
            assert!(lengths(&two, 0, start, target).is_empty());
        }
    }
}

#[test]
fn the_other_way_is_as_long_as_geometry_says() {
    // Round a disc of 5 by the other side.
    let around = scene([disc(0.0, 0.0, 3.0)], 2.0);
    let (start, target) = (point(-13.0, 1.0), point(13.0, 1.0));
    let distance = 13.0_f64.hypot(1.0);
    let tangent = (distance * distance - 25.0_f64).sqrt();
    let half = (5.0 / distance).acos();
    let between = std::f64::consts::PI - 2.0 * 1.0_f64.atan2(13.0);
    let expected = 2.0 * tangent + 5.0 * (TAU - between - 2.0 * half);
    let [found] = lengths(&around, 5, start, target)[..] else { panic!("one other way") };
    assert_close(found, expected, "the other side");
}

#[test]
fn what_stands_beside_a_straight_way_can_be_gone_round_as_well() {
    let beside = scene([rectangle(0.0, 3.0, 10.0, 9.0)], 1.0);
    let plan = planned(&beside, &rules(4), point(-10.0, 0.0), point(20.0, 0.0)).unwrap();
    assert_close(plan.cost, 30.0, "straight");
    assert_eq!(plan.alternatives.len(), 1);
    assert!(plan.alternatives[0].edges().any(|edge| edge.bounds().max.y > 9.0));
    // Nothing in the way, nothing else to go round.
    assert!(lengths(&scene([], 1.0), 4, point(0.0, 0.0), point(5.0, 0.0)).is_empty());
}

#[test]
fn what_touches_counts_as_one() {
    let apart = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(0.0, 11.0, 10.0, 20.0)], 0.0);
    let touching = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(0.0, 10.0, 10.0, 20.0)], 0.0);
    let (start, target) = (point(-10.0, 9.0), point(20.0, 9.0));
    // Below, between, above; and back through the gap, either way.
    assert_eq!(lengths(&apart, 9, start, target).len(), 4);
    assert_eq!(lengths(&touching, 9, start, target).len(), 1);
    // A gap that the clearance closes.
    let closed = Scene { clearance_mm: 0.6, ..apart };
    assert_eq!(lengths(&closed, 9, start, target).len(), 1);
}

#[test]
fn a_row_of_aligned_blocks_has_no_way_twice() {
    // Tangents along all corners of a row: the same way by many labels.
    let row = (0..6).map(|i| rectangle(20.0 * f64::from(i), 0.0, 20.0 * f64::from(i) + 10.0, 10.0));
    for clearance in [0.0, 1.0] {
        let row = scene(row.clone(), clearance);
        let plan =
            planned(&row, &rules(16), point(-5.0, 10.0 + clearance), point(115.0, 10.0 + clearance)).unwrap();
        let mut all: Vec<f64> = plan.alternatives.iter().map(Path::length).collect();
        all.insert(0, plan.cost);
        assert_eq!(all.len(), 17);
        for pair in plan.alternatives.windows(2) {
            assert!(pair[0] != pair[1]);
        }
    }
}

#[test]
fn heights_keep_their_level() {
    let mut walls = scene([rectangle(0.0, -50.0, 4.0, 50.0), rectangle(10.0, -10.0, 20.0, 12.0)], 1.0);
    walls.obstacles[0].top_z_mm = Some(3.0);
    let heights = HeightRule { start_z_mm: 0.0, target_z_mm: 0.0, highest_z_mm: 9.0, clearance_z_mm: 1.0 };
    let rules = RapidRules { heights: Some(heights), ..rules(5) };
    let plan = planned(&walls, &rules, point(-5.0, 0.0), point(30.0, 0.0)).unwrap();
    let level = |path: &Path| path.steps.iter().filter_map(|step| step.z_mm).fold(0.0, f64::max);
    assert_eq!((plan.alternatives.len(), level(&plan.path)), (1, 4.0));
    assert!(plan.alternatives.iter().all(|way| level(way) == 4.0));
}

#[test]
fn a_budget_that_ends_leaves_the_plan_proven() {
    let mut random = Seed(3).stream();
    let shapes: Vec<Polygon> = (0..60)
        .map(|_| {
            let center = point(random.random_range(0.0..300.0), random.random_range(0.0..300.0));
            star(&mut random, center, 9.0, 6)
        })
        .collect();
    let scene = scene(shapes, 1.0);
    let query = traverse_planner::RapidMove {
        rules: rules(16),
        ..support::query(point(-20.0, -20.0), point(320.0, 320.0))
    };
    let whole = |iterations| {
        let budget = Budget { iterations, ..Budget::unlimited() };
        plan_rapid_move(&scene, &query, &budget, &mut Silent)
    };
    let Ok((Answer::Plan(all), stats)) = whole(None) else { panic!("no plan") };
    assert_eq!(all.alternatives.len(), 16);
    let Ok((Answer::Plan(some), _)) = whole(Some(stats.expanded_nodes - 10)) else { panic!("no plan") };
    assert!(some.alternatives.len() < 16 && some.cost == all.cost && some.lower_bound == some.cost);
    assert_eq!(some.alternatives[..], all.alternatives[..some.alternatives.len()]);
}

#[test]
fn prepared_scenes_answer_the_same() {
    for seed in 0..12 {
        let mut random = Seed(500 + seed).stream();
        let shapes: Vec<Polygon> = (0..12)
            .map(|_| {
                let center = point(random.random_range(0.0..80.0), random.random_range(0.0..80.0));
                star(&mut random, center, 9.0, 5)
            })
            .collect();
        let scene = scene(shapes, [0.0, 1.0][seed as usize % 2]);
        let mut prepared = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
        for _ in 0..4 {
            let mut at = || point(random.random_range(-20.0..100.0), random.random_range(-20.0..100.0));
            let (start, target) = (at(), at());
            let Some(fresh) = planned(&scene, &rules(4), start, target) else { continue };
            let query = traverse_planner::RapidMove { rules: rules(4), ..support::query(start, target) };
            let Ok((Answer::Plan(plan), _)) = prepared.plan(&query, &Budget::unlimited(), &mut Silent) else {
                panic!("no plan")
            };
            assert_eq!(plan.alternatives.len(), fresh.alternatives.len());
            for (a, b) in plan.alternatives.iter().zip(&fresh.alternatives) {
                assert_close(a.length(), b.length(), "prepared");
            }
        }
    }
}

/// Long moves among many obstacles: the cheapest ways differ by less than a thousandth, and labels must not fill memory.
#[test]
fn ways_through_many_obstacles_are_all_told() {
    let mut random = Seed(7).stream();
    let cells = (0..1024).map(|i| point(f64::from(i % 32) * 50.0, f64::from(i / 32) * 50.0));
    let shapes: Vec<Polygon> = cells.map(|center| star(&mut random, center, 22.0, 8)).collect();
    let scene = scene(shapes, 1.5);
    for (start, target) in [((25.0, 25.0), (1525.0, 625.0)), ((75.0, 1375.0), (1475.0, 225.0))] {
        let (start, target) = (point(start.0, start.1), point(target.0, target.1));
        assert_eq!(lengths(&scene, 4, start, target).len(), 4);
    }
}

#[test]
fn all_taut_paths_among_discs_are_found_in_order() {
    let mut compared = 0;
    for seed in (0..300).chain([RUNS_TWICE_ALONG_AN_ARC]) {
        let mut random = Seed(seed).stream();
        let count = random.random_range(2..6);
        let clearance = random.random_range(0.3..2.0);
        let discs: Vec<(Point, f64)> = (0..count)
            .map(|_| {
                let center = point(random.random_range(0.0..40.0), random.random_range(0.0..40.0));
                (center, random.random_range(1.0..7.0))
            })
            .collect();
        let scene = scene(discs.iter().map(|(center, radius)| disc(center.x, center.y, *radius)), clearance);
        let mut at = || point(random.random_range(-10.0..50.0), random.random_range(-10.0..50.0));
        let (start, target) = (at(), at());
        let Some(plan) = planned(&scene, &rules(5), start, target) else { continue };
        let circles: Vec<(Point, f64)> =
            discs.iter().map(|&(center, radius)| (center, radius + clearance)).collect();
        let mut found: Vec<f64> = plan.alternatives.iter().map(Path::length).collect();
        found.insert(0, plan.cost);
        let limit = if found.len() == 6 { found[5] + 1e-6 } else { 2.0 * found[found.len() - 1] + 20.0 };
        let taut = Taut { norm: Norm::Length, circles: &circles, target, limit, found: Vec::new() };
        let mut expected = taut.all(start);
        expected.truncate(found.len().max(6));
        let is_more = expected.len() > found.len();
        assert!(!is_more, "seed {seed}: {expected:?} but {found:?}\n{scene:?} {start} {target}");
        assert_eq!(
            expected.len(),
            found.len(),
            "seed {seed}: {expected:?} {found:?}\n{scene:?} {start} {target}"
        );
        for (a, b) in expected.iter().zip(&found) {
            assert!((a - b).abs() < 1e-6, "seed {seed}: {expected:?} {found:?}");
        }
        compared += 1;
    }
    assert!(compared > 60, "{compared}");
}
