//! How far a piece of a curve and one edge run from each other.
//!
//! At [`SAMPLES`] places inside the piece the signed distance from the edge's line or circle is taken. Between two of
//! them it can exceed both by an eighth of its second difference; a quarter is added. At each place the foot on the
//! edge must also move forward with the curve. So the foot runs over the whole edge without a jump, every point of
//! the edge is the foot of some point of the piece, and the bound holds both ways: no point of the piece is farther
//! from the edge, and no point of the edge farther from the piece.

use super::Smooth;
use traverse_geometry::{Edge, Point, Vector, cross, left_of};

/// Places inside a piece at which it is compared with its edge.
const SAMPLES: usize = 9;

/// The curve may lean this far from the edge's direction: the cosine of 60°.
const LEAST_COSINE: f64 = 0.5;

/// Whether the piece and the edge over the same ends run within `tolerance_mm` of each other, forward all the way.
pub(super) fn follows(curve: &dyn Smooth, (from, to): (f64, f64), edge: &Edge, tolerance_mm: f64) -> bool {
    let mut largest: f64 = 0.0;
    let mut largest_bend: f64 = 0.0;
    let mut last_two = [0.0, 0.0];
    for i in 1..=SAMPLES {
        let t = from + (to - from) * i as f64 / (SAMPLES + 1) as f64;
        let point = curve.point(t);
        let Some((distance, direction)) = beside(edge, point) else { return false };
        let derivative = curve.derivative(t);
        let forward = derivative.dot(&direction) > LEAST_COSINE * derivative.norm();
        if !forward || distance.abs() > tolerance_mm {
            return false;
        }
        largest = largest.max(distance.abs());
        if i > 1 {
            largest_bend = largest_bend.max((last_two[0] - 2.0 * last_two[1] + distance).abs());
        }
        last_two = [last_two[1], distance];
    }
    // At both ends the distance is 0.
    largest_bend = largest_bend.max((last_two[0] - 2.0 * last_two[1]).abs());
    largest + largest_bend / 4.0 <= tolerance_mm
}

/// The signed distance of a point from the line or circle of an edge, and the unit direction of travel at its foot;
/// none when the foot is not on the edge.
fn beside(edge: &Edge, point: Point) -> Option<(f64, Vector)> {
    match edge {
        Edge::Segment(segment) => {
            let direction = segment.vector().try_normalize(0.0)?;
            let along = (point - segment.start).dot(&direction);
            let on_it = along >= 0.0 && along <= segment.length();
            on_it.then(|| (cross(direction, point - segment.start), direction))
        }
        Edge::Arc(arc) => {
            let spoke = point - arc.center;
            let direction = left_of(spoke).try_normalize(0.0)? * arc.sweep.signum();
            arc.spans(spoke).then(|| (spoke.norm() - arc.radius, direction))
        }
    }
}
