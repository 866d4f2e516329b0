//! Numbers that no path should hold, and sizes that one may.

use crate::making::*;
use proptest::prelude::*;
use std::time::Instant;
use traverse_checker::{RapidMoveChecker, VIOLATION_LIMIT, ViolationReason, check_rapid_move};
use traverse_geometry::{Path, PathArc, PathStep, Ring};

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>(),
        -20.0..20.0_f64,
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(1e308),
        Just(1e75),
        Just(1e-320),
        Just(0.0),
        Just(5.0),
        Just(10.0)
    ]
}

fn any_path() -> impl Strategy<Value = Path> {
    let step = (number(), number(), proptest::option::of((number(), number(), number())));
    (number(), number(), proptest::collection::vec(step, 0..6)).prop_map(|(x, y, steps)| Path {
        start: p(x, y),
        start_z_mm: None,
        steps: steps
            .into_iter()
            .map(|(x, y, arc)| PathStep {
                end: p(x, y),
                arc: arc.map(|(x, y, sweep)| PathArc { center: p(x, y), sweep }),
                z_mm: None,
            })
            .collect(),
    })
}

proptest! {
    #[test]
    fn never_panics(path in any_path(), clearance in prop_oneof![Just(0.0), 0.1..3.0_f64], miter in any::<bool>(), tolerance in number()) {
        let mut scene = scene(clearance, vec![rectangle(0.0, 0.0, 5.0, 5.0), disc(10.0, 0.0, 5.0)]);
        scene.work_area = Some(polygon(rectangle(-20.0, -20.0, 20.0, 20.0), vec![disc(10.0, 10.0, 2.0)]));
        if miter {
            scene = mitred(scene, None);
        }
        let _ = check_rapid_move(&scene, path.start, path.end(), &path, tolerance);
    }
}

#[test]
fn numbers_that_are_not_finite_are_named_and_nothing_else() {
    let scene = scene(0.0, vec![rectangle(0.0, 0.0, 5.0, 5.0)]);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308] {
        let mut path = line(&[(2.0, 2.0), (3.0, 3.0), (4.0, 9.0)]);
        path.steps[1].arc = Some(PathArc { center: p(0.0, bad), sweep: 1.0 });
        let check = check_rapid_move(&scene, p(7.0, 7.0), path.end(), &path, TOLERANCE);
        assert_eq!(check.violations.len(), 1, "{:?}", check.violations);
        assert_eq!(check.violations[0].field, "path.steps[1].arc.center.y_mm");
        assert_eq!(check.violations[0].reason, ViolationReason::NotFinite);
        assert_eq!((check.cost, check.smallest_margin_mm), (0.0, None));
    }
    let check = check_rapid_move(&scene, p(f64::NAN, 0.0), p(0.0, 0.0), &line(&[(0.0, 0.0)]), TOLERANCE);
    assert_eq!(check.violations[0].field, "start.x_mm");
}

#[test]
fn the_list_is_capped() {
    let scene = scene(1.0, vec![rectangle(0.0, 0.0, 5.0, 5.0)]);
    let zigzag: Vec<_> = (0..3000).map(|i| (f64::from(i % 2), 2.0)).collect();
    assert_eq!(check(&scene, &line(&zigzag)).violations.len(), VIOLATION_LIMIT);
    let nowhere = vec![(f64::NAN, 2.0); 3000];
    assert_eq!(check(&scene, &line(&nowhere)).violations.len(), VIOLATION_LIMIT);
}

/// A circle of a million corners, gone round on its corners in ten thousand steps and once along each edge.
#[test]
fn a_million_vertices_and_ten_thousand_steps_take_seconds() {
    let corner = |i: u32, of: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(of)).sin_cos();
        p(1e5 * cos, 1e5 * sin)
    };
    let ring = Ring::new((0..1_000_000).map(|i| corner(i, 1_000_000)).collect(), Vec::new())
        .expect("a circle is valid");
    let scene = scene(0.0, vec![ring]);
    let before = Instant::now();
    let checker = RapidMoveChecker::new(&scene);
    let built = before.elapsed();
    let round = |first: u32, count: u32, every: u32| {
        let mut path = Path::at(corner(first, 1_000_000));
        for i in 1..=count {
            path.line_to(corner(first + i * every, 1_000_000));
        }
        path
    };
    let slide = round(0, 10_000, 1);
    let before = Instant::now();
    let check = checker.check(slide.start, slide.end(), &slide, TOLERANCE);
    assert!(check.is_sound(), "{:?}", check.violations.first());
    let slid = before.elapsed();
    let chords = round(0, 9_900, 100);
    let before = Instant::now();
    let check = checker.check(chords.start, chords.end(), &chords, TOLERANCE);
    assert_eq!(check.violations.len(), VIOLATION_LIMIT);
    println!("built in {built:?}, slid in {slid:?}, cut in {:?}", before.elapsed());
    assert!(built.as_secs() < 60 && slid.as_secs() < 60 && before.elapsed().as_secs() < 60);
}
