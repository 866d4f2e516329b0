//! A curve that has a direction everywhere.

use traverse_geometry::{Point, Vector};

/// A curve without corners, run through from t = 0 to t = 1. Its derivative may vanish, best at the ends only.
pub(crate) trait Smooth {
    /// The point at `t`.
    fn point(&self, t: f64) -> Point;

    /// The derivative by `t`.
    fn derivative(&self, t: f64) -> Vector;
}

/// A derivative shorter than this share of the mean speed has no direction of its own.
const VANISHED: f64 = 1e-9;

/// Where the derivative vanishes, the direction is that of the chord over this share of the piece.
const NEARBY: f64 = 1e-4;

/// Directions of travel at both ends of a piece, as unit vectors; none when the piece shows none.
pub(super) fn end_directions(curve: &dyn Smooth, from: f64, to: f64) -> Option<(Vector, Vector)> {
    let span = to - from;
    let middle = curve.point(from + span / 2.0);
    let speed = ((middle - curve.point(from)).norm() + (curve.point(to) - middle).norm()) / span;
    let direction = |at: f64, chord_from: f64, chord_to: f64| {
        let derivative = curve.derivative(at);
        if derivative.norm() > VANISHED * speed {
            return derivative.try_normalize(0.0);
        }
        (curve.point(chord_to) - curve.point(chord_from)).try_normalize(0.0)
    };
    Some((direction(from, from, from + NEARBY * span)?, direction(to, to - NEARBY * span, to)?))
}
