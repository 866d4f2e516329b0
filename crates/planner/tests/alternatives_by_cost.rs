//! Other ways round in seconds: against all taut paths of small scenes, in order, as the machine runs them.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::oracle::Norm;
use support::taut::Taut;
use support::{answer_by, assert_close, check_by, disc, point, rectangle, scene, star};
use traverse_geometry::{
    AxisSpeeds, HeightRule, Kinematics, Path, Point, Polygon, RapidMotion, RapidRules, Scene, TravelCost,
};
use traverse_planner::{Answer, RapidPlan};
use traverse_solve::Seed;

fn by_axes(x: f64, y: f64, count: usize) -> RapidRules {
    let cost = TravelCost::AxisSpeeds(AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 0.5 });
    RapidRules { cost, alternative_count: count, ..RapidRules::default() }
}

fn timed(junction_deviation_mm: f64, count: usize) -> RapidRules {
    let limits = Kinematics {
        speed_mm_per_s: 300.0,
        z_mm_per_s: 60.0,
        acceleration_mm_per_s2: 1500.0,
        junction_deviation_mm,
        feed_mm_per_s: 90.0,
    };
    RapidRules { cost: TravelCost::Kinematics(limits), alternative_count: count, ..RapidRules::default() }
}

/// A plan with alternatives; each of them is checked and costs what the plan says, none less than one before it.
fn planned(scene: &Scene, rules: &RapidRules, start: Point, target: Point) -> Option<RapidPlan> {
    let Ok(Answer::Plan(plan)) = answer_by(scene, rules, start, target) else { return None };
    assert_eq!(plan.alternatives.len(), plan.alternative_costs.len());
    assert!(plan.alternatives.len() <= rules.alternative_count);
    let mut last = plan.cost;
    for (way, &cost) in plan.alternatives.iter().zip(&plan.alternative_costs) {
        let check = check_by(scene, rules, start, target, way);
        assert!(check.violations.is_empty(), "{:#?}\n{way:?}\n{scene:?}", check.violations);
        assert_close(check.cost, cost, "recomputed");
        assert!(cost >= last * (1.0 - 1e-9), "{cost} after {last}");
        last = cost;
    }
    Some(plan)
}

fn all_costs(plan: &RapidPlan) -> Vec<f64> {
    std::iter::once(plan.cost).chain(plan.alternative_costs.iter().copied()).collect()
}

/// Discs that may overlap, their clearance, and ends.
fn discs(seed: u64) -> (Vec<(Point, f64)>, f64, [Point; 2]) {
    let mut random = Seed(seed).stream();
    let count = random.random_range(2..6);
    let clearance = random.random_range(0.3..2.0);
    let discs = (0..count)
        .map(|_| {
            let center = point(random.random_range(0.0..40.0), random.random_range(0.0..40.0));
            (center, random.random_range(1.0..7.0))
        })
        .collect();
    let mut at = || point(random.random_range(-10.0..50.0), random.random_range(-10.0..50.0));
    (discs, clearance, [at(), at()])
}

fn scene_of(discs: &[(Point, f64)], clearance: f64) -> Scene {
    scene(discs.iter().map(|(center, radius)| disc(center.x, center.y, *radius)), clearance)
}

