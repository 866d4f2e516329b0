//! How far a piece of a curve and one edge run from each other.
//!
//! At [`SAMPLES`] places inside the piece the signed distance from the edge's line or circle is taken. Between two of
//! them it can exceed both by an eighth of its second difference; a quarter is added. At each place the foot on the
//! edge must also move forward with the curve. So the foot runs over the whole edge without a jump, every point of
//! the edge is the foot of some point of the piece, and the bound holds both ways: no point of the piece is farther
//! from the edge, and no point of the edge farther from the piece.
//!
//! Before the first of these places and behind the last one the curve could run past the edge's end and back. It does not
//! when it leaves and arrives forward, and at neither end of that stretch faster than three times its mean: then a cubic
//! is monotone there (Fritsch, Carlson 1980).
//!
//! The middle is looked at first: both run through the same ends, so that is where they part most.

use super::Smooth;
use super::track::Track;
use traverse_geometry::{Point, Vector};

/// Places inside a piece at which it is compared with its edge.
const SAMPLES: usize = 9;

/// The order in which they are looked at.
const ORDER: [usize; SAMPLES] = [5, 3, 7, 2, 8, 4, 6, 1, 9];

/// The square of the cosine of the angle by which the curve may lean from the edge's direction: 60°.
const LEAST_SQUARED_COSINE: f64 = 0.25;

/// A curve that runs back at an end by no more than this share of its speed nearby stands still there.
const STANDSTILL: f64 = 1e-9;

/// Whether the piece and the edge over the same ends run within `tolerance_mm` of each other, forward all the way.
pub(super) fn follows(curve: &impl Smooth, (from, to): (f64, f64), edge: &Track, tolerance_mm: f64) -> bool {
    // At both ends the distance is 0.
    let mut distances = [0.0_f64; SAMPLES + 2];
    let mut outer = [None; 2];
    for i in ORDER {
        let (point, derivative) = curve.at(from + (to - from) * i as f64 / (SAMPLES + 1) as f64);
        let Some((distance, direction)) = edge.beside(point) else { return false };
        let along = derivative.dot(&direction);
        let forward = along > 0.0 && along * along > LEAST_SQUARED_COSINE * derivative.norm_squared();
        let near = distance.abs() <= tolerance_mm;
        if !(forward && near) {
            return false;
        }
        distances[i] = distance;
        if i == 1 || i == SAMPLES {
            outer[usize::from(i > 1)] = Some((point, derivative, direction));
        }
    }
    let largest = distances.iter().fold(0.0_f64, |largest, distance| largest.max(distance.abs()));
    let bends = distances.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).abs());
    if largest + bends.fold(0.0, f64::max) / 4.0 > tolerance_mm {
        return false;
    }
    let stretch = (to - from) / (SAMPLES + 1) as f64;
    let mut ends = [from, to].into_iter().zip(outer);
    ends.all(|(t, outer)| outer.is_some_and(|outer| keeps_to_its_end(curve.at(t), outer, stretch)))
}

/// Whether the curve runs forward all the way between an end of the piece and the outermost place inside it, a stretch of
/// the parameter away. The edge turns by a tenth of half a turn at most between them.
fn keeps_to_its_end(
    (end, at_end): (Point, Vector),
    (place, at_place, direction): (Point, Vector, Vector),
    stretch: f64,
) -> bool {
    let mean = 3.0 * (end - place).norm() / stretch;
    at_end.dot(&direction) >= -STANDSTILL * at_place.norm()
        && at_end.norm() <= mean
        && at_place.norm() <= mean
}
