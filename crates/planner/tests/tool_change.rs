//! Tool changes: closed forms, dense sampling of regions, heights, ways out, what can't be reached.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::tool_change::{among_stars, any_region, change, compare, no_place, placed, placed_plan};
use support::{assert_close, disc, plan, point, polygon, rectangle, scene, stars};
use traverse_geometry::{EndRule, HeightRule, Point, Polygon, RapidRules, Ring};
use traverse_planner::{FeasibleClearance, Refusal, ToolChange, ToolChangeAnswer, plan_tool_change};
use traverse_solve::{Budget, Interrupt, Seed, Silent};

#[test]
fn points_meet_in_the_mirror_point() {
    let empty = scene([], 2.0);
    // Same side: mirror. Opposite sides: straight through. Beyond an end: the corner.
    let region = rectangle(0.0, -10.0, 100.0, -3.0);
    let plan = placed_plan(&empty, &change(point(10.0, 1.0), point(18.0, -1.0), vec![region.clone()]));
    assert_close(plan.cost, 8.0_f64.hypot(6.0), "mirrored");
    assert!((plan.place - point(15.333_333_333, -3.0)).norm() < 1e-6, "{}", plan.place);
    assert_eq!(plan.cost, plan.lower_bound);
    let through = placed_plan(&empty, &change(point(10.0, 1.0), point(18.0, -14.0), vec![region.clone()]));
    assert_close(through.cost, 8.0_f64.hypot(15.0), "no detour");
    let corner = placed_plan(&empty, &change(point(-10.0, 1.0), point(-4.0, 5.0), vec![region]));
    assert_close(corner.cost, 10.0_f64.hypot(4.0) + 4.0_f64.hypot(8.0), "corner");
    assert_eq!(corner.place, point(0.0, -3.0));
}

#[test]
fn ends_in_a_region_are_no_detour() {
    let empty = scene([], 1.0);
    let region = disc(0.0, 0.0, 5.0);
    for (start, target) in [
        (point(1.0, 1.0), point(20.0, 3.0)),
        (point(20.0, 3.0), point(1.0, 1.0)),
        (point(1.0, 0.0), point(2.0, 0.0)),
    ] {
        let plan = placed_plan(&empty, &change(start, target, vec![region.clone()]));
        assert_close(plan.cost, (target - start).norm(), "no detour");
    }
    let stays = placed_plan(&empty, &change(point(1.0, 1.0), point(1.0, 1.0), vec![region]));
    assert_eq!((stays.cost, stays.approach.path.steps.len()), (0.0, 0));
}

#[test]
fn discs_are_met_where_the_angles_are_equal() {
    // Both ends at the same distance from a disc: its nearest point on the axis of symmetry.
    let empty = scene([], 1.0);
    let question = change(point(-3.0, 20.0), point(3.0, 20.0), vec![disc(0.0, 0.0, 5.0)]);
    let plan = placed_plan(&empty, &question);
    assert_close(plan.cost, 2.0 * 3.0_f64.hypot(15.0), "top of the disc");
    // From the centre of a ring every place of the inner border costs the same.
    let ring =
        Polygon::new(disc(0.0, 0.0, 9.0).outer().clone(), vec![disc(0.0, 0.0, 7.0).outer().clone()]).unwrap();
    let plan = placed_plan(&empty, &change(point(0.0, 0.0), point(0.0, 0.0), vec![ring]));
    assert_close(plan.cost, 14.0, "ring");
}

#[test]
fn points_alone_are_the_cheapest_of_all() {
    let walls = scene([rectangle(0.0, -20.0, 2.0, 20.0)], 1.0);
    let (start, target) = (point(-10.0, 0.0), point(10.0, 0.0));
    let points = vec![point(-40.0, 3.0), point(1.0, 24.0), point(1.0, -22.0), point(1.0, 0.0)];
    let question = ToolChange { points: points.clone(), ..change(start, target, Vec::new()) };
    let found = placed_plan(&walls, &question);
    assert_eq!(found.place, points[2]);
    let expected = plan(&walls, start, points[2]).cost + plan(&walls, points[2], target).cost;
    assert_close(found.cost, expected, "both moves");
}

#[test]
fn nothing_sampled_is_cheaper_among_stars() {
    let mut compared = 0;
    for seed in 0..90 {
        let (scene, [start, target], regions) = among_stars(seed);
        let question = change(start, target, regions);
        compared += usize::from(compare(&scene, &question, 4.0, &format!("seed {seed}")));
    }
    assert!(compared > 50, "{compared}");
}

