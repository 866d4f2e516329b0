//! Paths that touch tightly, each vertex, centre and end shifted by ten tolerances to the wrong side: refused.
//!
//! Arcs here turn by 0.3 rad at least: on an arc that turns by less than about 0.1 rad, a centre shifted by ten
//! tolerances moves the path itself by less than one, which is no violation.

use crate::making::*;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use traverse_checker::RapidMoveChecker;
use traverse_geometry::{Path, PathArc, PathStep, Point, Scene};

type Vector = nalgebra::Vector2<f64>;

const SHIFT: f64 = 10.0 * TOLERANCE;

fn unit(angle: f64) -> Vector {
    Vector::new(angle.cos(), angle.sin())
}

/// A taut path that turns counter-clockwise round circles (radius 0: points): tangent, arc, tangent, …
fn taut(start: Point, circles: &[(Point, f64)], target: Point) -> Path {
    // Points count as circles of radius 0, so one formula serves every tangent.
    let all: Vec<(Point, f64)> =
        std::iter::once((start, 0.0)).chain(circles.iter().copied()).chain([(target, 0.0)]).collect();
    let tangents: Vec<(Point, Point)> = all
        .windows(2)
        .map(|pair| {
            let ((c1, r1), (c2, r2)) = (pair[0], pair[1]);
            let axis = c2 - c1;
            // Outer tangent with both circles on its left: its right normal n has n · axis = r1 − r2 … seen from the right.
            let angle = axis.y.atan2(axis.x) - PI / 2.0;
            let lean = ((r1 - r2) / axis.norm()).asin();
            let normal = unit(angle + lean);
            (c1 + normal * r1, c2 + normal * r2)
        })
        .collect();
    let mut path = Path::at(start);
    for (i, &(center, radius)) in circles.iter().enumerate() {
        let (arrive, leave) = (tangents[i].1, tangents[i + 1].0);
        path.steps.push(PathStep { end: arrive, arc: None, z_mm: None });
        if radius > 0.0 {
            let (from, to) = (arrive - center, leave - center);
            let sweep = (from.x * to.y - from.y * to.x).atan2(from.dot(&to)).rem_euclid(TAU);
            path.steps.push(PathStep { end: leave, arc: Some(PathArc { center, sweep }), z_mm: None });
        }
    }
    path.steps.push(PathStep { end: target, arc: None, z_mm: None });
    path
}

/// The path is accepted, and refused with any one of its inner vertices or centres shifted. `inward` points from
/// vertex i into what the path touches there.
fn check_mutations(scene: &Scene, path: &Path, inward: &[Vector]) {
    let checker = RapidMoveChecker::new(scene);
    let check = |path: &Path| checker.check(path.start, path.end(), path, TOLERANCE);
    let sound = check(path);
    assert!(sound.is_sound(), "the taut path was refused: {:#?}", sound.violations);
    let margin = sound.smallest_margin_mm.expect("there is an obstacle");
    assert!(margin.abs() < TOLERANCE, "the path does not touch: {margin}");
    for (i, &inward) in inward.iter().enumerate() {
        let mut shifted = path.clone();
        shifted.steps[i].end += inward * SHIFT;
        assert!(!check(&shifted).is_sound(), "vertex {i} was shifted unseen");
        // An arc that keeps its distances while its end moves: the centre moves too.
        for step in [i, i + 1] {
            if let Some(arc) = &mut shifted.steps[step].arc {
                arc.center += inward * SHIFT;
            }
        }
        assert!(!check(&shifted).is_sound(), "vertex {i} and its centre were shifted unseen");
    }
    for i in 0..path.steps.len() {
        if path.steps[i].arc.is_some() {
            for direction in 0..8 {
                let mut shifted = path.clone();
                let arc = shifted.steps[i].arc.as_mut().expect("it was there");
                arc.center += unit(f64::from(direction) * PI / 4.0) * SHIFT;
                assert!(!check(&shifted).is_sound(), "centre {i} was shifted unseen, direction {direction}");
            }
            for by in [SHIFT, -SHIFT] {
                let mut shifted = path.clone();
                let arc = shifted.steps[i].arc.as_mut().expect("it was there");
                let radius = (path.steps[i].end - arc.center).norm();
                arc.sweep += by / radius;
                assert!(!check(&shifted).is_sound(), "sweep {i} was changed unseen");
            }
        }
    }
    for (start, end) in [(SHIFT, 0.0), (0.0, SHIFT)] {
        let moved = Vector::new(1.0, 0.0);
        let check = checker.check(path.start + moved * start, path.end() + moved * end, path, TOLERANCE);
        assert_eq!(check.violations.len(), 1);
    }
}

/// For every inner vertex of a path: towards the centre of the circle that it lies on.
fn towards(path: &Path, circles: &[(Point, f64)]) -> Vec<Vector> {
    let inner = &path.steps[..path.steps.len() - 1];
    inner
        .iter()
        .map(|step| {
            let nearest = |&&(center, radius): &&(Point, f64)| ((step.end - center).norm() - radius).abs();
            let (center, _) = circles
                .iter()
                .min_by(|one, other| nearest(one).total_cmp(&nearest(other)))
                .expect("there is a circle");
            (center - step.end).normalize()
        })
        .collect()
}

/// Circles that a taut path turns left round, one after the other, with plenty of room.
fn bends() -> impl Strategy<Value = (Point, f64)> {
    ((-20_000.0..20_000.0_f64, -20_000.0..20_000.0_f64), 0.0..TAU)
        .prop_map(|((x, y), angle)| (p(x, y), angle))
}

