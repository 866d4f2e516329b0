//! Common tangents of two circles, each on a chosen side of the way; points are circles of radius 0.
//!
//! With the signed radius ρ (positive where the circle lies on the left) and n the left normal of the direction of
//! travel, a circle touches the line where (centre − point) · n = ρ. So (c2 − c1) · n = ρ2 − ρ1: the tangent exists
//! iff |ρ2 − ρ1| does not exceed the distance d of the centres, and is sqrt(d² − (ρ2 − ρ1)²) long: the outer one
//! for equal sides, the inner one for different ones.

use traverse_geometry::{CONTACT_TOLERANCE_MM, Point, Vector, cross, left_of};

/// No direction is known better than this, radians.
const LEAST_ANGLE_ERROR_RAD: f64 = 1e-13;

/// A directed common tangent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent {
    /// Where it leaves the first circle.
    pub(crate) from: Point,
    /// Where it reaches the second circle.
    pub(crate) to: Point,
    /// Left normal of its direction.
    pub(crate) normal: Vector,
    /// Millimetres.
    pub(crate) length: f64,
    /// How far the normal may be off by rounding, radians.
    pub(crate) angle_error: f64,
}

impl Tangent {
    /// From a point to itself.
    pub(crate) fn nowhere(at: Point) -> Self {
        Self { from: at, to: at, normal: Vector::zeros(), length: 0.0, angle_error: 0.0 }
    }

    /// By which angle `other`, which hardly differs, turns counter-clockwise from this one, radians.
    pub(crate) fn angle_to(&self, other: &Self) -> f64 {
        cross(self.normal, other.normal).atan2(self.normal.dot(&other.normal))
    }

    /// From one point to another, where the direction is known better than from both.
    pub(crate) fn along(from: Point, to: Point, normal: Vector) -> Self {
        Self { from, to, normal, length: (to - from).norm(), angle_error: LEAST_ANGLE_ERROR_RAD }
    }

    /// The tangent from the circle at `c1` to the circle at `c2` with signed radii. None: the circles lie inside
    /// each other, or overlap where an inner tangent is asked for, by more than the contact tolerance; or the
    /// centres are the same.
    pub(crate) fn between(c1: Point, rho1: f64, c2: Point, rho2: f64) -> Option<Self> {
        let axis = c2 - c1;
        let distance = axis.norm();
        let across = rho2 - rho1;
        if distance == 0.0 || across.abs() > distance + CONTACT_TOLERANCE_MM {
            return None;
        }
        let axis = axis / distance;
        let length = ((distance - across) * (distance + across)).max(0.0).sqrt();
        let sine = (across / distance).clamp(-1.0, 1.0);
        let normal = axis * sine + left_of(axis) * (length / distance);
        let normal = normal.try_normalize(0.0)?;
        let magnitude = c1.coords.amax().max(c2.coords.amax()).max(rho1.abs()).max(rho2.abs());
        // The distance of the centres may be off by this much. Where the circles nearly touch from inside, or a point nearly
        // lies on one, the direction is known by the root of it only.
        let off = 16.0 * f64::EPSILON * magnitude;
        let angle_error =
            if length * length > off * distance { off / length } else { (off / distance).sqrt() };
        Some(Self {
            from: c1 - normal * rho1,
            to: c2 - normal * rho2,
            normal,
            length,
            angle_error: LEAST_ANGLE_ERROR_RAD + angle_error,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touches_both_circles_on_the_sides_asked_for() {
        let (c1, c2) = (Point::new(1.0, 2.0), Point::new(11.0, 5.0));
        for rho1 in [-2.0, 0.0, 2.0] {
            for rho2 in [-3.0, 0.0, 3.0] {
                let tangent = Tangent::between(c1, rho1, c2, rho2).unwrap();
                let along = (tangent.to - tangent.from).normalize();
                for (center, rho) in [(c1, rho1), (c2, rho2)] {
                    let offset = left_of(along).dot(&(center - tangent.from));
                    assert!((offset - rho).abs() < 1e-12, "{rho1} {rho2}: {offset}");
                }
                assert!(((tangent.to - tangent.from).norm() - tangent.length).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn circles_that_overlap_have_no_inner_tangent_and_nested_ones_none() {
        let (c1, c2) = (Point::new(0.0, 0.0), Point::new(3.0, 0.0));
        assert!(Tangent::between(c1, 2.0, c2, -2.0).is_none());
        assert!(Tangent::between(c1, 9.0, c2, 2.0).is_none());
        assert!(Tangent::between(c1, 2.0, c2, 2.0).is_some());
    }
}
