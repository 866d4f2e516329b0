//! How far a piece of a curve and one edge run from each other.
//!
//! At [`SAMPLES`] places inside the piece the signed distance from the edge's line or circle is taken. Between two of
//! them it can exceed both by an eighth of its second difference; a quarter is added. At each place the foot on the
//! edge must also move forward with the curve. So the foot runs over the whole edge without a jump, every point of
//! the edge is the foot of some point of the piece, and the bound holds both ways: no point of the piece is farther
//! from the edge, and no point of the edge farther from the piece.
//!
//! The middle is looked at first: both run through the same ends, so that is where they part most.

use super::Smooth;
use super::track::Track;

/// Places inside a piece at which it is compared with its edge.
const SAMPLES: usize = 9;

/// The order in which they are looked at.
const ORDER: [usize; SAMPLES] = [5, 3, 7, 2, 8, 4, 6, 1, 9];

/// The square of the cosine of the angle by which the curve may lean from the edge's direction: 60°.
const LEAST_SQUARED_COSINE: f64 = 0.25;

/// Whether the piece and the edge over the same ends run within `tolerance_mm` of each other, forward all the way.
pub(super) fn follows(curve: &impl Smooth, (from, to): (f64, f64), edge: &Track, tolerance_mm: f64) -> bool {
    // At both ends the distance is 0.
    let mut distances = [0.0_f64; SAMPLES + 2];
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
    }
    let largest = distances.iter().fold(0.0_f64, |largest, distance| largest.max(distance.abs()));
    let bends = distances.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).abs());
    largest + bends.fold(0.0, f64::max) / 4.0 <= tolerance_mm
}