#[test]
fn nothing_sampled_is_cheaper_among_discs() {
    let mut compared = 0;
    for seed in 0..60 {
        let mut random = Seed(1000 + seed).stream();
        let shapes: Vec<Polygon> = (0..8)
            .map(|_| {
                disc(
                    random.random_range(0.0..60.0),
                    random.random_range(0.0..60.0),
                    random.random_range(1.0..8.0),
                )
            })
            .collect();
        let scene = scene(shapes, random.random_range(0.5..3.0));
        let mut at = || point(random.random_range(-10.0..70.0), random.random_range(-10.0..70.0));
        let (start, target) = (at(), at());
        let question = change(start, target, vec![any_region(&mut random, 60.0)]);
        compared += usize::from(compare(&scene, &question, 4.0, &format!("seed {seed}")));
    }
    assert!(compared > 30, "{compared}");
}

/// Every place on a border, looked for very closely: the plan's cost is the least to 1e-9.
#[test]
fn the_best_place_is_known_to_a_billionth() {
    let blocks = scene([disc(0.0, 0.0, 6.0), rectangle(14.0, -6.0, 20.0, 9.0)], 2.0);
    for (i, region) in
        [rectangle(-4.0, 16.0, 40.0, 18.0), disc(10.0, 30.0, 9.0), disc(9.0, -19.0, 7.0)].iter().enumerate()
    {
        let (start, target) = (point(-12.0, -3.0 + i as f64), point(26.0, 1.0));
        let found = placed_plan(&blocks, &change(start, target, vec![region.clone()]));
        let cost = |p: Point| plan(&blocks, start, p).cost + plan(&blocks, p, target).cost;
        let mut least = f64::INFINITY;
        for edge in region.rings().flat_map(Ring::edges) {
            // The best of some places, then a search by thirds about it.
            let at = (0..=60).map(|i| f64::from(i) / 60.0);
            let best = at.min_by(|a, b| cost(edge.point_at(*a)).total_cmp(&cost(edge.point_at(*b)))).unwrap();
            let (mut low, mut high) = ((best - 1.0 / 60.0).max(0.0), (best + 1.0 / 60.0).min(1.0));
            for _ in 0..60 {
                let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                if cost(edge.point_at(a)) < cost(edge.point_at(b)) { high = b } else { low = a }
            }
            least = least.min(cost(edge.point_at(low)));
        }
        assert_close(found.cost, least, "by thirds");
    }
}

#[test]
fn a_region_partly_in_a_barrier_is_used_where_it_is_free() {
    // The region's near side lies in the barrier of a block; what is left begins at the barrier's border.
    let block = scene([rectangle(-10.0, 0.0, 10.0, 10.0)], 3.0);
    let region = rectangle(-8.0, -2.0, 8.0, 30.0);
    let (start, target) = (point(-30.0, -20.0), point(30.0, -20.0));
    let found = placed_plan(&block, &change(start, target, vec![region]));
    // All of it below y = −3 is free of the barrier, but the region ends at −2: the way leads round and above.
    assert!(found.place.y > 10.0, "{}", found.place);
    // A region that a barrier cuts through: the best place is where its border meets the barrier's.
    let cut = rectangle(-8.0, -30.0, 8.0, 5.0);
    let through = placed_plan(&block, &change(point(-30.0, -1.0), point(30.0, -1.0), vec![cut]));
    let expected = plan(&block, point(-30.0, -1.0), point(30.0, -1.0)).cost;
    assert_close(through.cost, expected, "the shortest way runs along the barrier through the region");
}

