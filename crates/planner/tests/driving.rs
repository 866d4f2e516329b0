//! Plans as the machine runs them: arcs as chords outside of them, straight moves as dog-legs.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{
    answer_by, assert_close, check_by, disc, mitred, plan_by, point, query, rectangle, scene, stars,
};
use traverse_checker::ViolationReason;
use traverse_geometry::{
    ARC_CHORD_TOLERANCE_MM, ArcOutput, AxisSpeeds, CONTACT_TOLERANCE_MM, CornerStyle, EndRule, HeightRule,
    Kinematics, Path, Point, Polygon, RapidMotion, RapidRules, Ring, Scene, TravelCost,
};
use traverse_planner::{Answer, PreparedScene, RapidMove, RapidPlan, Refusal, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

fn by_axes(x: f64, y: f64, motion: RapidMotion, arcs: ArcOutput) -> RapidRules {
    let cost = TravelCost::AxisSpeeds(AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 25.0 });
    RapidRules { cost, motion, arcs, ..RapidRules::default() }
}

fn dog_leg(x: f64, y: f64, arcs: ArcOutput) -> RapidRules {
    by_axes(x, y, RapidMotion::DogLeg, arcs)
}

fn chords() -> RapidRules {
    RapidRules { arcs: ArcOutput::Chords, ..RapidRules::default() }
}

fn arc_count(plan: &RapidPlan) -> usize {
    plan.path.steps.iter().filter(|step| step.arc.is_some()).count()
}

/// Obstacles of any kind, and ends that may lie anywhere.
fn anything(case: u64, seed: u64) -> (Scene, [Point; 2]) {
    let mut random = Seed(seed).part(case).stream();
    let mut shapes = stars(&mut random, 9, 100.0, 17.0);
    shapes.extend((0..4).map(|_| {
        disc(random.random_range(0.0..100.0), random.random_range(0.0..100.0), random.random_range(2.0..12.0))
    }));
    let mut made = scene(shapes, [0.0, 0.3, 2.5][case as usize % 3]);
    if case % 5 == 4 {
        made = mitred(made);
    }
    if case.is_multiple_of(4) {
        made.work_area = Some(rectangle(-15.0, -15.0, 115.0, 115.0));
    }
    let mut end = |x: f64| point(x, random.random_range(-10.0..110.0));
    (made, [end(-10.0), end(110.0)])
}

#[test]
fn chords_are_sound_and_lie_just_outside_of_their_arcs() {
    let (mut plans, mut bent) = (0, 0);
    for case in 0..200 {
        let (scene, [start, target]) = anything(case, 81);
        let Ok(Answer::Plan(arcs)) = answer_by(&scene, &RapidRules::default(), start, target) else {
            continue;
        };
        let found = plan_by(&scene, &chords(), start, target);
        plans += 1;
        assert_eq!(arc_count(&found), 0, "case {case}");
        assert_eq!(found.lower_bound.min(arcs.cost), found.lower_bound);
        assert_close(found.lower_bound, arcs.cost, &format!("case {case}"));
        assert!(found.cost >= arcs.cost * (1.0 - 1e-12), "case {case}");
        // A polygon round a circle of radius r within t of it is longer than the circle by less than 2 t / 3 r.
        assert!(found.cost <= arcs.cost * (1.0 + 0.01) + 0.05, "case {case}: {} {}", found.cost, arcs.cost);
        bent += usize::from(arc_count(&arcs) > 0);
        // Seconds of axes: chords cost what arcs cost.
        let seconds =
            plan_by(&scene, &by_axes(90.0, 140.0, RapidMotion::Linear, ArcOutput::Chords), start, target);
        assert_eq!(seconds.cost, seconds.lower_bound, "case {case}");
        assert_eq!(arc_count(&seconds), 0, "case {case}");
    }
    assert!(plans > 100 && bent > 50, "{plans} {bent}");
}

