//! Costs in seconds: of axes that run at their own speeds, exactly; under limits of speed and acceleration, with a bound.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::oracle::{Circle, Norm, Wall, least};
use support::{
    answer_by, assert_close, check_by, disc, mitred, plan, plan_by, point, query, rectangle, scene, stars,
};
use traverse_geometry::{
    AxisSpeeds, CostUnit, EndRule, HeightRule, Kinematics, Motion, Point, RapidRules, Scene, TravelCost,
};
use traverse_planner::{Algorithm, Answer, PreparedScene, RapidMove, Refusal, plan_rapid_move, travel_cost};
use traverse_solve::{Budget, Interrupt, Seed, Silent};

fn speeds(x: f64, y: f64) -> RapidRules {
    let cost = TravelCost::AxisSpeeds(AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 25.0 });
    RapidRules { cost, ..RapidRules::default() }
}

fn limits() -> Kinematics {
    Kinematics {
        speed_mm_per_s: 300.0,
        z_mm_per_s: 60.0,
        acceleration_mm_per_s2: 1500.0,
        junction_deviation_mm: 0.02,
        feed_mm_per_s: 90.0,
    }
}

fn timed(limits: Kinematics) -> RapidRules {
    RapidRules { cost: TravelCost::Kinematics(limits), ..RapidRules::default() }
}

fn pair(p: Point) -> (f64, f64) {
    (p.x, p.y)
}

/// Speeds of both axes, equal ones and very different ones among them.
fn axes(random: &mut impl RngExt) -> (f64, f64) {
    match random.random_range(0..4) {
        0 => (100.0, 100.0),
        1 => (random.random_range(1.0..10.0), random.random_range(100.0..900.0)),
        _ => (random.random_range(50.0..300.0), random.random_range(50.0..300.0)),
    }
}

/// Compares with the brute force; whether there was anything to compare.
fn agrees(
    scene: &Scene,
    axes: (f64, f64),
    ends: [Point; 2],
    circles: &[Circle],
    walls: &[Wall],
    what: &str,
) -> bool {
    let [start, target] = ends;
    let expected = || least(Norm::Axes(axes.0, axes.1), pair(start), pair(target), circles, walls);
    match answer_by(scene, &speeds(axes.0, axes.1), start, target) {
        Err(refusals) => {
            assert!(refusals.iter().all(|r| matches!(r, Refusal::EndInsideBarrier { .. })), "{refusals:?}");
            return false;
        }
        Ok(Answer::Plan(plan)) => {
            assert_eq!(plan.lower_bound, plan.cost, "{what}");
            assert_eq!(plan.cost_unit, CostUnit::Seconds);
            assert_close(plan.cost * 100.0, expected() * 100.0, what);
        }
        Ok(Answer::NoPath(_)) => assert!(expected().is_infinite(), "{what}"),
    }
    true
}

#[test]
fn axis_speeds_agree_with_brute_force_on_discs() {
    let mut compared = 0;
    for case in 0..500 {
        let mut random = Seed(71).part(case).stream();
        let clearance = if case % 3 == 0 { 0.0 } else { random.random_range(0.1..3.0) };
        let discs: Vec<(f64, f64, f64)> = (0..10)
            .map(|_| {
                (
                    random.random_range(0.0..100.0),
                    random.random_range(0.0..100.0),
                    random.random_range(2.0..15.0),
                )
            })
            .collect();
        let scene = scene(discs.iter().map(|&(x, y, r)| disc(x, y, r)), clearance);
        let circles: Vec<Circle> =
            discs.iter().map(|&(x, y, r)| Circle { center: (x, y), radius: r + clearance }).collect();
        let walls: Vec<Wall> =
            circles.iter().map(|c| Wall { a: c.center, b: c.center, distance: c.radius }).collect();
        let mut end = || point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        let ends = [end(), end()];
        let axes = axes(&mut random);
        compared += usize::from(agrees(&scene, axes, ends, &circles, &walls, &format!("case {case}")));
    }
    assert!(compared > 150, "{compared}");
}

#[test]
fn axis_speeds_agree_with_brute_force_on_polygons() {
    let mut compared = 0;
    for case in 0..200 {
        let mut random = Seed(72).part(case).stream();
        let clearance = random.random_range(0.2..4.0);
        let scene = scene(stars(&mut random, 6, 100.0, 18.0), clearance);
        let (mut circles, mut walls) = (Vec::new(), Vec::new());
        for edge in scene.obstacles.iter().flat_map(|obstacle| obstacle.shape.outer().edges()) {
            walls.push(Wall { a: pair(edge.start()), b: pair(edge.end()), distance: clearance });
            circles.push(Circle { center: pair(edge.start()), radius: clearance });
        }
        let mut end = || point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        let ends = [end(), end()];
        let axes = axes(&mut random);
        compared += usize::from(agrees(&scene, axes, ends, &circles, &walls, &format!("case {case}")));
    }
    assert!(compared > 70, "{compared}");
}