#[test]
fn no_place_is_said_with_what_is_in_the_way() {
    let (start, target) = (point(-30.0, 0.0), point(30.0, 0.0));
    // The whole region lies in a barrier.
    let block = scene([rectangle(-10.0, -10.0, 10.0, 10.0)], 3.0);
    let question = change(start, target, vec![rectangle(-2.0, 10.5, 2.0, 12.0)]);
    let covered = no_place(&block, &question);
    assert_eq!(covered.separating_obstacles, ["o0"]);
    let FeasibleClearance::Millimetres(most) = covered.feasible_clearance else { panic!("{covered:?}") };
    assert!((most - 2.0).abs() < 3e-6, "{most}");
    // The region is walled in.
    let wall = Polygon::new(
        rectangle(0.0, 50.0, 40.0, 90.0).outer().clone(),
        vec![rectangle(5.0, 55.0, 35.0, 85.0).outer().clone()],
    );
    let walled = scene([wall.unwrap(), rectangle(-10.0, -10.0, 10.0, 10.0)], 1.0);
    let parted = no_place(&walled, &change(start, target, vec![rectangle(15.0, 65.0, 25.0, 75.0)]));
    assert_eq!(
        (parted.separating_obstacles, parted.feasible_clearance),
        (vec!["o0".to_owned()], FeasibleClearance::None)
    );
    // Outside of the work area.
    let mut bounded = scene([], 1.0);
    bounded.work_area = Some(rectangle(-50.0, -50.0, 50.0, 50.0));
    let outside = no_place(&bounded, &change(start, target, vec![rectangle(60.0, 0.0, 70.0, 10.0)]));
    assert!(outside.separating_obstacles.is_empty() && outside.feasible_clearance == FeasibleClearance::None);
    // Partly outside: what is inside counts.
    let partly = placed_plan(&bounded, &change(start, target, vec![rectangle(-5.0, 40.0, 5.0, 80.0)]));
    assert_close(partly.cost, 2.0 * 30.0_f64.hypot(40.0), "at the lower border");
}

#[test]
fn ends_inside_barriers_follow_their_rules() {
    let block = scene([rectangle(-10.0, -10.0, 10.0, 10.0)], 3.0);
    let region = rectangle(-5.0, 30.0, 5.0, 35.0);
    let mut question = change(point(-1.0, 11.0), point(30.0, 30.0), vec![region]);
    let refused = placed(&block, &question).unwrap_err();
    assert!(matches!(&refused[..], [Refusal::EndInsideBarrier { field: "start", .. }]), "{refused:?}");
    question.rules.leave = EndRule::Nearest;
    let found = placed_plan(&block, &question);
    let out = point(-1.0, 13.0);
    let along = plan(&block, out, found.place).cost + plan(&block, found.place, point(30.0, 30.0)).cost;
    assert_close(found.cost, 2.0 + along, "out, then the place");
    let mut both = question.clone();
    (both.start, both.target) = (question.target, question.start);
    (both.rules.leave, both.rules.enter) = (EndRule::Refuse, EndRule::Nearest);
    assert_close(placed_plan(&block, &both).cost, found.cost, "the other way round");
}

#[test]
fn the_largest_clearance_with_a_place_counts() {
    let gap = scene([rectangle(-20.0, -40.0, -4.0, 40.0), rectangle(4.0, -40.0, 20.0, 40.0)], 9.0);
    let mut question = change(point(-40.0, 0.0), point(40.0, 0.0), vec![rectangle(-1.0, -5.0, 1.0, 5.0)]);
    question.rules.clearances_mm = vec![6.0, 4.5, 3.5, 1.0];
    let found = placed_plan(&gap, &question);
    assert_eq!(found.approach.clearance_mm, 3.5);
}

fn with_heights(start: f64, target: f64, highest: f64) -> RapidRules {
    let rule =
        HeightRule { start_z_mm: start, target_z_mm: target, highest_z_mm: highest, clearance_z_mm: 1.0 };
    RapidRules { heights: Some(rule), ..RapidRules::default() }
}

#[test]
fn heights_are_chosen_for_both_moves() {
    let mut walls = scene([rectangle(0.0, -100.0, 4.0, 100.0), rectangle(30.0, -100.0, 34.0, 100.0)], 2.0);
    walls.obstacles[0].top_z_mm = Some(3.0);
    walls.obstacles[1].top_z_mm = Some(8.0);
    let mut question = change(point(-10.0, 0.0), point(50.0, 0.0), vec![rectangle(10.0, 3.0, 20.0, 6.0)]);
    question.rules = with_heights(0.0, 0.0, 20.0);
    // At the highest height by default.
    let high = placed_plan(&walls, &question);
    assert_close(high.cost, 40.0 + flat(&question), "up to 20 and down again");
    // At z = 1: over the first wall at 4, over the second at 9.
    question.place_z_mm = Some(1.0);
    let low = placed_plan(&walls, &question);
    assert_close(low.cost, 4.0 + 3.0 + 8.0 + 9.0 + flat(&question), "each move at its own level");
    let level = |path: &traverse_geometry::Path| {
        path.steps.iter().filter_map(|step| step.z_mm).max_by(f64::total_cmp)
    };
    assert_eq!((level(&low.approach.path), level(&low.departure.path)), (Some(4.0), Some(9.0)));
    assert_eq!((low.approach.path.end_z_mm(), low.departure.path.end_z_mm()), (Some(1.0), Some(0.0)));
}

