//! Tool changes in seconds: closed forms, flats, dense sampling of regions, heights, dog-legs, bounds.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::tool_change::{among_stars, any_region, change, compare, placed, placed_plan, sampled};
use support::{answer_by, assert_close, disc, plan_by, point, polygon, rectangle, scene, stars};
use traverse_geometry::{
    AxisSpeeds, CostUnit, EndRule, HeightRule, Kinematics, Point, Polygon, RapidMotion, RapidRules, Ring,
    TravelCost,
};
use traverse_planner::{Answer, Refusal, ToolChange, ToolChangeAnswer};
use traverse_solve::Seed;

fn by_axes(x: f64, y: f64) -> RapidRules {
    let cost = TravelCost::AxisSpeeds(AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 0.4 });
    RapidRules { cost, ..RapidRules::default() }
}

fn timed(junction_deviation_mm: f64) -> RapidRules {
    let limits = Kinematics {
        speed_mm_per_s: 300.0,
        z_mm_per_s: 60.0,
        acceleration_mm_per_s2: 1500.0,
        junction_deviation_mm,
        feed_mm_per_s: 90.0,
    };
    RapidRules { cost: TravelCost::Kinematics(limits), ..RapidRules::default() }
}

/// Speeds of both axes, equal ones and very different ones among them; about 1, so that seconds count as millimetres do.
fn axes(seed: u64) -> RapidRules {
    let (x, y) = [(1.0, 1.0), (2.0, 0.9), (0.3, 1.4), (1.0, 20.0)][seed as usize % 4];
    by_axes(x, y)
}

fn change_by(rules: RapidRules, start: Point, target: Point, regions: Vec<Polygon>) -> ToolChange {
    ToolChange { rules, ..change(start, target, regions) }
}

#[test]
fn the_slower_axis_decides_and_the_mirror_point_does_not() {
    let empty = scene([], 1.0);
    let below = rectangle(-50.0, -20.0, 50.0, 0.0);
    let (start, target) = (point(0.0, 3.0), point(8.0, 9.0));
    let cost = |x: f64, y: f64| {
        let question = change_by(by_axes(x, y), start, target, vec![below.clone()]);
        let plan = placed_plan(&empty, &question);
        assert_eq!(plan.lower_bound, plan.cost);
        assert_eq!(plan.approach.cost_unit, CostUnit::Seconds);
        plan.cost
    };
    // Y is slower all the way: down 3, up 9.
    assert_close(cost(1.0, 1.0), 12.0, "equal axes");
    assert_close(cost(100.0, 1.0), 12.0, "X for nothing");
    // X is slower all the way: 8.
    assert_close(cost(1.0, 100.0), 8.0, "Y for nothing");
    // Both in turn: down 3 while X runs 2 · 3 / 1.25, or up 9 while it runs the rest.
    assert_close(cost(0.5, 1.0), 16.0, "as slow as along X alone");
}

#[test]
fn of_places_that_cost_the_same_the_free_ones_count() {
    // From x = 3 to 5 every place of the border costs 0.8 s; walls leave a window at 4.4 alone.
    let (start, target) = (point(0.0, 3.0), point(8.0, 3.0));
    let region = rectangle(-20.0, -5.0, 30.0, 0.0);
    let question = change_by(by_axes(10.0, 10.0), start, target, vec![region]);
    assert_close(placed_plan(&scene([], 0.0), &question).cost, 0.8, "free");
    for (low, high) in [(4.3, 4.5), (3.0, 3.1), (4.9, 5.0), (3.9, 4.1)] {
        let window = scene([rectangle(-60.0, -0.3, low, 0.2), rectangle(high, -0.3, 60.0, 0.2)], 0.01);
        let plan = placed_plan(&window, &question);
        assert!(plan.place.x > low && plan.place.x < high, "{}", plan.place);
        let by = |from: Point, to: Point| match answer_by(&window, &question.rules, from, to) {
            Ok(Answer::Plan(plan)) => plan.cost,
            _ => f64::INFINITY,
        };
        for i in 0..=400 {
            let at = point(low + (high - low) * f64::from(i) / 400.0, 0.0);
            assert!(by(start, at) + by(at, target) >= plan.cost * (1.0 - 1e-9), "{at} {plan:?}");
        }
    }
}

