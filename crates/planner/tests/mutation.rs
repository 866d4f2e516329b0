//! Keeps the checker honest: what the planner answers is accepted, and refused as soon as one vertex, centre or end
//! of it is shifted by ten tolerances to the wrong side.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{disc, mitred, point, query, scene, stars};
use traverse_checker::check_rapid_move;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Path, Point, Scene, Vector, cross, left_of};
use traverse_planner::{Answer, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

const SHIFT_MM: f64 = 10.0 * CONTACT_TOLERANCE_MM;

/// Every shift of one vertex, centre or end of the path to the wrong side.
fn mutations(path: &Path) -> Vec<(String, Path)> {
    let edges: Vec<Edge> = path.edges().collect();
    let mut mutated = Vec::new();
    let mut add = |what: String, change: &dyn Fn(&mut Path)| {
        let mut path = path.clone();
        change(&mut path);
        mutated.push((what, path));
    };
    for (i, pair) in edges.windows(2).enumerate() {
        let inwards = inwards(&pair[0], &pair[1]);
        add(format!("vertex {i}"), &|path| path.steps[i].end += inwards * SHIFT_MM);
    }
    for (i, step) in path.steps.iter().enumerate() {
        // A centre that moves along the chord sets both radii apart, by twice the sine of half the sweep. On an arc
        // so short that this stays within a tolerance nothing of the path has moved.
        if let Some(arc) = step.arc.filter(|arc| arc.sweep.abs() > 0.25) {
            let along = (edges[i].end() - edges[i].start()).normalize();
            for by in [along, -along] {
                let center = arc.center + by * SHIFT_MM;
                add(format!("centre {i}"), &move |path| {
                    if let Some(arc) = &mut path.steps[i].arc {
                        arc.center = center;
                    }
                });
            }
        }
    }
    for by in [Vector::x(), Vector::y(), -Vector::x(), -Vector::y()] {
        add("start".into(), &|path| path.start += by * SHIFT_MM);
        add("end".into(), &|path| {
            if let Some(last) = path.steps.last_mut() {
                last.end += by * SHIFT_MM;
            }
        });
    }
    mutated
}

/// Towards what the path bends round where both edges meet.
fn inwards(before: &Edge, after: &Edge) -> Vector {
    let toward = |edge: &Edge, at: Point| match edge {
        Edge::Arc(arc) => Some((arc.center - at).normalize()),
        Edge::Segment(_) => None,
    };
    let at = before.end();
    toward(before, at).or_else(|| toward(after, at)).unwrap_or_else(|| {
        let (arriving, leaving) = (before.direction_at(1.0), after.direction_at(0.0));
        let side = cross(arriving, leaving).signum();
        ((left_of(arriving) + left_of(leaving)) * side).normalize()
    })
}

fn accepted(scene: &Scene, start: Point, target: Point, path: &Path) -> bool {
    check_rapid_move(scene, start, target, path, CONTACT_TOLERANCE_MM).violations.is_empty()
}

#[test]
fn every_shift_to_the_wrong_side_is_refused() {
    let (mut paths, mut shifts) = (0, 0);
    for case in 0..120 {
        let mut random = Seed(11).part(case).stream();
        let mut shapes = stars(&mut random, 6, 100.0, 14.0);
        shapes.extend((0..3).map(|_| {
            disc(
                random.random_range(0.0..100.0),
                random.random_range(0.0..100.0),
                random.random_range(3.0..9.0),
            )
        }));
        let base = scene(shapes, [0.0, 0.8, 2.5][case as usize % 3]);
        let scene = if case % 2 == 0 { base } else { mitred(base) };
        let (start, target) =
            (point(-20.0, random.random_range(0.0..100.0)), point(120.0, random.random_range(0.0..100.0)));
        let Ok((Answer::Plan(plan), _)) =
            plan_rapid_move(&scene, &query(start, target), &Budget::unlimited(), &mut Silent)
        else {
            continue;
        };
        support::assert_sound(&scene, start, target, &plan);
        paths += 1;
        for (what, path) in mutations(&plan.path) {
            shifts += 1;
            assert!(
                !accepted(&scene, start, target, &path),
                "case {case}: {what} was shifted unseen: {path:?}\n{scene:?}"
            );
        }
    }
    assert!(paths > 80 && shifts > 1000, "{paths} paths, {shifts} shifts");
}
