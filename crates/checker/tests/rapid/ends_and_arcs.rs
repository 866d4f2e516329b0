//! Start, target, and arcs that agree with themselves.

use crate::making::*;
use std::f64::consts::TAU;
use traverse_checker::{ViolationReason, check_rapid_move};
use traverse_geometry::{Path, PathArc, PathStep};

fn violations(path: &Path) -> Vec<(String, ViolationReason, f64)> {
    let found = check_rapid_move(&scene(0.0, vec![]), path.start, path.end(), path, TOLERANCE).violations;
    found.into_iter().map(|violation| (violation.field, violation.reason, violation.amount)).collect()
}

fn circular(start: (f64, f64), end: (f64, f64), center: (f64, f64), sweep: f64) -> Path {
    let mut path = Path::at(p(start.0, start.1));
    let center = p(center.0, center.1);
    path.steps.push(PathStep { end: p(end.0, end.1), arc: Some(PathArc { center, sweep }), z_mm: None });
    path
}

#[test]
fn an_empty_scene_accepts_anything_that_connects_the_ends() {
    let check = accepts(&scene(1.0, vec![]), &arc(line(&[(0.0, 0.0), (3.0, 4.0)]), (3.0, 3.0), 90.0));
    close(check.cost, 5.0 + TAU / 4.0);
    assert_eq!(check.smallest_margin_mm, None);
}

#[test]
fn a_path_without_steps_is_a_point() {
    let scene = scene(1.0, vec![rectangle(0.0, 0.0, 10.0, 10.0)]);
    close(accepts(&scene, &line(&[(5.0, 13.0)])).smallest_margin_mm.expect("there is an obstacle"), 2.0);
    let near = refuses(&scene, &line(&[(5.0, 10.5)]), ViolationReason::TooClose);
    assert_eq!(near.violations[0].field, "path.start");
    refuses(&scene, &line(&[(5.0, 5.0)]), ViolationReason::InsideObstacle);
}

#[test]
fn wrong_ends_say_by_how_much() {
    let path = line(&[(0.0, 0.0), (1.0, 0.0), (10.0, 0.0)]);
    let found =
        check_rapid_move(&scene(0.0, vec![]), p(3.0, 4.0), p(10.0, 1e-5), &path, TOLERANCE).violations;
    let found: Vec<_> = found.iter().map(|violation| (violation.field.as_str(), violation.reason)).collect();
    assert_eq!(
        found,
        [("path.start", ViolationReason::WrongStart), ("path.steps[1].end", ViolationReason::WrongEnd)]
    );
    let found = check_rapid_move(&scene(0.0, vec![]), p(5e-7, 0.0), p(10.0, -5e-7), &path, TOLERANCE);
    assert!(found.is_sound());
}

#[test]
fn arcs_of_any_sweep_are_accepted() {
    for sweep in [1e-9, 0.1, 3.0, 3.2, 6.2, TAU, -0.1, -3.2, -TAU] {
        let (sin, cos) = f64::sin_cos(sweep);
        let path = circular((5.0, 1.0), (3.0 + 2.0 * cos, 1.0 + 2.0 * sin), (3.0, 1.0), sweep);
        assert_eq!(violations(&path), []);
        close(check(&scene(0.0, vec![]), &path).cost, 2.0 * sweep.abs());
    }
}

#[test]
fn radii_may_differ_by_the_tolerance() {
    assert_eq!(violations(&circular((1.0, 0.0), (0.0, 1.0 + 9e-7), (0.0, 0.0), TAU / 4.0)), []);
    let found = violations(&circular((1.0, 0.0), (0.0, 1.0 + 1e-5), (0.0, 0.0), TAU / 4.0));
    assert_eq!(
        (found[0].0.as_str(), found[0].1),
        ("path.steps[0].arc.center", ViolationReason::ArcRadiiDiffer)
    );
    assert!((found[0].2 - 1e-5).abs() < 1e-12);
    // Large circles are given as a share of the radius.
    assert_eq!(violations(&circular((1e5, 0.0), (0.0, 1e5 + 9e-5), (0.0, 0.0), TAU / 4.0)), []);
}

#[test]
fn sweeps_stay_within_one_turn() {
    for sweep in [0.0, -0.0, 6.3, -6.3, 1e30] {
        let found = violations(&circular((1.0, 0.0), (1.0, 0.0), (0.0, 0.0), sweep));
        assert_eq!(found[0].1, ViolationReason::SweepOutOfRange, "{sweep}");
    }
}

#[test]
fn sweeps_agree_with_the_end() {
    for sweep in [-TAU / 4.0, TAU / 4.0 + 1e-5, TAU / 2.0, TAU, 1e-9] {
        let found = violations(&circular((1.0, 0.0), (0.0, 1.0), (0.0, 0.0), sweep));
        assert_eq!(found[0].1, ViolationReason::SweepMissesEnd, "{sweep}");
    }
    assert_eq!(violations(&circular((1.0, 0.0), (0.0, 1.0), (0.0, 0.0), -0.75 * TAU)), []);
    let found = violations(&circular((1.0, 0.0), (0.0, 1.0), (0.0, 0.0), TAU / 4.0 + 1e-3));
    assert!((found[0].2 - 1e-3).abs() < 1e-9);
}
