//! Where two edges touch: exactly for straight ones, within the rounding of their own numbers for circular ones.
//!
//! In doubt they do not touch: a gap of a few units in the last place may be one that a path was planned through.

use crate::arc_distance::places;
use crate::curve::{Circular, Curve, Straight, cross};
use traverse_geometry::{Bounds, Orientation, Point, orientation};

/// How near circular edges must come to touch, in units of their coordinates' rounding.
const ARC_ROUNDINGS: f64 = 16.0;

/// Every place where the edges touch or cross; for a common part its ends.
pub(crate) fn contacts(one: &Curve, other: &Curve) -> Vec<Point> {
    match (one, other) {
        (Curve::Straight(one), Curve::Straight(other)) => straight_contacts(one, other),
        _ => {
            let reach = arc_reach(one, other);
            let meet = |fraction| {
                let p = one.point_at(fraction);
                (other.distance_to_point(p) <= reach).then_some(p)
            };
            places(one, other).into_iter().filter_map(meet).collect()
        }
    }
}

/// Whether edges that run side by side have no gap between them, `gap` being what was computed.
pub(crate) fn coincide(one: &Curve, other: &Curve, gap: f64) -> bool {
    match (one, other) {
        (Curve::Straight(one), Curve::Straight(other)) => {
            orientation(one.a, one.b, other.a) == Orientation::Straight
                && orientation(one.a, one.b, other.b) == Orientation::Straight
        }
        (Curve::Circular(_), Curve::Circular(_)) => gap.abs() <= arc_reach(one, other),
        _ => false,
    }
}

fn straight_contacts(one: &Straight, other: &Straight) -> Vec<Point> {
    use Orientation::Straight as On;
    let (start, end) = (orientation(one.a, one.b, other.a), orientation(one.a, one.b, other.b));
    let (from, to) = (orientation(other.a, other.b, one.a), orientation(other.a, other.b, one.b));
    if start != On && end != On && from != On && to != On {
        if start == end || from == to {
            return Vec::new();
        }
        let (along, across) = (one.b - one.a, other.b - other.a);
        return vec![one.a + along * (cross(other.a - one.a, across) / cross(along, across))];
    }
    let mut found = Vec::new();
    let mut ask = |side: Orientation, p: Point, edge: &Straight| {
        if side == On && Bounds::of([edge.a, edge.b]).contains(p) {
            found.push(p);
        }
    };
    ask(start, other.a, one);
    ask(end, other.b, one);
    ask(from, one.a, other);
    ask(to, one.b, other);
    found
}

fn arc_reach(one: &Curve, other: &Curve) -> f64 {
    ARC_ROUNDINGS * f64::EPSILON * size(one).max(size(other))
}

fn size(curve: &Curve) -> f64 {
    let (a, b) = (curve.start(), curve.end());
    let radius = match curve {
        Curve::Straight(_) => 0.0,
        Curve::Circular(Circular { radius, .. }) => *radius,
    };
    [a.x, a.y, b.x, b.y].into_iter().fold(radius, |size, coordinate| size.max(coordinate.abs()))
}
