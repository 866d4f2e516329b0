//! Two arcs that have given directions at their outer ends and one direction where they meet.

use super::Smooth;
use super::station::Station;
use traverse_geometry::{Point, Vector, cross};

/// Steps in the search for the joint; it takes five or six.
const MOST_STEPS: usize = 40;

/// The views of both ends from the joint and from the circle differ by this angle at most, radians.
const NEGLIGIBLE: f64 = 1e-12;

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
    curve: &impl Smooth,
    [from, middle, to]: [&Station; 3],
    (departure, arrival): (Vector, Vector),
) -> Option<f64> {
    let (start, end) = (from.point, to.point);
    let even = even_joint(start, end, departure, arrival)?;
    let (spread, facing) = seen_from(even, start, end);
    // Points on the circle see the ends under one angle. Both ends lie on it too: they are divided out.
    let off_circle_at = |share: f64, point: Point| {
        let (cross, dot) = seen_from(point, start, end);
        (cross * facing - dot * spread) / (share * (1.0 - share))
    };
    let off_circle = |share: f64| off_circle_at(share, curve.point(from.t + (to.t - from.t) * share));
    // Also what is a circle's arc up to rounding: there any joint will do.
    let negligible = NEGLIGIBLE * (end - start).norm_squared() * spread.hypot(facing);
    let at_middle = off_circle_at(0.5, middle.point);
    if at_middle.abs() <= negligible {
        return Some(0.5);
    }
    let (low, high) = (1.0 / 16.0, 15.0 / 16.0);
    let (at_low, at_high) = (off_circle(low), off_circle(high));
    let cuts_once = at_low * at_high < 0.0;
    cuts_once.then(|| {
        let (outer, at_outer) = if at_low * at_middle < 0.0 { (low, at_low) } else { (high, at_high) };
        root(off_circle, (outer, at_outer), (0.5, at_middle), negligible)
    })
}

/// Where `value` falls below `negligible` between two places of opposite sign: false position, with the value at the
/// place that stays halved (Dowell, Jarratt 1971).
fn root(
    value: impl Fn(f64) -> f64,
    (mut opposite, mut at_opposite): (f64, f64),
    (mut last, mut at_last): (f64, f64),
    negligible: f64,
) -> f64 {
    for _ in 0..MOST_STEPS {
        let share = last - at_last * ((last - opposite) / (at_last - at_opposite));
        let at_share = value(share);
        if at_share * at_last < 0.0 {
            (opposite, at_opposite) = (last, at_last);
        } else {
            at_opposite /= 2.0;
        }
        (last, at_last) = (share, at_share);
        if at_last.abs() <= negligible {
            break;
        }
    }
    last
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
