//! Matrices of shortest costs: every entry is what a plan of that move costs, whatever the rules.
#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{disc, mitred, point, rectangle, ring, scene, stars};
use traverse_geometry::{
    ArcOutput, AxisSpeeds, EndRule, HeightRule, Point, Polygon, RapidRules, Scene, TravelCost, Vector,
};
use traverse_planner::{
    Algorithm, Answer, DistanceEnd, DistanceQuery, DistancesRefusal, RapidMove, Refusal, plan_distances,
    plan_rapid_move,
};
use traverse_solve::{Budget, CancelToken, Interrupt, Seed, Silent};

fn question(from: &[Point], to: &[Point], rules: &RapidRules) -> DistanceQuery {
    DistanceQuery { from: from.to_vec(), to: to.to_vec(), algorithm: Algorithm::Exact, rules: rules.clone() }
}

fn planned(scene: &Scene, start: Point, target: Point, rules: &RapidRules) -> Result<f64, Vec<Refusal>> {
    let query = RapidMove { start, target, algorithm: Algorithm::Exact, rules: rules.clone() };
    match plan_rapid_move(scene, &query, &Budget::unlimited(), &mut Silent)?.0 {
        Answer::Plan(plan) => Ok(plan.cost),
        Answer::NoPath(_) => Ok(f64::INFINITY),
    }
}

/// Works the matrix out and compares every entry with a plan. How many entries were finite, and how many were not;
/// none when ends were refused, as plans refuse them.
fn assert_plans(scene: &Scene, query: &DistanceQuery, what: &str) -> Option<[usize; 2]> {
    let targets = query.targets().to_vec();
    let found = plan_distances(scene, query, &Budget::unlimited());
    let costs = match found {
        Ok(costs) => costs,
        Err(DistancesRefusal::Ends(ends)) => {
            for (end, refusal) in ends {
                let (start, target) = match end {
                    DistanceEnd::From(i) => (query.from[i], targets[0]),
                    DistanceEnd::To(j) => (query.from[0], targets[j]),
                };
                let refused = planned(scene, start, target, &query.rules).unwrap_err();
                assert!(refused.contains(&refusal), "{what}: {refusal:?} is not in {refused:?}");
            }
            return None;
        }
        Err(other) => panic!("{what}: {other:?}"),
    };
    assert_eq!(costs.len(), query.from.len() * targets.len(), "{what}");
    let mut counts = [0, 0];
    for (i, &start) in query.from.iter().enumerate() {
        for (j, &target) in targets.iter().enumerate() {
            let cost = costs[i * targets.len() + j];
            let expected = planned(scene, start, target, &query.rules).expect("no end was refused");
            let is_same = cost == expected || (cost - expected).abs() <= 1e-9 * expected.max(1.0);
            assert!(is_same, "{what}: {start} to {target}: {cost} is not {expected}");
            counts[usize::from(cost.is_infinite())] += 1;
        }
    }
    Some(counts)
}

fn points(random: &mut impl RngExt, count: usize, side: f64) -> Vec<Point> {
    (0..count)
        .map(|_| point(random.random_range(-10.0..side + 10.0), random.random_range(-10.0..side + 10.0)))
        .collect()
}

/// Points that no barrier of the scene holds.
fn clear_points(random: &mut impl RngExt, scene: &Scene, count: usize, side: f64) -> Vec<Point> {
    let mut clear = Vec::new();
    while clear.len() < count {
        let at = points(random, 1, side)[0];
        if planned(scene, at, at, &RapidRules::default()).is_ok() {
            clear.push(at);
        }
    }
    clear
}

#[test]
fn every_entry_costs_what_its_plan_costs() {
    let mut unreachable = 0;
    for seed in 0..60 {
        let mut random = Seed(seed).stream();
        let count = random.random_range(0..30);
        let shapes = stars(&mut random, count, 100.0, 18.0);
        let work_area = Some(rectangle(-12.0, -12.0, 112.0, 112.0));
        let bounded = Scene { work_area, ..scene(shapes.clone(), 1.5) };
        for scene in [scene(shapes.clone(), 0.0), bounded, mitred(scene(shapes, 1.0))] {
            let from = clear_points(&mut random, &scene, 6, 100.0);
            let to = clear_points(&mut random, &scene, 4, 100.0);
            for to in [&[][..], &to, &to[..1]] {
                let query = question(&from, to, &RapidRules::default());
                let counts = assert_plans(&scene, &query, &format!("seed {seed}")).unwrap();
                unreachable += counts[1];
            }
        }
    }
    assert!(unreachable > 0, "some points lie in closed courts");
}

