//! Arcs as straight moves outside of them.
//!
//! Chords touch the arc from outside, so they keep clear of what it goes round; what lies beyond may be nearer than the
//! tolerance. So chords are tested against the whole scene, as they will be run, and become tighter until nothing is in
//! their way. Where even the tightest ones have no room, the arc stays.
//!
//! Where each axis has its own speed, chords cost what the arc costs if they touch it where both axes are equally slow:
//! between two such places the cost depends on the ends alone. So arcs are parted there.

use super::pair::Pair;
use super::{Driver, sweep};
use crate::measure::{AxisTime, Measure};
use crate::search::Stop;
use std::f64::consts::{FRAC_PI_4, TAU};
use traverse_geometry::{ARC_CHORD_TOLERANCE_MM, Path, unit};
use traverse_solve::Interrupt;

/// So often chords are made tighter.
const TRIES: i32 = 8;

/// Each time the tolerance is this share of the last one.
const TIGHTER: f64 = 0.25;

/// Most chords of one arc.
const CHORD_LIMIT: f64 = 4096.0;

/// Parts of arcs are no narrower than this, radians.
const NARROWEST_PART_RAD: f64 = 1e-9;

impl Driver<'_> {
    /// Adds chords in place of a stop's arc; false where none have room.
    pub(super) fn chords(
        &self,
        path: &mut Path,
        stop: &Stop,
        arrival: Pair,
        departure: Pair,
    ) -> Result<bool, Interrupt> {
        for attempt in 0..TRIES {
            self.budget.check(0)?;
            let tolerance_mm = ARC_CHORD_TOLERANCE_MM * TIGHTER.powi(attempt);
            let Some(mut corners) = corners(stop, tolerance_mm, self.axes) else { return Ok(false) };
            corners.push(departure);
            let mut along = path.clone();
            if self.has_room(&mut along, arrival, &corners)? {
                *path = along;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Adds straight moves round corners, unless something is in the way.
    fn has_room(&self, path: &mut Path, from: Pair, corners: &[Pair]) -> Result<bool, Interrupt> {
        let mut at = from;
        for &corner in corners {
            self.budget.check(0)?;
            if !self.is_free(at.planned, corner.planned) || !self.straight(path, at, corner)? {
                return Ok(false);
            }
            at = corner;
        }
        Ok(true)
    }
}

/// Where chords meet that touch the stop's arc from outside, within a tolerance; none if they would be too many.
fn corners(stop: &Stop, tolerance_mm: f64, axes: Option<AxisTime>) -> Option<Vec<Pair>> {
    let radius = stop.circle.plan_radius;
    // radius / cos(half) = radius + tolerance, written so that small angles stay exact.
    let half = 2.0 * (tolerance_mm / (2.0 * (radius + tolerance_mm))).sqrt().asin();
    let widest = (2.0 * half).min(FRAC_PI_4);
    let sweep = sweep(stop);
    let mut corners = Vec::new();
    let mut from = stop.spoke_in.y.atan2(stop.spoke_in.x);
    for part in parts(from, sweep, axes) {
        let count = (part.abs() / widest).ceil().max(1.0);
        if count + corners.len() as f64 > CHORD_LIMIT {
            return None;
        }
        let turn = part / count;
        let reach = 1.0 / (turn / 2.0).cos();
        let at = |k: usize| from + (k as f64 + 0.5) * turn;
        corners.extend((0..count as usize).map(|k| Pair::beside(stop, unit(at(k)) * reach)));
        from += part;
    }
    Some(corners)
}

/// The sweep, parted where costs have kinks.
fn parts(from: f64, sweep: f64, axes: Option<AxisTime>) -> Vec<f64> {
    let turn_to = |kink: f64| ((kink - from) * sweep.signum()).rem_euclid(TAU);
    let mut places: Vec<f64> = axes.iter().filter_map(|axes| axes.kinks()).flatten().map(turn_to).collect();
    let is_inside = |&place: &f64| place > NARROWEST_PART_RAD && place < sweep.abs() - NARROWEST_PART_RAD;
    places.retain(is_inside);
    places.sort_by(f64::total_cmp);
    places.push(sweep.abs());
    let mut before = 0.0;
    let part = |place: f64| (place - std::mem::replace(&mut before, place)) * sweep.signum();
    places.into_iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::AxisSpeeds;

    #[test]
    fn parts_add_up_and_touch_at_kinks() {
        let axes = AxisTime::new(&AxisSpeeds { x_mm_per_s: 70.0, y_mm_per_s: 40.0, z_mm_per_s: 0.0 });
        for case in 0..200 {
            let from = f64::from(case) * 0.21 - 20.0;
            let sweep = (f64::from(case % 23) - 11.5) * 0.5;
            let parts = parts(from, sweep, Some(axes));
            assert!((parts.iter().sum::<f64>() - sweep).abs() < 1e-12);
            // Within a part one axis is the slower one: circumscribed chords cost what the arc costs.
            let mut at = from;
            for part in parts {
                let chord = unit(at + part / 2.0) / (part / 2.0).cos();
                if part.abs() < 1.5 {
                    let round = axes.along(chord - unit(at)) + axes.along(unit(at + part) - chord);
                    assert!((round - axes.arc(1.0, at, part)).abs() < 1e-14, "{from} {sweep} {part}");
                }
                at += part;
            }
        }
        assert!(crate::drive::ON_LINE_MM < ARC_CHORD_TOLERANCE_MM * TIGHTER.powi(TRIES));
    }
}