#[test]
fn a_pin_is_gone_round_by_few_chords_and_a_tight_gap_by_more() {
    let pin = scene([disc(0.0, 0.0, 5.0)], 1.0);
    let (start, target) = (point(-20.0, 0.5), point(20.0, 0.5));
    let found = plan_by(&pin, &chords(), start, target);
    assert!((5..16).contains(&found.path.steps.len()), "{}", found.path.steps.len());
    let far = found
        .path
        .steps
        .iter()
        .map(|step| step.end.coords.norm())
        .filter(|&far| far < 19.0)
        .fold(0.0, f64::max);
    assert!(far <= 6.0 + ARC_CHORD_TOLERANCE_MM + 1e-9 && far > 6.0, "{far}");
    // A second pin leaves a gap that is wider than the path by 0.1 micrometres where the arc passes it.
    let mut tighter = 0;
    for degrees in 76..105 {
        let apart = traverse_geometry::unit(f64::from(degrees).to_radians()) * 12.0001;
        let (first, second) = (disc(0.0, 0.0, 5.0), disc(apart.x, apart.y, 5.0));
        let wall = rectangle(-1.0, -60.0, 1.0, 0.0);
        let other = rectangle(apart.x - 1.0, apart.y, apart.x + 1.0, 60.0);
        let tight = plan_by(&scene([first, second, wall, other], 1.0), &chords(), start, target);
        assert_eq!(arc_count(&tight), 0, "{degrees}");
        tighter += usize::from(tight.path.steps.len() > 2 * found.path.steps.len());
    }
    assert!(tighter > 10, "{tighter}");
}

#[test]
fn chords_shorten_no_step_and_kinematics_prices_what_is_run() {
    let pin = scene([disc(0.0, 0.0, 5.0)], 1.0);
    let limits = Kinematics {
        speed_mm_per_s: 300.0,
        z_mm_per_s: 0.0,
        acceleration_mm_per_s2: 2000.0,
        junction_deviation_mm: 0.05,
        feed_mm_per_s: 20.0,
    };
    let fed = RapidRules { cost: TravelCost::Kinematics(limits), ..RapidRules::default() };
    let (start, target) = (point(-50.0, 0.5), point(50.0, 0.5));
    let slow = plan_by(&pin, &fed, start, target);
    let quick = plan_by(&pin, &RapidRules { arcs: ArcOutput::Chords, ..fed }, start, target);
    assert!(quick.cost < slow.cost, "{} {}", quick.cost, slow.cost);
    assert_close(quick.lower_bound, slow.lower_bound, "the same bound");
}

#[test]
fn dog_legs_are_sound_and_cost_nothing_where_there_is_room() {
    let (mut plans, mut proven, mut refused) = (0, 0, 0);
    for case in 0..240 {
        let (scene, [start, target]) = anything(case, 82);
        let (x, y) = [(100.0, 100.0), (200.0, 60.0), (40.0, 900.0)][case as usize % 3];
        let arcs = [ArcOutput::Arcs, ArcOutput::Chords][case as usize % 2];
        let linear = answer_by(&scene, &by_axes(x, y, RapidMotion::Linear, ArcOutput::Arcs), start, target);
        let Ok(Answer::Plan(linear)) = linear else { continue };
        match answer_by(&scene, &dog_leg(x, y, arcs), start, target) {
            Ok(Answer::Plan(found)) => {
                plans += 1;
                assert_close(found.lower_bound, linear.lower_bound, &format!("case {case}"));
                proven += usize::from(found.cost == found.lower_bound);
                if arcs == ArcOutput::Chords {
                    assert_eq!(arc_count(&found), 0, "case {case}");
                }
            }
            Err(refusals) => {
                refused += 1;
                assert_eq!(refusals, [Refusal::NoRoomForDogLegs], "case {case}");
            }
            other => panic!("case {case}: {other:?}"),
        }
    }
    assert!(plans > 120 && proven * 50 >= plans * 49 && refused < 3, "{plans} {proven} {refused}");
}