/// So many that one search in all directions takes less than one for each.
#[test]
fn many_points_among_few_corners_cost_what_their_plans_cost() {
    let mut unreachable = 0;
    for seed in 0..20 {
        let mut random = Seed(seed).stream();
        let mut shapes = stars(&mut random, 7, 100.0, 25.0);
        // Nobody gets out of the frame.
        let square = |low: f64, high: f64| ring(&[(low, low), (high, low), (high, high), (low, high)]);
        let frame = Polygon::new(square(60.0, 95.0), vec![square(63.0, 92.0)]).unwrap();
        shapes.extend([disc(20.0, 80.0, 9.0), disc(26.0, 74.0, 7.0), frame]);
        let work_area = Some(rectangle(-12.0, -12.0, 112.0, 112.0));
        let bounded = Scene { work_area, ..scene(shapes.clone(), 1.5) };
        for scene in [scene(shapes.clone(), 0.0), bounded, mitred(scene(shapes, 1.0))] {
            let from = clear_points(&mut random, &scene, 2, 100.0);
            let to = clear_points(&mut random, &scene, 250, 100.0);
            let query = question(&from, &to, &RapidRules::default());
            unreachable += assert_plans(&scene, &query, &format!("seed {seed}")).unwrap()[1];
        }
    }
    assert!(unreachable > 0, "some points lie in closed courts");
}

#[test]
fn discs_and_corners_are_gone_round_by_arcs() {
    for seed in 0..40 {
        let mut random = Seed(seed).stream();
        let mut place = || (random.random_range(0.0..60.0), random.random_range(0.0..60.0));
        let discs: Vec<_> = (0..12).map(|i| (place(), 1.0 + f64::from(i % 7))).collect();
        let scene = scene(discs.into_iter().map(|((x, y), radius)| disc(x, y, radius)), 2.0);
        let from = clear_points(&mut random, &scene, 7, 60.0);
        assert_plans(&scene, &question(&from, &[], &RapidRules::default()), &format!("seed {seed}")).unwrap();
    }
}

#[test]
fn corners_and_borders_are_ends_too() {
    let shapes = [rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 4.0, 20.0, 14.0), disc(30.0, 5.0, 5.0)];
    for scene in [scene(shapes.clone(), 0.0), mitred(scene(shapes, 0.0))] {
        let from = [(0.0, 0.0), (10.0, 4.0), (5.0, 10.0), (20.0, 4.0), (30.0, 0.0), (25.0, 5.0), (0.0, 0.0)];
        let from = from.map(|(x, y)| point(x, y));
        assert_plans(&scene, &question(&from, &[], &RapidRules::default()), "borders").unwrap();
    }
}

#[test]
fn rules_hold_for_every_entry() {
    let direction = EndRule::Direction(Vector::new(1.0, 0.5));
    let heights = |start_z_mm, target_z_mm| {
        Some(HeightRule { start_z_mm, target_z_mm, highest_z_mm: 12.0, clearance_z_mm: 1.0 })
    };
    let (mut refused, mut answered) = (0, 0);
    for seed in 0..40 {
        let mut random = Seed(seed).stream();
        let mut scene = scene(stars(&mut random, 18, 80.0, 14.0), 2.0);
        for obstacle in &mut scene.obstacles {
            obstacle.top_z_mm = random.random_bool(0.8).then(|| random.random_range(-5.0..15.0));
        }
        let from = points(&mut random, 5, 80.0);
        let to = points(&mut random, 3, 80.0);
        let nearest = RapidRules { leave: EndRule::Nearest, enter: EndRule::Nearest, ..Default::default() };
        let mixed = RapidRules { enter: direction, ..nearest.clone() };
        let level = RapidRules { heights: heights(0.0, 0.0), ..nearest.clone() };
        let slanted = RapidRules { heights: heights(-2.0, 5.0), ..nearest.clone() };
        let several = RapidRules { clearances_mm: vec![5.0, 2.0, 0.5], ..Default::default() };
        let speeds = AxisSpeeds { x_mm_per_s: 200.0, y_mm_per_s: 100.0, z_mm_per_s: 50.0 };
        let seconds = RapidRules { cost: TravelCost::AxisSpeeds(speeds), ..level.clone() };
        let chords = RapidRules { arcs: ArcOutput::Chords, ..nearest.clone() };
        let all = RapidRules { clearances_mm: vec![5.0, 2.0, 0.5], ..slanted.clone() };
        for rules in [RapidRules::default(), nearest, mixed, level, slanted, several, seconds, chords, all] {
            for to in [&[][..], &to] {
                match assert_plans(&scene, &question(&from, to, &rules), &format!("seed {seed} {rules:?}")) {
                    Some(_) => answered += 1,
                    None => refused += 1,
                }
            }
        }
    }
    assert!(refused > 50 && answered > 50, "{refused} refused, {answered} answered");
}

