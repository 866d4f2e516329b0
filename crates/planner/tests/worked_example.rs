//! The worked example of the 2008 paper, and what its method refuses.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use support::{assert_sound, plan, point, polygon, rectangle, scene};
use traverse_geometry::{CornerStyle, Path, Point, Polygon, RapidRules, Scene};
use traverse_planner::{Algorithm, Answer, RapidMove, RapidPlan, Refusal, plan_rapid_move};
use traverse_solve::{Budget, Silent};

fn published_part() -> Polygon {
    polygon(&[
        (4.0, 6.0),
        (9.0, 6.0),
        (9.0, 7.0),
        (11.0, 7.0),
        (11.0, 9.0),
        (9.0, 9.0),
        (9.0, 10.0),
        (4.0, 10.0),
    ])
}

fn scan(scene: &Scene, start: Point, target: Point) -> Result<RapidPlan, Vec<Refusal>> {
    let query =
        RapidMove { start, target, algorithm: Algorithm::SupportingLines, rules: RapidRules::default() };
    match plan_rapid_move(scene, &query, &Budget::unlimited(), &mut Silent)? {
        (Answer::Plan(plan), _) => Ok(plan),
        (Answer::NoPath(_), _) => panic!("one obstacle parts nothing"),
    }
}

fn vertices(path: &Path) -> Vec<(f64, f64)> {
    std::iter::once(path.start).chain(path.steps.iter().map(|step| step.end)).map(|p| (p.x, p.y)).collect()
}

#[test]
fn the_scan_finds_both_published_candidates_and_keeps_the_shorter() {
    let scene = scene([published_part()], 0.0);
    let plan = scan(&scene, point(6.0, 5.0), point(6.0, 11.0)).unwrap();
    assert_eq!(vertices(&plan.path), [(6.0, 5.0), (4.0, 6.0), (4.0, 10.0), (6.0, 11.0)]);
    assert!((plan.cost - 8.472).abs() < 5e-4);
    assert_eq!(plan.lower_bound, plan.cost);
    let [s2, s1] = plan.alternatives.as_slice() else { panic!("two candidates") };
    assert_eq!(s2, &plan.path);
    let kept = [(6.0, 5.0), (9.0, 6.0), (11.0, 7.0), (11.0, 9.0), (9.0, 10.0), (6.0, 11.0)];
    assert_eq!(vertices(s1), kept);
    assert!((s1.length() - 12.797).abs() < 5e-4);
    assert_sound(&scene, point(6.0, 5.0), point(6.0, 11.0), &plan);
}

#[test]
fn the_exact_plan_agrees() {
    let plan = plan(&scene([published_part()], 0.0), point(6.0, 5.0), point(6.0, 11.0));
    assert!((plan.cost - 8.472_135_955).abs() < 1e-9);
    assert_eq!(plan.bending_obstacles, ["o0"]);
    assert!(plan.alternatives.is_empty());
}

#[test]
fn a_barrier_is_drawn_parallel_and_both_methods_agree_on_it() {
    let mitred = support::mitred(scene([published_part()], 0.5));
    let (start, target) = (point(7.0, 3.0), point(7.0, 12.0));
    let published = scan(&mitred, start, target).unwrap();
    let exact = plan(&mitred, start, target);
    assert!((published.cost - exact.cost).abs() < 1e-9, "{} {}", published.cost, exact.cost);
    assert_eq!(published.lower_bound, published.cost);
}

#[test]
fn ends_that_see_each_other_are_joined_straight() {
    let plan = scan(&scene([published_part()], 0.0), point(0.0, 0.0), point(20.0, 0.0)).unwrap();
    assert_eq!(plan.cost, 20.0);
    assert_eq!(plan.alternatives.len(), 1);
}

#[test]
fn what_the_paper_does_not_cover_is_refused() {
    let (start, target) = (point(6.0, 5.0), point(6.0, 11.0));
    let base = scene([published_part()], 0.0);
    let two = scene([published_part(), rectangle(20.0, 0.0, 21.0, 1.0)], 0.0);
    let round = Scene { clearance_mm: 0.1, ..base.clone() };
    let bounded = Scene { work_area: Some(rectangle(-50.0, -50.0, 50.0, 50.0)), ..base.clone() };
    let arcs = scene([support::disc(6.0, 8.0, 2.0)], 0.0);
    let cut =
        Scene { corner_style: CornerStyle::Miter { limit: Some(2.0) }, clearance_mm: 0.1, ..base.clone() };
    for (scene, why) in
        [(two, "one obstacle"), (round, "mitred"), (bounded, "work area"), (arcs, "straight"), (cut, "limit")]
    {
        let refusals = scan(&scene, start, target).unwrap_err();
        assert!(
            matches!(refusals.as_slice(), [Refusal::PublishedMethodNotApplicable { why: said }] if said.contains(why)),
            "{why}: {refusals:?}"
        );
    }
    // In the notch between the shoulder and the nose: outside the part, inside its hull.
    let refusals = scan(&base, point(10.0, 6.8), target).unwrap_err();
    assert!(matches!(refusals.as_slice(), [Refusal::PublishedMethodNotApplicable { .. }]), "{refusals:?}");
}

#[test]
fn a_line_through_two_corners_is_no_line_of_sight() {
    let square = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 0.0);
    let (start, target) = (point(-5.0, -5.0), point(15.0, 15.0));
    let plan = scan(&square, start, target).unwrap();
    assert!((plan.cost - 2.0 * 250.0_f64.sqrt()).abs() < 1e-9, "{}", plan.cost);
    assert_eq!(plan.alternatives.len(), 2);
    assert_sound(&square, start, target, &plan);
}

#[test]
fn every_scan_is_sound_and_bounded_by_the_exact_plan() {
    use rand::RngExt;
    let mut scanned = 0;
    for case in 0..400 {
        let mut random = traverse_solve::Seed(21).part(case).stream();
        let corners = random.random_range(3..12);
        let shape = support::star(&mut random, point(0.0, 0.0), 20.0, corners);
        let clearance = if case % 2 == 0 { 0.0 } else { random.random_range(0.1..3.0) };
        let scene = support::mitred(scene([shape], clearance));
        let mut end = || point(random.random_range(-40.0..40.0), random.random_range(-40.0..40.0));
        let (start, target) = (end(), end());
        if let Ok(found) = scan(&scene, start, target) {
            scanned += 1;
            assert_sound(&scene, start, target, &found);
            assert!(found.lower_bound <= found.cost);
            let exact = plan(&scene, start, target).cost;
            assert!(
                (found.cost - exact).abs() < 1e-9,
                "case {case}: round one convex hull the scan is exact"
            );
        }
    }
    assert!(scanned > 100, "{scanned}");
}