proptest! {
    #[test]
    fn round_discs((at, angle) in bends(), radius in 0.5..20.0_f64, clearance in prop_oneof![Just(0.0), 0.01..10.0_f64], lean in 0.4..1.2_f64) {
        let scene = scene(clearance, vec![disc(at.x, at.y, radius)]);
        let circles = [(at, radius + clearance)];
        let path = taut(at + unit(angle) * 80.0, &circles, at + unit(angle + PI + lean) * 90.0);
        check_mutations(&scene, &path, &towards(&path, &circles));
    }

    #[test]
    fn round_two_discs((at, angle) in bends(), r1 in 0.5..10.0_f64, r2 in 0.5..10.0_f64, clearance in prop_oneof![Just(0.0), 0.01..5.0_f64]) {
        let other = at + unit(angle) * 40.0;
        let scene = scene(clearance, vec![disc(at.x, at.y, r1), disc(other.x, other.y, r2)]);
        let circles = [(at, r1 + clearance), (other, r2 + clearance)];
        let path = taut(at + unit(angle + 2.0) * 70.0, &circles, other + unit(angle + 1.2) * 70.0);
        check_mutations(&scene, &path, &towards(&path, &circles));
    }

    #[test]
    fn round_the_corner_of_a_wedge((at, angle) in bends(), opening in 0.1..2.0_f64, clearance in 0.01..10.0_f64) {
        // The tip at `at`, the wedge towards `angle`.
        let (a, b) = (at + unit(angle - opening / 2.0) * 50.0, at + unit(angle + opening / 2.0) * 50.0);
        let scene = scene(clearance, vec![ring(&[(at.x, at.y), (a.x, a.y), (b.x, b.y)])]);
        let circles = [(at, clearance)];
        let start = at + unit(angle + opening / 2.0 + 0.5) * 60.0;
        let target = at + unit(angle - opening / 2.0 - 0.5) * 60.0;
        let path = taut(start, &circles, target);
        check_mutations(&scene, &path, &towards(&path, &circles));
    }

    #[test]
    fn on_the_corner_of_a_wedge_at_clearance_0((at, angle) in bends(), opening in 0.1..2.5_f64) {
        let (a, b) = (at + unit(angle - opening / 2.0) * 50.0, at + unit(angle + opening / 2.0) * 50.0);
        let scene = scene(0.0, vec![ring(&[(at.x, at.y), (a.x, a.y), (b.x, b.y)])]);
        let across = line(&[
            (at.x + 30.0 * (angle + 1.55).cos(), at.y + 30.0 * (angle + 1.55).sin()),
            (at.x, at.y),
            (at.x + 30.0 * (angle - 1.55).cos(), at.y + 30.0 * (angle - 1.55).sin()),
        ]);
        check_mutations(&scene, &across, &[unit(angle)]);
    }

    #[test]
    fn over_a_mitred_corner((at, angle) in bends(), opening in 0.3..2.5_f64, clearance in 0.01..10.0_f64) {
        let (a, b) = (at + unit(angle - opening / 2.0) * 500.0, at + unit(angle + opening / 2.0) * 500.0);
        let scene = mitred(scene(clearance, vec![ring(&[(at.x, at.y), (a.x, a.y), (b.x, b.y)])]), None);
        let control = at - unit(angle) * (clearance / (opening / 2.0).sin());
        let ends = [control + unit(angle + opening / 2.0) * 20.0, control + unit(angle - opening / 2.0) * 20.0];
        // Along both parallels, and past the control point alone.
        let along = line(&[(ends[0].x, ends[0].y), (control.x, control.y), (ends[1].x, ends[1].y)]);
        check_mutations(&scene, &along, &[unit(angle)]);
        let past = [control + unit(angle + 1.5) * 20.0, control + unit(angle - 1.5) * 20.0];
        let past = line(&[(past[0].x, past[0].y), (control.x, control.y), (past[1].x, past[1].y)]);
        check_mutations(&scene, &past, &[unit(angle)]);
    }

    #[test]
    fn inside_a_work_area((at, angle) in bends(), clearance in 0.01..10.0_f64) {
        // The area turns round the tip of a wedge that bites into it: the same corner from the other side.
        let corner = |turn: f64, far: f64| at + unit(angle + turn) * far;
        let around: Vec<_> = [(0.4, 100.0), (1.5, 150.0), (2.6, 150.0), (3.7, 150.0), (4.8, 150.0), (TAU - 0.4, 100.0)]
            .iter()
            .map(|&(turn, far)| { let q = corner(turn, far); (q.x, q.y) })
            .chain([(at.x, at.y)])
            .collect();
        let mut scene = scene(clearance, vec![]);
        scene.work_area = Some(polygon(ring(&around), vec![]));
        let circles = [(at, clearance)];
        let path = taut(corner(0.9, 50.0), &circles, corner(-0.9, 50.0));
        check_mutations(&scene, &path, &towards(&path, &circles));
        let scene = mitred(scene, None);
        let control = at - unit(angle) * (clearance / 0.4_f64.sin());
        let ends = [control + unit(angle + 0.4) * 20.0, control + unit(angle - 0.4) * 20.0];
        let along = line(&[(ends[0].x, ends[0].y), (control.x, control.y), (ends[1].x, ends[1].y)]);
        check_mutations(&scene, &along, &[unit(angle)]);
    }
}