#[test]
fn a_straight_rapid_that_is_safe_as_a_line_and_not_as_a_dog_leg_is_led_round() {
    // One clamp above the line, one below it: in the way of both axes first, and of both axes last.
    let clamps = scene([rectangle(20.0, 25.0, 38.0, 60.0), rectangle(60.0, 0.0, 80.0, 20.0)], 1.0);
    let (start, target) = (point(0.0, 0.0), point(100.0, 50.0));
    let rules = dog_leg(100.0, 100.0, ArcOutput::Arcs);
    let mut line = Path::at(start);
    line.line_to(target);
    let straight = by_axes(100.0, 100.0, RapidMotion::Linear, ArcOutput::Arcs);
    assert!(check_by(&clamps, &straight, start, target, &line).is_sound());
    let check = check_by(&clamps, &rules, start, target, &line);
    assert!(check.violations.iter().any(|violation| violation.reason == ViolationReason::InsideObstacle));
    assert!(check.violations.iter().all(|violation| violation.field == "path.steps[0]"));
    let found = plan_by(&clamps, &rules, start, target);
    assert_eq!((found.cost, found.lower_bound), (1.0, 1.0));
    assert!(found.path.steps.len() > 1);
}

#[test]
fn a_slanted_passage_no_wider_than_the_path_is_refused_and_a_straight_one_is_not() {
    let band = |degrees: f64, low: f64, high: f64| {
        let (along, up) = (
            traverse_geometry::unit(degrees.to_radians()),
            traverse_geometry::left_of(traverse_geometry::unit(degrees.to_radians())),
        );
        let at = |a: f64, u: f64| point(0.0, 0.0) + along * a + up * u;
        let corners = vec![at(-20.0, low), at(20.0, low), at(20.0, high), at(-20.0, high)];
        Polygon::from_ring(Ring::new(corners, vec![]).unwrap())
    };
    let rules = dog_leg(100.0, 100.0, ArcOutput::Chords);
    let passage = |degrees: f64, width: f64, shut: bool| {
        let mut made = scene([band(degrees, -150.0, -width / 2.0), band(degrees, width / 2.0, 150.0)], 2.0);
        if shut {
            made.work_area = Some(band(degrees, -140.0, 140.0));
            made.work_area_clearance_mm = Some(0.0);
        }
        let ends = [-19.0, 19.0].map(|a| point(0.0, 0.0) + traverse_geometry::unit(degrees.to_radians()) * a);
        answer_by(&made, &rules, ends[0], ends[1])
    };
    assert!(matches!(passage(0.0, 4.0, false), Ok(Answer::Plan(_))), "along an axis");
    assert!(matches!(passage(45.0, 4.0, false), Ok(Answer::Plan(_))), "along the diagonal");
    assert_eq!(passage(20.0, 4.0, true), Err(vec![Refusal::NoRoomForDogLegs]));
    let Ok(Answer::Plan(roomy)) = passage(20.0, 4.5, true) else { panic!("half a millimetre of room") };
    assert_eq!(roomy.cost, roomy.lower_bound);
    // A smaller clearance of a list is tried.
    let mut narrow = scene([band(20.0, -150.0, -2.0), band(20.0, 2.0, 150.0)], 2.0);
    narrow.work_area = Some(band(20.0, -140.0, 140.0));
    narrow.work_area_clearance_mm = Some(0.0);
    let along = traverse_geometry::unit(20.0_f64.to_radians());
    let listed = RapidRules { clearances_mm: vec![2.0, 1.0], ..rules };
    let found = plan_by(&narrow, &listed, point(0.0, 0.0) - along * 19.0, point(0.0, 0.0) + along * 19.0);
    assert_eq!(found.clearance_mm, 1.0);
}

#[test]
fn the_best_way_round_a_passage_without_room_is_found_and_bounded() {
    // A slanted slit of exactly twice the clearance, and a detour.
    let along = traverse_geometry::unit(20.0_f64.to_radians());
    let up = traverse_geometry::left_of(along);
    let at = |a: f64, u: f64| point(0.0, 0.0) + along * a + up * u;
    let band = |low: f64, high: f64| {
        let corners = vec![at(-20.0, low), at(20.0, low), at(20.0, high), at(-20.0, high)];
        Polygon::from_ring(Ring::new(corners, vec![]).unwrap())
    };
    let slit = scene([band(-15.0, -2.0), band(2.0, 30.0)], 2.0);
    let rules = dog_leg(100.0, 100.0, ArcOutput::Chords);
    let found = plan_by(&slit, &rules, at(-30.0, 0.0), at(30.0, 0.0));
    assert!(found.lower_bound < found.cost && found.cost < 2.0 * found.lower_bound, "{found:?}");
    assert_eq!(found.bending_obstacles, ["o0"]);
}

