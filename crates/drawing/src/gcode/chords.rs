//! Straight moves round the outside of arcs.

use super::error::GcodeError;
use super::settings::{LARGEST_CHORD_TOLERANCE_MM, SMALLEST_CHORD_TOLERANCE_MM};
use std::f64::consts::FRAC_PI_2;
use traverse_geometry::{Arc, Path, unit};

/// The most chords of one arc.
const CHORD_LIMIT: usize = 100_000;

/// The path with every arc replaced by straight moves on its outside, touching it and at most `tolerance_mm`
/// (within [`SMALLEST_CHORD_TOLERANCE_MM`] and [`LARGEST_CHORD_TOLERANCE_MM`]) away from it.
///
/// A rapid move turns round what lies on the inner side of its arcs, so it keeps the clearance from that. What lies
/// outside may come nearer by the tolerance: check the new path where there is little room.
///
/// # Errors
/// When the tolerance is out of range, or so fine that an arc would take more than 100 000 chords.
pub fn chords_outside(path: &Path, tolerance_mm: f64) -> Result<Path, GcodeError> {
    let (least, largest) = (SMALLEST_CHORD_TOLERANCE_MM, LARGEST_CHORD_TOLERANCE_MM);
    if !(least..=largest).contains(&tolerance_mm) {
        return Err(GcodeError::ChordTolerance { value: tolerance_mm, least, largest });
    }
    let mut straight = Path::at(path.start);
    for (step, number) in path.steps.iter().zip(1..) {
        if let Some(circle) = step.arc {
            let arc = Arc::from_center(straight.end(), step.end, circle.center, circle.sweep);
            for corner in corners_outside(&arc, tolerance_mm, 0.0, number)? {
                straight.line_to(corner);
            }
        }
        straight.line_to(step.end);
    }
    Ok(straight)
}

/// Corners of the straight moves round the outside of an arc, between its ends. The circle is taken to be larger by
/// `rounding_mm`, so that corners that are then rounded by as much do not cut into it.
pub(crate) fn corners_outside(
    arc: &Arc,
    tolerance_mm: f64,
    rounding_mm: f64,
    step: usize,
) -> Result<impl Iterator<Item = traverse_geometry::Point>, GcodeError> {
    let (center, start_angle, sweep) = (arc.center, arc.start_angle, arc.sweep);
    let radius = arc.radius + rounding_mm;
    let room = (tolerance_mm - rounding_mm).max(tolerance_mm / 2.0);
    // Half the angle between corners: radius / cos(half) = radius + room, written so that it stays exact.
    let half = 2.0 * (room / (2.0 * (radius + room))).sqrt().asin();
    let count = (sweep.abs() / (2.0 * half).min(FRAC_PI_2)).ceil().max(1.0);
    if count.is_nan() || count > CHORD_LIMIT as f64 {
        return Err(GcodeError::TooManyChords { step, limit: CHORD_LIMIT, tolerance_mm });
    }
    let turn = sweep / count;
    let reach = radius / (turn / 2.0).cos();
    Ok((0..count as usize).map(move |k| center + unit(start_angle + (k as f64 + 0.5) * turn) * reach))
}