#[test]
fn nothing_sampled_is_cheaper_among_stars() {
    let mut compared = 0;
    for seed in 0..100 {
        let (scene, [start, target], regions) = among_stars(seed);
        let question = change_by(axes(seed / 2), start, target, regions);
        compared += usize::from(compare(&scene, &question, 14.0, &format!("seed {seed}")));
    }
    assert!(compared > 55, "{compared}");
}

#[test]
fn nothing_sampled_is_cheaper_among_discs() {
    let mut compared = 0;
    for seed in 0..80 {
        let mut random = Seed(1000 + seed).stream();
        let shapes: Vec<Polygon> = (0..8)
            .map(|_| {
                let radius = random.random_range(1.0..8.0);
                disc(random.random_range(0.0..60.0), random.random_range(0.0..60.0), radius)
            })
            .collect();
        let scene = scene(shapes, random.random_range(0.5..3.0));
        let mut at = || point(random.random_range(-10.0..70.0), random.random_range(-10.0..70.0));
        let (start, target) = (at(), at());
        let question = change_by(axes(seed), start, target, vec![any_region(&mut random, 60.0)]);
        compared += usize::from(compare(&scene, &question, 14.0, &format!("seed {seed}")));
    }
    assert!(compared > 40, "{compared}");
}

/// Blocks on a grid, ends and regions on it, diagonals of equal speeds along their corners: everything ties.
#[test]
fn grids_of_blocks_tie_and_are_solved() {
    for seed in 0..60 {
        let mut random = Seed(2000 + seed).stream();
        let mut whole = |from: i32, to: i32| f64::from(random.random_range(from..to));
        let shapes: Vec<Polygon> = (0..7)
            .map(|_| {
                let (x, y) = (4.0 * whole(0, 10), 4.0 * whole(0, 10));
                rectangle(x, y, x + 2.0 + 2.0 * whole(0, 3), y + 2.0 + 2.0 * whole(0, 3))
            })
            .collect();
        let scene = scene(shapes, [0.0, 1.0][seed as usize % 2]);
        let (start, target) = (point(4.0 * whole(0, 12), -4.0), point(4.0 * whole(0, 12), 50.0));
        let (x, y) = (4.0 * whole(-2, 12), 4.0 * whole(-2, 12));
        let question = change_by(by_axes(1.0, 1.0), start, target, vec![rectangle(x, y, x + 6.0, y + 3.0)]);
        compare(&scene, &question, 8.0, &format!("seed {seed}"));
    }
}

/// Every place on a border, looked for very closely.
#[test]
fn no_place_on_a_border_is_cheaper_by_a_billionth() {
    let blocks = scene([disc(0.0, 0.0, 6.0), rectangle(14.0, -6.0, 20.0, 9.0)], 2.0);
    let regions = [rectangle(-4.0, 16.0, 40.0, 18.0), disc(10.0, 30.0, 9.0), disc(9.0, -19.0, 7.0)];
    for (i, region) in regions.iter().enumerate() {
        for seed in 0..3 {
            let (start, target) = (point(-12.0, -3.0 + i as f64), point(26.0, 1.0));
            let rules = axes(seed);
            let found = placed_plan(&blocks, &change_by(rules.clone(), start, target, vec![region.clone()]));
            let cost =
                |p: Point| plan_by(&blocks, &rules, start, p).cost + plan_by(&blocks, &rules, p, target).cost;
            let mut least = f64::INFINITY;
            for edge in region.rings().flat_map(Ring::edges) {
                let at = (0..=60).map(|i| f64::from(i) / 60.0);
                let of = |at: f64| cost(edge.point_at(at));
                let best = at.min_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap();
                let (mut low, mut high) = ((best - 1.0 / 60.0).max(0.0), (best + 1.0 / 60.0).min(1.0));
                for _ in 0..60 {
                    let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                    if of(a) < of(b) { high = b } else { low = a }
                }
                least = least.min(of(low));
            }
            assert_close(found.cost, least, &format!("by thirds, region {i}, speeds {seed}"));
        }
    }
}

