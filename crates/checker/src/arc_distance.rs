//! Distance between a step and an edge, straight or circular, and where on the step it is reached.
//!
//! The least distance lies at an end of either curve, where both cross, or on a common normal; a normal of a
//! circle runs through its centre. Every such place on the step is tried. Cost: constant.

use crate::curve::{Curve, right_of};
use traverse_geometry::Point;

/// How near a step comes to an edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Millimetres.
    pub(crate) distance: f64,
    /// The place on the step.
    pub(crate) at: Point,
}

/// How near `step` comes to `edge`.
pub(crate) fn nearest(step: &Curve, edge: &Curve) -> Nearest {
    let mut best = Nearest { distance: f64::INFINITY, at: step.start() };
    for fraction in places(step, edge) {
        let at = step.point_at(fraction);
        let distance = edge.distance_to_point(at);
        if distance < best.distance {
            best = Nearest { distance, at };
        }
    }
    best
}

/// Fractions of the step, among them every one where the distance to the edge is locally least.
pub(crate) fn places(step: &Curve, edge: &Curve) -> Vec<f64> {
    let mut places = vec![0.0, 1.0, step.nearest_fraction(edge.start()), step.nearest_fraction(edge.end())];
    match (step, edge) {
        (_, Curve::Straight(edge)) => {
            let normal = right_of(edge.direction());
            step.cut_by_line(edge.a, normal, 0.0, &mut places);
            step.cut_by_direction(normal, &mut places);
        }
        (Curve::Straight(_), Curve::Circular(edge)) => {
            places.push(step.nearest_fraction(edge.center));
            step.cut_by_circle(edge.center, edge.radius, &mut places);
        }
        (Curve::Circular(arc), Curve::Circular(edge)) => {
            step.cut_by_direction(edge.center - arc.center, &mut places);
            step.cut_by_circle(edge.center, edge.radius, &mut places);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn curve() -> impl Strategy<Value = Curve> {
        let coordinate = || -10.0..10.0_f64;
        let bulge = prop_oneof![Just(0.0), Just(1.0), Just(-1.0), -1.0..1.0_f64];
        (coordinate(), coordinate(), coordinate(), coordinate(), bulge).prop_map(|(ax, ay, bx, by, bulge)| {
            Curve::from_bulge(Point::new(ax, ay), Point::new(bx, by), bulge)
        })
    }

    fn sampled(one: &Curve, other: &Curve) -> f64 {
        const COUNT: i32 = 4000;
        (0..=COUNT)
            .map(|i| other.distance_to_point(one.point_at(f64::from(i) / f64::from(COUNT))))
            .fold(f64::INFINITY, f64::min)
    }

    /// The nearest of many points of the curve: no projection in it.
    fn sampled_to_point(curve: &Curve, p: Point) -> f64 {
        const COUNT: i32 = 4000;
        (0..=COUNT)
            .map(|i| (curve.point_at(f64::from(i) / f64::from(COUNT)) - p).norm())
            .fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn distance_agrees_with_dense_sampling(step in curve(), edge in curve()) {
            let found = nearest(&step, &edge);
            let dense = sampled(&step, &edge);
            prop_assert!(found.distance <= dense + 1e-12, "{} > {dense}", found.distance);
            let spacing = step.length() / 4000.0;
            prop_assert!(found.distance >= dense - spacing, "{} < {dense} by more than {spacing}", found.distance);
            prop_assert!((edge.distance_to_point(found.at) - found.distance).abs() < 1e-12);
        }

        #[test]
        fn distance_is_symmetric(step in curve(), edge in curve()) {
            prop_assert!((nearest(&step, &edge).distance - nearest(&edge, &step).distance).abs() < 1e-9);
        }

        #[test]
        fn distance_to_a_point_agrees_with_dense_sampling(curve in curve(), x in -12.0..12.0_f64, y in -12.0..12.0_f64) {
            let p = Point::new(x, y);
            let (found, dense) = (curve.distance_to_point(p), sampled_to_point(&curve, p));
            prop_assert!(found <= dense + 1e-12);
            prop_assert!(found >= dense - curve.length() / 4000.0);
            let at = curve.point_at(curve.nearest_fraction(p));
            prop_assert!(((at - p).norm() - found).abs() < 1e-9);
        }

        #[test]
        fn geometry_and_checker_agree(a in curve(), b in curve(), x in -12.0..12.0_f64) {
            // Both edges of a ring of two: whatever geometry derives from the same numbers.
            let p = Point::new(x, x / 3.0);
            prop_assume!((a.start() - a.end()).norm() > 1e-3);
            let bulge = match a { Curve::Straight(_) => 0.0, Curve::Circular(c) => c.turn * (c.half / 2.0).tan() };
            let edge = traverse_geometry::Edge::from_bulge(a.start(), a.end(), bulge);
            prop_assert!((edge.distance_to_point(p) - a.distance_to_point(p)).abs() < 1e-6);
            prop_assert!((edge.length() - a.length()).abs() < 1e-6);
            let _ = b;
        }

        #[test]
        fn parts_within_reach_agree_with_sampling(one in curve(), other in curve(), reach in 0.01..3.0_f64) {
            let parts = one.parts_within(&other, reach);
            for i in 0..=500 {
                let fraction = f64::from(i) / 500.0;
                let distance = other.distance_to_point(one.point_at(fraction));
                let inside = parts.iter().any(|part| part.0 <= fraction && fraction <= part.1);
                if (distance - reach).abs() > 1e-6 {
                    prop_assert_eq!(inside, distance < reach, "at {} of {:?}", fraction, parts);
                }
            }
        }
    }

    #[test]
    fn a_huge_circle_is_touched_within_a_hundredth_of_a_nanometre() {
        let edge = Curve::from_bulge(Point::new(0.0, 0.0), Point::new(1000.0, 0.0), 1e-3);
        let Curve::Circular(arc) = edge else { unreachable!("a bulge makes an arc") };
        let top = arc.center + arc.middle * arc.radius;
        let step = Curve::straight(top + Point::new(-50.0, -2.0).coords, top + Point::new(50.0, -2.0).coords);
        assert!((nearest(&step, &edge).distance - 2.0).abs() < 1e-8);
    }
}
