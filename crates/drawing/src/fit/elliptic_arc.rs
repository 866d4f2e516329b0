//! An arc of an ellipse.

use super::Smooth;
use std::f64::consts::TAU;
use traverse_geometry::{Point, Vector};

/// An arc of an ellipse: centre + first · cos θ + second · sin θ, with θ from `start` on over `sweep`.
///
/// The two half axes are conjugate: an affine map of a circle's arc maps its centre and both spokes. They need not be
/// at right angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EllipticArc {
    /// Centre of the ellipse, millimetres.
    pub(crate) center: Point,
    /// From the centre to the point of θ = 0.
    pub(crate) first: Vector,
    /// From the centre to the point of θ = π/2.
    pub(crate) second: Vector,
    /// Where θ begins, radians.
    pub(crate) start: f64,
    /// How far θ runs, radians, either way. One turn and more ends exactly where it began.
    pub(crate) sweep: f64,
}

impl EllipticArc {
    fn angle(&self, t: f64) -> f64 {
        if t >= 1.0 && self.sweep.abs() >= TAU { self.start } else { self.start + self.sweep * t }
    }
}

impl Smooth for EllipticArc {
    fn point(&self, t: f64) -> Point {
        self.at(t).0
    }

    fn at(&self, t: f64) -> (Point, Vector) {
        let (sin, cos) = self.angle(t).sin_cos();
        let point = self.center + self.first * cos + self.second * sin;
        (point, (self.second * cos - self.first * sin) * self.sweep)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn a_full_ellipse_ends_where_it_began() {
        for start in [0.0, 0.3, -5.0] {
            for sweep in [TAU, -TAU] {
                let arc = EllipticArc {
                    center: Point::new(100.0, 7.0),
                    first: Vector::new(3.0, 1.0),
                    second: Vector::new(0.5, 2.0),
                    start,
                    sweep,
                };
                assert_eq!(arc.point(0.0), arc.point(1.0));
                assert!((arc.point(0.5) - arc.center + (arc.point(0.0) - arc.center)).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn points_and_derivatives_are_those_of_the_ellipse() {
        let arc = EllipticArc {
            center: Point::new(1.0, 2.0),
            first: Vector::new(4.0, 0.0),
            second: Vector::new(0.0, 3.0),
            start: FRAC_PI_2,
            sweep: PI,
        };
        assert!((arc.point(0.0) - Point::new(1.0, 5.0)).norm() < 1e-12);
        assert!((arc.point(0.5) - Point::new(-3.0, 2.0)).norm() < 1e-12);
        assert!((arc.at(0.5).1 - Vector::new(0.0, -3.0 * PI)).norm() < 1e-12);
    }
}