fn heights(start: f64, target: f64, highest: f64) -> Option<HeightRule> {
    Some(HeightRule { start_z_mm: start, target_z_mm: target, highest_z_mm: highest, clearance_z_mm: 1.0 })
}

#[test]
fn heights_are_chosen_for_both_moves_in_seconds() {
    let mut compared = 0;
    for seed in 0..40 {
        let mut random = Seed(3000 + seed).stream();
        let mut scene = scene(stars(&mut random, 5, 60.0, 16.0), 1.0);
        for obstacle in &mut scene.obstacles {
            obstacle.top_z_mm = Some(random.random_range(0.0..9.0));
        }
        let mut at = || point(random.random_range(-15.0..75.0), random.random_range(-15.0..75.0));
        let (start, target) = (at(), at());
        let mut question = change_by(axes(seed), start, target, vec![any_region(&mut random, 60.0)]);
        question.rules.heights = heights(0.0, 2.0, 12.0);
        question.place_z_mm = [None, Some(1.0), Some(5.0)][seed as usize % 3];
        compared += usize::from(compare(&scene, &question, 14.0, &format!("seed {seed}")));
    }
    assert!(compared > 15, "{compared}");
}

#[test]
fn ways_out_count_in_seconds() {
    let block = scene([rectangle(-10.0, -10.0, 10.0, 10.0)], 3.0);
    let region = rectangle(-5.0, 30.0, 5.0, 35.0);
    let mut question = change_by(by_axes(2.0, 0.5), point(-1.0, 11.0), point(30.0, 30.0), vec![region]);
    question.rules.leave = EndRule::Nearest;
    // Out 2 at 0.5; up 17 at 0.5, along 34 at 2 from the corner (or less).
    let found = placed_plan(&block, &question);
    assert_eq!(found.lower_bound, found.cost);
    assert!(compare(&block, &question, 3.0, "out"));
}

#[test]
fn dog_legs_cost_nothing_where_there_is_room() {
    let (mut plans, mut proven) = (0, 0);
    for seed in 0..40 {
        let mut random = Seed(4000 + seed).stream();
        let scene = scene(stars(&mut random, 6, 60.0, 12.0), [0.0, 1.0][seed as usize % 2]);
        let mut at = || point(random.random_range(-15.0..75.0), random.random_range(-15.0..75.0));
        let (start, target) = (at(), at());
        let region = any_region(&mut random, 60.0);
        let linear = change_by(axes(seed), start, target, vec![region]);
        let mut legs = linear.clone();
        legs.rules.motion = RapidMotion::DogLeg;
        let (Ok(ToolChangeAnswer::Plan(straight)), Ok(ToolChangeAnswer::Plan(run))) =
            (placed(&scene, &linear), placed(&scene, &legs))
        else {
            continue;
        };
        assert_close(run.lower_bound, straight.cost, &format!("seed {seed}"));
        plans += 1;
        proven += usize::from(run.cost <= run.lower_bound * (1.0 + 1e-9));
    }
    assert!(plans > 20 && proven + 2 >= plans, "{plans} {proven}");
}