#[test]
fn the_way_round_is_the_one_that_takes_less_and_not_the_shorter_one() {
    // A plate that is nearer to its upper end; along X the machine is fast.
    let scene = scene([rectangle(0.0, -30.0, 10.0, 20.0)], 1.0);
    let (start, target) = (point(-5.0, 0.0), point(15.0, 0.0));
    let shorter = plan(&scene, start, target);
    let quick = plan_by(&scene, &speeds(1000.0, 10.0), start, target);
    assert!(quick.path.length() >= shorter.path.length());
    // The Y axis is the slower one nearly all the way: up 21 and down 21.
    assert!(quick.cost >= 4.2 && quick.cost < 4.25, "{}", quick.cost);
    let walls = [rectangle(0.0, -30.0, 10.0, 40.0), rectangle(-40.0, 12.0, 5.0, 13.0)];
    let scene = support::scene(walls, 1.0);
    let quick = plan_by(&scene, &speeds(10.0, 1000.0), start, target);
    assert_eq!(quick.lower_bound, quick.cost);
}

#[test]
fn mirrors_and_quarter_turns_cost_the_same() {
    for case in 0..40 {
        let mut random = Seed(73).part(case).stream();
        let mut shapes = stars(&mut random, 8, 100.0, 18.0);
        shapes.push(disc(50.0, 50.0, 12.0));
        let original = scene(shapes, [0.0, 1.5][case as usize % 2]);
        let (x, y) = axes(&mut random);
        let (start, target) = (point(-8.0, 3.0), point(108.0, 95.0));
        let found = plan_by(&original, &speeds(x, y), start, target);
        let quick = plan_by(&original, &timed(limits()), start, target);
        for (motion, (x, y)) in [
            (Motion::mirror_x(), (x, y)),
            (Motion::quarter_turns(1), (y, x)),
            (Motion::quarter_turns(2), (x, y)),
        ] {
            let mut moved = original.clone();
            for obstacle in &mut moved.obstacles {
                obstacle.shape = obstacle.shape.moved(&motion);
            }
            let (from, to) = (motion.point(start), motion.point(target));
            assert_close(plan_by(&moved, &speeds(x, y), from, to).cost, found.cost, &format!("case {case}"));
            assert_close(plan_by(&moved, &speeds(x, y), to, from).cost, found.cost, &format!("case {case}"));
            let again = plan_by(&moved, &timed(limits()), from, to);
            assert_close(again.lower_bound, quick.lower_bound, &format!("case {case}"));
        }
    }
}

#[test]
fn heights_are_the_best_of_all_levels_in_seconds() {
    let mut raised = 0;
    for case in 0..80 {
        let mut random = Seed(74).part(case).stream();
        let mut shapes = stars(&mut random, 10, 100.0, 22.0);
        shapes.push(rectangle(45.0, -30.0, 50.0, 130.0));
        let mut scene = scene(shapes, 1.0);
        for obstacle in &mut scene.obstacles {
            obstacle.top_z_mm = Some(random.random_range(0.0..30.0));
        }
        let rule = HeightRule { start_z_mm: 2.0, target_z_mm: 5.0, highest_z_mm: 28.0, clearance_z_mm: 1.0 };
        let flat = speeds(120.0, 80.0);
        let rules = RapidRules { heights: Some(rule), ..flat.clone() };
        let (start, target) = (point(-20.0, random.random_range(0.0..100.0)), point(120.0, 40.0));
        let Ok(Answer::Plan(found)) = answer_by(&scene, &rules, start, target) else { continue };
        let tops = scene.obstacles.iter().filter_map(|obstacle| obstacle.top_z_mm);
        let levels: Vec<f64> =
            tops.map(|top| top + 1.0).chain([5.0]).filter(|z| (5.0..=28.0).contains(z)).collect();
        let of_level = |z: f64| {
            let mut left = scene.clone();
            left.obstacles.retain(|obstacle| obstacle.top_z_mm.is_none_or(|top| top + 1.0 > z));
            match answer_by(&left, &flat, start, target) {
                Ok(Answer::Plan(plan)) => plan.cost + ((z - 2.0) + (z - 5.0)) / 25.0,
                _ => f64::INFINITY,
            }
        };
        let expected = levels.into_iter().map(of_level).fold(f64::INFINITY, f64::min);
        assert_close(found.cost, expected, &format!("case {case}"));
        assert_eq!(found.lower_bound, found.cost);
        raised += usize::from(found.path.steps.iter().filter_map(|step| step.z_mm).any(|z| z > 5.0));
        // Limits of acceleration: sound, bounded, no worse than the exact plan of the other measure.
        let quick = plan_by(&scene, &RapidRules { heights: Some(rule), ..timed(limits()) }, start, target);
        assert!(quick.lower_bound > 0.0 && quick.lower_bound <= quick.cost, "case {case}");
    }
    assert!(raised > 10, "{raised}");
}