#[test]
fn all_taut_paths_among_discs_are_found_in_the_order_of_seconds() {
    let mut compared = 0;
    for seed in 0..120 {
        let (discs, clearance, [start, target]) = discs(seed);
        let (x, y) = [(1.0, 1.0), (2.0, 1.0), (0.6, 1.7)][seed as usize % 3];
        let scene = scene_of(&discs, clearance);
        let Some(plan) = planned(&scene, &by_axes(x, y, 5), start, target) else { continue };
        let found = all_costs(&plan);
        let circles: Vec<(Point, f64)> =
            discs.iter().map(|&(center, radius)| (center, radius + clearance)).collect();
        let limit = if found.len() == 6 { found[5] + 1e-6 } else { 2.0 * found[found.len() - 1] + 20.0 };
        let taut = Taut { norm: Norm::Axes(x, y), circles: &circles, target, limit, found: Vec::new() };
        let mut expected = taut.all(start);
        expected.truncate(6);
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
    assert!(compared > 50, "{compared}");
}

#[test]
fn the_ways_are_those_of_length_and_the_fast_axis_is_told_first() {
    let block = scene([rectangle(0.0, -5.0, 10.0, 6.0)], 2.0);
    let (start, target) = (point(-10.0, 0.0), point(20.0, 0.0));
    for rules in [by_axes(1.0, 1.0, 16), by_axes(50.0, 0.1, 16), timed(0.02, 16)] {
        let plan = planned(&block, &rules, start, target).unwrap();
        assert_eq!(plan.alternatives.len(), 1, "{plan:?}");
    }
    // Lengths along X and Y alone: down 7 and up 7, or up 8 and down 8.
    let slow = planned(&block, &by_axes(1e6, 1.0, 4), start, target).unwrap();
    assert!((slow.cost - 14.0).abs() < 1e-3 && (slow.alternative_costs[0] - 16.0).abs() < 1e-3, "{slow:?}");
}

/// Lengths of all ways of a plan, ascending.
fn lengths(plan: &RapidPlan) -> Vec<f64> {
    let mut lengths: Vec<f64> =
        std::iter::once(&plan.path).chain(&plan.alternatives).map(Path::length).collect();
    lengths.sort_by(f64::total_cmp);
    lengths
}

#[test]
fn with_limits_of_acceleration_the_ways_of_length_are_told_quickest_first() {
    let (mut compared, mut reordered) = (0, 0);
    for seed in 200..260 {
        // Arcs are slow, corners slower.
        let (discs, clearance, [start, target]) = discs(seed);
        let scene = if seed % 2 == 0 {
            let mut random = Seed(seed).stream();
            let star = |&(center, radius): &(Point, f64)| star(&mut random, center, 1.5 * radius, 5);
            scene(discs.iter().map(star).collect::<Vec<_>>(), 0.0)
        } else {
            scene_of(&discs, clearance)
        };
        let by_length = RapidRules { alternative_count: 15, ..RapidRules::default() };
        let Ok(Answer::Plan(shortest)) = answer_by(&scene, &by_length, start, target) else { continue };
        if shortest.alternatives.len() == 15 {
            continue;
        }
        let quick = planned(&scene, &timed([0.0, 0.05][seed as usize % 2], 15), start, target).unwrap();
        let (expected, found) = (lengths(&shortest), lengths(&quick));
        assert_eq!(expected.len(), found.len(), "seed {seed}: {expected:?} {found:?}");
        for (a, b) in expected.iter().zip(&found) {
            assert_close(*a, *b, &format!("seed {seed}"));
        }
        assert!(quick.lower_bound > 0.0 && quick.lower_bound <= quick.cost);
        let in_order: Vec<f64> =
            std::iter::once(&quick.path).chain(&quick.alternatives).map(Path::length).collect();
        reordered += usize::from(!in_order.is_sorted());
        compared += 1;
    }
    assert!(compared > 30 && reordered > 0, "{compared} {reordered}");
}

fn stars(seed: u64) -> (Scene, [Point; 2]) {
    let mut random = Seed(seed).stream();
    let shapes: Vec<Polygon> = (0..9)
        .map(|_| {
            let center = point(random.random_range(0.0..80.0), random.random_range(0.0..80.0));
            star(&mut random, center, 9.0, 5)
        })
        .collect();
    let mut end = |x: f64| point(x, random.random_range(0.0..80.0));
    (scene(shapes, [0.0, 1.0][seed as usize % 2]), [end(-12.0), end(92.0)])
}

#[test]
fn dog_legs_run_the_ways_that_have_room() {
    let mut ways = 0;
    for seed in 300..330 {
        let (scene, [start, target]) = stars(seed);
        let linear = by_axes(120.0, 70.0, 6);
        let rules = RapidRules { motion: RapidMotion::DogLeg, ..linear.clone() };
        let Some(run) = planned(&scene, &rules, start, target) else { continue };
        let straight = planned(&scene, &linear, start, target).unwrap();
        // Dog-legs cost nothing; what has no room is left out.
        let mut all = all_costs(&straight).into_iter();
        let last = *straight.alternative_costs.last().unwrap_or(&straight.cost);
        for cost in all_costs(&run).into_iter().filter(|&cost| cost < last * (1.0 - 1e-9)) {
            assert!(all.any(|other| (other - cost).abs() < 1e-9), "seed {seed}: {cost}");
        }
        ways += run.alternatives.len();
    }
    assert!(ways > 90, "{ways}");
    // A slanted gap as wide as the path: no way for dog-legs, and the ways beside it stay.
    let along = traverse_geometry::unit(20.0_f64.to_radians());
    let band = |low: f64, high: f64| {
        let at = |a: f64, u: f64| {
            let p = point(0.0, 0.0) + along * a + traverse_geometry::left_of(along) * u;
            (p.x, p.y)
        };
        support::polygon(&[at(-20.0, low), at(20.0, low), at(20.0, high), at(-20.0, high)])
    };
    let gap = scene([band(-30.0, -2.0), band(2.0, 25.0)], 2.0);
    let (start, target) = (point(0.0, 0.0) - along * 24.0, point(0.0, 0.0) + along * 24.0);
    let straight = planned(&gap, &by_axes(100.0, 100.0, 6), start, target).unwrap();
    let legs = RapidRules { motion: RapidMotion::DogLeg, ..by_axes(100.0, 100.0, 6) };
    let run = planned(&gap, &legs, start, target).unwrap();
    // Back through the gap, either way, are the other two.
    assert_eq!((straight.alternatives.len(), run.alternatives.len()), (4, 1), "{run:?}\n{straight:?}");
    assert_close(run.cost, straight.alternative_costs[0], "the first way beside");
    assert_close(run.alternative_costs[0], straight.alternative_costs[1], "the second one");
}

#[test]
fn heights_keep_their_level_in_seconds() {
    let mut walls = scene([rectangle(0.0, -50.0, 4.0, 50.0), rectangle(10.0, -10.0, 20.0, 12.0)], 1.0);
    walls.obstacles[0].top_z_mm = Some(3.0);
    let heights = HeightRule { start_z_mm: 0.0, target_z_mm: 0.0, highest_z_mm: 9.0, clearance_z_mm: 1.0 };
    for rules in [by_axes(1.0, 1.0, 5), timed(0.02, 5)] {
        let rules = RapidRules { heights: Some(heights), ..rules };
        let plan = planned(&walls, &rules, point(-5.0, 0.0), point(30.0, 0.0)).unwrap();
        let level = |path: &Path| path.steps.iter().filter_map(|step| step.z_mm).fold(0.0, f64::max);
        assert_eq!(plan.alternatives.len(), 1);
        assert!(plan.alternatives.iter().all(|way| level(way) == level(&plan.path)), "{plan:?}");
    }
}