#[test]
fn a_region_behind_a_slanted_channel_is_refused_to_dog_legs() {
    // Between two bands a channel no wider than the path; the region lies at its end.
    let along = traverse_geometry::unit(20.0_f64.to_radians());
    let at = |a: f64, u: f64| {
        let p = point(0.0, 0.0) + along * a + traverse_geometry::left_of(along) * u;
        (p.x, p.y)
    };
    let band =
        |low: f64, high: f64| polygon(&[at(-20.0, low), at(20.0, low), at(20.0, high), at(-20.0, high)]);
    let mut channel = scene([band(-150.0, -2.0), band(2.0, 150.0)], 2.0);
    channel.work_area = Some(band(-140.0, 140.0));
    channel.work_area_clearance_mm = Some(0.0);
    let start = point(0.0, 0.0) - along * 19.0;
    let (x, y) = at(18.0, 0.0);
    let region = rectangle(x - 1.0, y - 1.0, x + 1.0, y + 1.0);
    let mut question = change_by(by_axes(100.0, 100.0), start, start, vec![region]);
    assert!(matches!(placed(&channel, &question), Ok(ToolChangeAnswer::Plan(_))));
    question.rules.motion = RapidMotion::DogLeg;
    assert_eq!(placed(&channel, &question), Err(vec![Refusal::NoRoomForDogLegs]));
    channel.clearance_mm = 1.7;
    let roomy = placed_plan(&channel, &question);
    assert_eq!(roomy.lower_bound, roomy.cost);
}

#[test]
fn limits_of_acceleration_are_bounded_and_nearly_the_best_of_what_is_sampled() {
    let (mut compared, mut near) = (0, 0);
    for seed in 0..60 {
        let mut random = Seed(5000 + seed).stream();
        let count = random.random_range(1..6);
        let scene = scene(stars(&mut random, count, 60.0, 14.0), [0.0, 1.5][seed as usize % 2]);
        let mut at = || point(random.random_range(-15.0..75.0), random.random_range(-15.0..75.0));
        let (start, target) = (at(), at());
        let mut question = change_by(
            timed([0.0, 0.05][seed as usize % 2]),
            start,
            target,
            vec![any_region(&mut random, 60.0)],
        );
        if seed % 3 == 0 {
            question.rules.heights = heights(0.0, 1.0, 5.0);
        }
        let Ok(ToolChangeAnswer::Plan(found)) = placed(&scene, &question) else { continue };
        let Some(best) = sampled(&scene, &question, 8) else { continue };
        assert!(best >= found.lower_bound * (1.0 - 1e-9), "seed {seed}: {best} {}", found.lower_bound);
        // No worse than where the way is shortest.
        let by_length = ToolChange {
            rules: RapidRules { cost: TravelCost::Length, ..question.rules.clone() },
            ..question
        };
        let shortest = placed_plan(&scene, &by_length).place;
        let moves = [
            (question_rules(&by_length, 0), start, shortest),
            (question_rules(&by_length, 1), shortest, target),
        ];
        let seconds: f64 = moves
            .iter()
            .map(|(rules, from, to)| {
                let rules = RapidRules { cost: timed([0.0, 0.05][seed as usize % 2]).cost, ..rules.clone() };
                plan_by(&scene, &rules, *from, *to).cost
            })
            .sum();
        assert!(found.cost <= seconds * (1.0 + 1e-9), "seed {seed}: {} {seconds}", found.cost);
        compared += 1;
        near += usize::from(found.cost <= best * 1.02);
    }
    assert!(compared > 30 && near * 10 >= compared * 8, "{compared} {near}");
}

fn question_rules(question: &ToolChange, side: usize) -> RapidRules {
    if side == 0 { question.approach_rules() } else { question.departure_rules() }
}

#[test]
fn straight_moves_with_limits_of_acceleration_meet_their_bound() {
    let empty = scene([], 1.0);
    let (start, target) = (point(0.0, 0.0), point(300.0, 0.0));
    let across = change_by(timed(0.02), start, target, vec![rectangle(100.0, -5.0, 120.0, 5.0)]);
    let found = placed_plan(&empty, &across);
    // Two moves from rest to rest: a fifth of a second more for each.
    assert_close(found.cost, 1.0 + 0.4, "there and on");
    assert_eq!(found.lower_bound, found.cost);
    // The start itself is permitted: one move.
    let here = change_by(timed(0.02), start, target, vec![rectangle(-5.0, -5.0, 5.0, 5.0)]);
    let found = placed_plan(&empty, &here);
    assert_close(found.cost, 1.0 + 0.2, "on at once");
    assert_eq!((found.place, found.lower_bound), (start, found.cost));
}