#[test]
fn a_matrix_of_the_same_points_is_symmetric_to_the_bit() {
    let mut random = Seed(7).stream();
    let scene = scene(stars(&mut random, 30, 100.0, 15.0), 1.0);
    let from = clear_points(&mut random, &scene, 25, 100.0);
    let costs =
        plan_distances(&scene, &question(&from, &[], &RapidRules::default()), &Budget::unlimited()).unwrap();
    for i in 0..from.len() {
        assert_eq!(costs[i * from.len() + i], 0.0);
        for j in 0..i {
            assert_eq!(costs[i * from.len() + j].to_bits(), costs[j * from.len() + i].to_bits());
        }
    }
    let again =
        plan_distances(&scene, &question(&from, &[], &RapidRules::default()), &Budget::unlimited()).unwrap();
    assert_eq!(costs, again);
}

#[test]
fn every_end_inside_a_barrier_is_named() {
    let scene = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(5.0, 5.0, 30.0, 9.0)], 1.0);
    let from = [point(-5.0, 0.0), point(6.0, 6.0), point(20.0, 9.5)];
    let refused = |to: &[Point]| {
        let query = question(&from, to, &RapidRules::default());
        match plan_distances(&scene, &query, &Budget::unlimited()) {
            Err(DistancesRefusal::Ends(ends)) => ends.into_iter().map(|(end, _)| end).collect::<Vec<_>>(),
            other => panic!("{other:?}"),
        }
    };
    let mut named = refused(&[]);
    named.dedup();
    assert_eq!(named.len(), 2, "{named:?}");
    assert_eq!(refused(&[point(1.0, 1.0)])[2..], [DistanceEnd::From(2), DistanceEnd::To(0)]);
}

#[test]
fn the_published_scan_prices_its_own_ways() {
    let scene = mitred(scene([rectangle(0.0, 0.0, 10.0, 4.0)], 1.0));
    let from = [point(-5.0, 2.0), point(15.0, 3.0), point(4.0, -9.0)];
    let scan = |from: &[Point]| {
        let query = DistanceQuery {
            algorithm: Algorithm::SupportingLines,
            ..question(from, &[], &Default::default())
        };
        plan_distances(&scene, &query, &Budget::unlimited())
    };
    let exact =
        plan_distances(&scene, &question(&from, &[], &Default::default()), &Budget::unlimited()).unwrap();
    for (scanned, exact) in scan(&from).unwrap().into_iter().zip(exact) {
        assert!(scanned >= exact - 1e-9, "{scanned} {exact}");
    }
    let inside_the_hull = scan(&[point(-5.0, 2.0), point(4.0, 5.0)]);
    assert!(matches!(
        inside_the_hull,
        Ok(_) | Err(DistancesRefusal::Move(Refusal::PublishedMethodNotApplicable { .. }))
    ));
}

#[test]
fn it_stops_when_told_to() {
    let mut random = Seed(1).stream();
    let scene = scene(stars(&mut random, 40, 100.0, 12.0), 1.0);
    let from = clear_points(&mut random, &scene, 8, 100.0);
    let query = question(&from, &[], &RapidRules::default());
    let few = Budget { iterations: Some(5), ..Budget::unlimited() };
    assert_eq!(
        plan_distances(&scene, &query, &few),
        Err(DistancesRefusal::Interrupted(Interrupt::Iterations))
    );
    let cancel = CancelToken::new();
    cancel.cancel();
    let over = Budget { cancel, ..Budget::unlimited() };
    assert_eq!(
        plan_distances(&scene, &query, &over),
        Err(DistancesRefusal::Interrupted(Interrupt::Cancelled))
    );
}