#[test]
fn ways_out_of_barriers_run_where_dog_legs_are_straight() {
    let plate = scene([rectangle(0.0, 0.0, 10.0, 10.0), disc(30.0, 30.0, 4.0)], 3.0);
    let (start, target) = (point(-1.0, 5.0), point(34.0, 34.0));
    let rules = RapidRules {
        leave: EndRule::Nearest,
        enter: EndRule::Nearest,
        ..dog_leg(100.0, 80.0, ArcOutput::Chords)
    };
    let found = plan_by(&plate, &rules, start, target);
    assert_close(found.path.steps[0].end.x, -3.0, "straight out");
    let first = found.path.steps[0].end - start;
    assert!(first.y.abs() < 1e-9, "{first}");
    let last = found.path.steps[found.path.steps.len() - 2].end - target;
    let directions =
        AxisSpeeds { x_mm_per_s: 100.0, y_mm_per_s: 80.0, z_mm_per_s: 0.0 }.straight_directions();
    assert!(directions.iter().any(|direction| (direction - last.normalize()).norm() < 1e-9), "{last}");
}

#[test]
fn dog_legs_at_heights_and_in_prepared_scenes() {
    for case in 0..40 {
        let (mut scene, [start, target]) = anything(case, 83);
        scene.corner_style = CornerStyle::Round;
        for (obstacle, top) in scene.obstacles.iter_mut().zip(0..) {
            obstacle.top_z_mm = Some(f64::from(top));
        }
        let heights =
            HeightRule { start_z_mm: 0.0, target_z_mm: 2.0, highest_z_mm: 8.5, clearance_z_mm: 0.5 };
        let rules = RapidRules { heights: Some(heights), ..dog_leg(100.0, 70.0, ArcOutput::Chords) };
        let mut prepared = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
        for rules in [rules.clone(), RapidRules { heights: None, ..rules }, chords()] {
            let move_ = RapidMove { rules: rules.clone(), ..query(start, target) };
            let expected = plan_rapid_move(&scene, &move_, &Budget::unlimited(), &mut Silent);
            let found = prepared.plan(&move_, &Budget::unlimited(), &mut Silent);
            match (found, expected) {
                (Ok((Answer::Plan(found), _)), Ok((Answer::Plan(expected), _))) => {
                    assert_close(found.cost, expected.cost, &format!("case {case}"));
                    let check = check_by(&scene, &rules, start, target, &found.path);
                    assert!(check.is_sound(), "case {case}: {:?}", check.violations);
                }
                (found, expected) => {
                    let answer = |of: Result<(Answer, _), _>| of.map(|(answer, _)| answer);
                    assert_eq!(answer(found), answer(expected), "case {case}");
                }
            }
        }
    }
}

#[test]
fn the_checker_refuses_dog_legs_that_are_moved_into_what_they_pass() {
    let mut refused = 0;
    for case in 0..60 {
        let (scene, [start, target]) = anything(case, 84);
        let rules = dog_leg(100.0, 130.0, ArcOutput::Chords);
        let Ok(Answer::Plan(found)) = answer_by(&scene, &rules, start, target) else { continue };
        for step in 0..found.path.steps.len().saturating_sub(1) {
            // Every way point is pushed into what bends the path: towards the line between its neighbours.
            let before = if step == 0 { start } else { found.path.steps[step - 1].end };
            let (at, after) = (found.path.steps[step].end, found.path.steps[step + 1].end);
            let inwards = nalgebra::center(&before, &after) - at;
            let Some(inwards) = inwards.try_normalize(1e-3) else { continue };
            let mut moved = found.path.clone();
            moved.steps[step].end = at + inwards * 0.05;
            let check = check_by(&scene, &rules, start, target, &moved);
            refused += usize::from(!check.is_sound());
            if let Some(margin) = check.smallest_margin_mm {
                assert_eq!(check.is_sound(), margin >= -CONTACT_TOLERANCE_MM, "case {case} step {step}");
            }
        }
    }
    assert!(refused > 40, "{refused}");
}