/// What start → region → target costs in the plane with nothing in the way.
fn flat(question: &ToolChange) -> f64 {
    placed_plan(&scene([], 1.0), &change(question.start, question.target, question.regions.clone())).cost
}

#[test]
fn the_place_keeps_away_from_what_moves_pass_over() {
    // Moves pass over the plate, but the tool is changed below its top: off its barrier.
    let mut plate = scene([disc(0.0, 0.0, 6.0)], 2.0);
    plate.obstacles[0].top_z_mm = Some(5.0);
    let mut question = change(point(-20.0, 1.0), point(20.0, 1.0), vec![rectangle(-4.0, -30.0, 12.0, 30.0)]);
    question.rules = with_heights(10.0, 10.0, 10.0);
    question.place_z_mm = Some(0.0);
    let found = placed_plan(&plate, &question);
    // The straight way leaves the barrier inside the region.
    assert_close(found.cost, 60.0, "straight over the plate, down and up beside it");
    let beside = found.place - point(0.0, 0.0);
    assert!(beside.norm() >= 8.0 - 1e-6, "{}", found.place);
    // A region that the barrier all but covers: what sticks out is found on the barrier's border.
    question.regions = vec![rectangle(-7.0, 0.0, 7.0, 7.5)];
    let corner = placed_plan(&plate, &question);
    assert!((corner.place - point(0.0, 0.0)).norm() >= 8.0 - 1e-6 && corner.cost > 60.0, "{corner:?}");
    assert!(compare(&plate, &question, 1.0, "sampled"));
    question.regions = vec![polygon(&[(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)])];
    question.start = point(-20.0, 20.0);
    question.target = point(0.0, 0.5);
    let near = placed_plan(&plate, &question);
    assert_close(near.cost, 20.0 + (question.target - question.start).norm(), "on the way");
}

#[test]
fn symmetric_questions_cost_the_same() {
    for seed in 0..25 {
        let mut random = Seed(77 + seed).stream();
        let shapes = stars(&mut random, 5, 60.0, 12.0);
        let base = scene(shapes, 1.0);
        let mut at = || point(random.random_range(-15.0..75.0), random.random_range(-15.0..75.0));
        let (start, target) = (at(), at());
        let regions = vec![any_region(&mut random, 60.0)];
        let question = change(start, target, regions);
        let Ok(ToolChangeAnswer::Plan(found)) = placed(&base, &question) else { continue };
        let reversed = ToolChange { start: target, target: start, ..question.clone() };
        assert_close(placed_plan(&base, &reversed).cost, found.cost, "the other way round");
        // A point more changes nothing unless it is better.
        let more = ToolChange { points: vec![found.place], ..question.clone() };
        assert_close(placed_plan(&base, &more).cost, found.cost, "the place itself");
    }
}

#[test]
fn a_budget_that_ends_says_what_is_known() {
    let mut random = Seed(5).stream();
    let scene = scene(stars(&mut random, 40, 200.0, 14.0), 1.0);
    let question = change(point(-10.0, -10.0), point(210.0, 200.0), vec![disc(100.0, 230.0, 20.0)]);
    let best = placed_plan(&scene, &question);
    let budget = Budget { iterations: Some(20), ..Budget::unlimited() };
    let stopped = plan_tool_change(&scene, &question, &budget, &mut Silent).unwrap_err();
    let [Refusal::Interrupted { interrupt: Interrupt::Iterations, lower_bound }] = &stopped[..] else {
        panic!("{stopped:?}")
    };
    assert!(*lower_bound > 0.0 && *lower_bound <= best.cost, "{lower_bound}");
}

#[test]
fn findings_name_what_is_missing() {
    let fields = |question: &ToolChange| {
        question.findings().into_iter().map(|finding| finding.field).collect::<Vec<_>>()
    };
    let mut question = change(point(0.0, 0.0), point(1.0, 0.0), Vec::new());
    assert_eq!(fields(&question), ["regions"]);
    question.points = vec![point(0.0, 0.0)];
    assert!(fields(&question).is_empty());
    question.place_z_mm = Some(3.0);
    assert_eq!(fields(&question), ["place_z_mm"]);
    question.rules = with_heights(0.0, 0.0, 2.0);
    assert_eq!(fields(&question), ["place_z_mm"]);
    question.place_z_mm = Some(-5.0);
    assert!(fields(&question).is_empty());
}
