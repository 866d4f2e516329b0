//! Places on a curve between which it is fitted.

use super::Smooth;
use traverse_geometry::{Point, Vector};

/// A place on a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub(super) t: f64,
    pub(super) point: Point,
    derivative: Vector,
}

/// A derivative shorter than this share of the mean speed has no direction of its own.
const VANISHED: f64 = 1e-9;

/// Where the derivative vanishes, the direction is that of the chord over this share of the piece.
const NEARBY: f64 = 1e-4;

impl Station {
    /// The place at `t`; none when it is not finite.
    pub(super) fn at(curve: &impl Smooth, t: f64) -> Option<Self> {
        let (point, derivative) = curve.at(t);
        // Squares must be finite too.
        (point.coords.norm_squared() + derivative.norm_squared()).is_finite().then_some(Self {
            t,
            point,
            derivative,
        })
    }
}

/// Directions of travel at both ends of a piece, as unit vectors; none when the piece shows none.
pub(super) fn end_directions(
    curve: &impl Smooth,
    from: &Station,
    middle: &Station,
    to: &Station,
) -> Option<(Vector, Vector)> {
    let span = to.t - from.t;
    let speed = ((middle.point - from.point).norm() + (to.point - middle.point).norm()) / span;
    let direction = |end: &Station, chord: &dyn Fn() -> Vector| {
        let norm = end.derivative.norm();
        if norm > VANISHED * speed {
            return Some(end.derivative / norm);
        }
        chord().try_normalize(0.0)
    };
    let departure = direction(from, &|| curve.point(from.t + NEARBY * span) - from.point)?;
    let arrival = direction(to, &|| to.point - curve.point(to.t - NEARBY * span))?;
    Some((departure, arrival))
}
