//! Turned, mirrored and reordered scenes give the same answer.

use crate::making::*;
use proptest::prelude::*;
use traverse_geometry::{Path, PathStep, Point, Polygon, Ring, Scene};

/// A quarter turn or a mirror image: both exact.
fn moved(p: Point, mirror: bool) -> Point {
    if mirror { Point::new(-p.x, p.y) } else { Point::new(-p.y, p.x) }
}

fn moved_ring(ring: &Ring, mirror: bool, first: usize, back: bool) -> Ring {
    let mut vertices: Vec<Point> = ring.vertices().iter().map(|&q| moved(q, mirror)).collect();
    let sign = if mirror { -1.0 } else { 1.0 };
    let mut bulges: Vec<f64> = ring.bulges().iter().map(|bulge| sign * bulge).collect();
    let count = vertices.len();
    vertices.rotate_left(first % count);
    if !bulges.is_empty() {
        bulges.rotate_left(first % count);
    }
    let ring = Ring::new(vertices, bulges).expect("still valid");
    if back { ring.reversed() } else { ring }
}

fn ring_of_any_kind() -> impl Strategy<Value = Ring> {
    let size = 1..6_i32;
    (-12..12_i32, -12..12_i32, size.clone(), size, 0..4).prop_map(|(x, y, w, h, kind)| {
        let (x, y, w, h) = (f64::from(x), f64::from(y), f64::from(w), f64::from(h));
        match kind {
            0 => rectangle(x, y, x + w, y + h),
            1 => disc(x, y, w),
            2 => ring(&[(x, y), (x + w, y), (x, y + h)]),
            _ => bulged(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)], &[0.5, 0.0, -0.25, 0.0]),
        }
    })
}

proptest! {
    #[test]
    fn the_answer_does_not_depend_on_the_point_of_view(
        rings in proptest::collection::vec(ring_of_any_kind(), 1..6),
        stops in proptest::collection::vec((-15..15_i32, -15..15_i32), 2..6),
        clearance in prop_oneof![Just(0.0), Just(1.0), 0.1..3.0_f64],
        miter in any::<bool>(),
        mirror in any::<bool>(),
        first in 0..4_usize,
        back in any::<bool>(),
        area in any::<bool>(),
    ) {
        let build = |rings: Vec<Ring>, border: Ring| {
            let mut scene = scene(clearance, rings);
            if area {
                scene.work_area = Some(Polygon::from_ring(border));
            }
            if miter { mitred(scene, Some(4.0)) } else { scene }
        };
        let border = rectangle(-14.0, -14.0, 14.0, 14.0);
        let one: Scene = build(rings.clone(), border.clone());
        let turned = rings.iter().map(|ring| moved_ring(ring, mirror, first, back)).collect();
        let other: Scene = build(turned, moved_ring(&border, mirror, first, back));
        let path = line(&stops.iter().map(|&(x, y)| (f64::from(x), f64::from(y))).collect::<Vec<_>>());
        let turned = Path {
            start: moved(path.start, mirror),
            start_z_mm: None,
            steps: path.steps.iter().map(|step| PathStep { end: moved(step.end, mirror), arc: None, z_mm: None }).collect(),
        };
        let (here, there, back_again) = (check(&one, &path), check(&other, &turned), check(&one, &path.reversed()));
        prop_assert!((here.cost - there.cost).abs() < 1e-9);
        let count = |check: &traverse_checker::PathCheck| {
            let mut all: Vec<_> = check.violations.iter().map(|v| (v.reason.as_str(), v.obstacle.clone())).collect();
            all.sort();
            all
        };
        prop_assert_eq!(here.is_sound(), back_again.is_sound(), "{:#?} {:#?}", here, back_again);
        prop_assert_eq!(here.is_sound(), there.is_sound(), "{:#?} {:#?}", here, there);
        if clearance > 0.0 {
            prop_assert_eq!(count(&here), count(&there));
            let difference = here.smallest_margin_mm.expect("obstacles") - there.smallest_margin_mm.expect("obstacles");
            prop_assert!(difference.abs() < 1e-9, "{:?} {:?}", here, there);
        }
    }

    #[test]
    fn margins_agree_with_dense_sampling(
        rings in proptest::collection::vec(ring_of_any_kind(), 1..6),
        stops in proptest::collection::vec((-15.0..15.0_f64, -15.0..15.0_f64), 2..4),
        clearance in 0.1..3.0_f64,
    ) {
        let scene = scene(clearance, rings);
        let path = line(&stops);
        let found = check(&scene, &path);
        let mut least = f64::INFINITY;
        let mut longest = 0.0_f64;
        for edge in path.edges() {
            longest = longest.max(edge.length());
            for i in 0..=400 {
                let at = edge.point_at(f64::from(i) / 400.0);
                for obstacle in &scene.obstacles {
                    let outer = obstacle.shape.outer();
                    let distance = outer.edges().map(|e| e.distance_to_point(at)).fold(f64::INFINITY, f64::min);
                    // A polygon of many corners tells inside from outside by its winding.
                    let flat: Vec<Point> = outer.edges().flat_map(|e| (0..64).map(move |k| e.point_at(f64::from(k) / 64.0))).collect();
                    let mut odd = false;
                    for (k, a) in flat.iter().enumerate() {
                        let b = flat[(k + 1) % flat.len()];
                        if (a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x {
                            odd = !odd;
                        }
                    }
                    least = least.min(if odd { -distance } else { distance } - clearance);
                }
            }
        }
        let margin = found.smallest_margin_mm.expect("there are obstacles");
        if least > -clearance + 0.1 {
            prop_assert!(margin <= least + 1e-9, "{margin} {least}");
            prop_assert!(margin >= least - longest / 400.0, "{margin} {least}");
        } else {
            // Depth is sampled.
            prop_assert!((margin - least).abs() < longest / 9.0 + 0.1, "{margin} {least}");
        }
        prop_assert_eq!(found.is_sound(), margin >= -TOLERANCE);
    }
}
