//! Two arcs that have given directions at their outer ends and one direction where they meet.

use super::Smooth;
use traverse_geometry::{Point, Vector, cross};

/// Halvings in the search for the joint: to the last bits of a double.
const HALVINGS: usize = 44;

/// The bulge of the arc over `chord` that sets out in direction `departure`: half the sweep lies between them.
pub(super) fn departing_bulge(departure: Vector, chord: Vector) -> f64 {
    cross(departure, chord) / (chord.norm() + departure.dot(&chord))
}

/// The bulge of the arc over `chord` that comes in along direction `arrival`.
pub(super) fn arriving_bulge(chord: Vector, arrival: Vector) -> f64 {
    cross(chord, arrival) / (chord.norm() + chord.dot(&arrival))
}

/// The share of the piece at which its biarc changes from one arc to the other: where the curve cuts the circle of
/// all possible joints. None when it does not cut that circle once.
pub(super) fn joint(
    curve: &dyn Smooth,
    (from, to): (f64, f64),
    (departure, arrival): (Vector, Vector),
) -> Option<f64> {
    let (start, end) = (curve.point(from), curve.point(to));
    let middle = even_joint(start, end, departure, arrival)?;
    let (spread, facing) = seen_from(middle, start, end);
    // Points on the circle see the ends under one angle. Both ends lie on it too: they are divided out.
    let off_circle = |share: f64| {
        let (cross, dot) = seen_from(curve.point(from + (to - from) * share), start, end);
        (cross * facing - dot * spread) / (share * (1.0 - share))
    };
    let (mut low, mut high) = (1.0 / 16.0, 15.0 / 16.0);
    let at_low = off_circle(low);
    let at_middle = off_circle(0.5);
    // Also what is a circle's arc up to rounding: there any joint will do.
    let negligible = 1e-12 * (end - start).norm_squared() * spread.hypot(facing);
    if at_middle.abs() <= negligible {
        return Some(0.5);
    }
    let cuts_once = at_low * off_circle(high) < 0.0;
    for _ in 0..if cuts_once { HALVINGS } else { 0 } {
        let share = (low + high) / 2.0;
        if off_circle(share) * at_low > 0.0 { low = share } else { high = share }
    }
    cuts_once.then_some((low + high) / 2.0)
}

/// Where the biarc with tangents of equal length meets: half-way between the tips of its end tangents, which lie twice
/// that length apart.
fn even_joint(start: Point, end: Point, departure: Vector, arrival: Vector) -> Option<Point> {
    let chord = end - start;
    let along = chord.dot(&(departure + arrival));
    let apart = 2.0 * (1.0 - departure.dot(&arrival));
    // The positive root of apart · x² + 2 · along · x − chord² = 0, without cancellation when `apart` is small.
    let root = along.mul_add(along, apart * chord.norm_squared()).sqrt();
    let length = chord.norm_squared() / (along + root);
    (length.is_finite() && length > 0.0).then(|| start + chord / 2.0 + (departure - arrival) * (length / 2.0))
}

/// Cross and scalar product of the views from `eye` to both points: the angle between them.
fn seen_from(eye: Point, first: Point, second: Point) -> (f64, f64) {
    (cross(first - eye, second - eye), (first - eye).dot(&(second - eye)))
}
