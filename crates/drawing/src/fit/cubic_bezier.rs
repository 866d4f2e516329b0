//! A cubic Bézier curve.

use super::Smooth;
use traverse_geometry::{Point, Vector};

/// A cubic Bézier curve by its control points, millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CubicBezier {
    /// Start, first and second control point, end.
    pub(crate) points: [Point; 4],
}

impl CubicBezier {
    /// The curve of these control points.
    pub(crate) fn new(start: Point, first: Point, second: Point, end: Point) -> Self {
        Self { points: [start, first, second, end] }
    }

    /// The same curve as the quadratic one with one control point.
    pub(crate) fn from_quadratic(start: Point, control: Point, end: Point) -> Self {
        let towards_control = |p: Point| p + (control - p) * (2.0 / 3.0);
        Self::new(start, towards_control(start), towards_control(end), end)
    }
}

impl Smooth for CubicBezier {
    /// By de Casteljau's steps: exact at both ends.
    fn point(&self, t: f64) -> Point {
        self.at(t).0
    }

    fn at(&self, t: f64) -> (Point, Vector) {
        let [a, b, c, d] = self.points;
        let mix = |p: Point, q: Point| Point::from(p.coords * (1.0 - t) + q.coords * t);
        let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
        let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
        (mix(abc, bcd), (bcd - abc) * 3.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_exact_and_the_derivative_is_the_limit_of_chords() {
        let curve = CubicBezier::new(
            Point::new(0.1, 0.7),
            Point::new(3.3, 8.1),
            Point::new(-5.2, 2.0),
            Point::new(9.9, -0.3),
        );
        assert_eq!((curve.point(0.0), curve.point(1.0)), (curve.points[0], curve.points[3]));
        for i in 1..20 {
            let t = f64::from(i) / 20.0;
            let chord = (curve.point(t + 1e-5) - curve.point(t - 1e-5)) / 2e-5;
            assert!((chord - curve.at(t).1).norm() < 1e-6, "{t}");
        }
    }

    #[test]
    fn a_quadratic_curve_is_a_cubic_one() {
        let (start, control, end) = (Point::new(0.0, 0.0), Point::new(4.0, 8.0), Point::new(9.0, 1.0));
        let cubic = CubicBezier::from_quadratic(start, control, end);
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let s = 1.0 - t;
            let point = start.coords * (s * s) + control.coords * (2.0 * s * t) + end.coords * (t * t);
            assert!((cubic.point(t).coords - point).norm() < 1e-12);
        }
    }
}