#[test]
fn limits_of_acceleration_are_bounded_and_no_slower_than_the_shortest_way() {
    let (mut better, mut proven) = (0, 0);
    for case in 0..150 {
        let mut random = Seed(75).part(case).stream();
        let mut shapes = stars(&mut random, 12, 100.0, 13.0);
        shapes.extend((0..3).map(|i| disc(20.0 + 30.0 * f64::from(i), 50.0, random.random_range(2.0..9.0))));
        let base = scene(shapes, [0.0, 0.5, 2.0][case as usize % 3]);
        let scene = if case % 4 == 3 { mitred(base) } else { base };
        let limits = Kinematics { junction_deviation_mm: [0.0, 0.02, 0.5][case as usize % 3], ..limits() };
        let (start, target) = (point(-10.0, random.random_range(0.0..100.0)), point(110.0, 60.0));
        let rules = timed(limits);
        let Ok(Answer::Plan(quick)) = answer_by(&scene, &rules, start, target) else { continue };
        let shortest = plan(&scene, start, target);
        let seconds = travel_cost(&shortest.path, &rules.cost);
        assert!(quick.cost <= seconds * (1.0 + 1e-12), "case {case}: {} {seconds}", quick.cost);
        assert!(quick.lower_bound >= shortest.cost / 300.0, "case {case}");
        better += usize::from(quick.cost < seconds * 0.999);
        proven += usize::from(quick.cost == quick.lower_bound);
        assert!(quick.cost == quick.lower_bound || quick.path.steps.len() > 1, "case {case}");
    }
    assert!(better > 10 && proven > 5, "{better} {proven}");
}

#[test]
fn ways_out_count_and_prepared_scenes_answer_the_same() {
    for case in 0..40 {
        let mut random = Seed(76).part(case).stream();
        let mut shapes = stars(&mut random, 15, 100.0, 12.0);
        shapes.push(rectangle(-20.0, 40.0, -10.0, 60.0));
        let fresh = scene(shapes, 2.0);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        for rules in [speeds(200.0, 90.0), timed(limits())] {
            let rules = RapidRules { leave: EndRule::Nearest, ..rules };
            let target = point(random.random_range(0.0..110.0), random.random_range(0.0..110.0));
            let move_ = RapidMove { rules: rules.clone(), ..query(point(-8.7, 50.0), target) };
            let budget = Budget::unlimited();
            let found = prepared.plan(&move_, &budget, &mut Silent).map(|(answer, _)| answer);
            let expected = plan_rapid_move(&fresh, &move_, &budget, &mut Silent).map(|(answer, _)| answer);
            assert_eq!(found, expected, "case {case}");
            if let Ok(Answer::Plan(plan)) = expected {
                let check = check_by(&fresh, &rules, move_.start, target, &plan.path);
                assert!(check.is_sound(), "{:?}", check.violations);
                assert_close(check.cost, plan.cost, "recomputed");
            }
        }
    }
}

#[test]
fn the_published_scan_knows_length_alone_and_a_stop_tells_a_bound_in_seconds() {
    let scene = mitred(scene([rectangle(0.0, -30.0, 10.0, 20.0)], 1.0));
    let (start, target) = (point(-5.0, 0.0), point(15.0, 0.0));
    let asked = RapidMove {
        algorithm: Algorithm::SupportingLines,
        rules: speeds(10.0, 10.0),
        ..query(start, target)
    };
    let refused = plan_rapid_move(&scene, &asked, &Budget::unlimited(), &mut Silent).unwrap_err();
    assert!(matches!(refused[..], [Refusal::PublishedMethodNotApplicable { .. }]));
    let asked = RapidMove { algorithm: Algorithm::Exact, ..asked };
    let stopped =
        plan_rapid_move(&scene, &asked, &Budget { iterations: Some(1), ..Budget::unlimited() }, &mut Silent)
            .unwrap_err();
    let [Refusal::Interrupted { interrupt: Interrupt::Iterations, lower_bound }] = stopped[..] else {
        panic!("{stopped:?}")
    };
    assert!((2.0..4.2).contains(&lower_bound), "{lower_bound}");
}
