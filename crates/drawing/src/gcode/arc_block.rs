//! An arc as the controller will read it: rounded words, and whether they still say the same arc.

use super::axes::{Axes, Words};
use super::grid::Grid;
use crate::GcodeDialect;
use std::f64::consts::TAU;
use traverse_geometry::{Arc, Point, cross};

/// Arcs of smaller radius, in last places, are too coarse on the grid to stay round.
const SMALLEST_RADIUS_STEPS: f64 = 20.0;

/// How far the end of a rounded arc may turn out beyond or short of the true one, in last places: both ends and the
/// centre are off by up to 0.71 each, the start counts twice.
const TURN_STEPS: f64 = 4.0;

/// How much of the controller's tolerance is used: the rest is for its own arithmetic.
const SHARE_OF_TOLERANCE: f64 = 0.8;

/// The same for Grbl, a metre from its origin.
const SHARE_ON_GRBL: f64 = 0.5;

/// What becomes of an arc on the grid.
pub(crate) enum ArcBlock {
    /// It is as good as straight: the chord is no farther than half a last place away.
    Straight,
    /// It can be said by centre.
    Round { end: Words, offset: Words },
    /// On this grid the controller would read another arc: too small, or too flat and short.
    Unspeakable,
    /// The controller would refuse it.
    RadiiDiffer { mismatch_mm: f64, tolerance_mm: f64 },
}

/// Rounds the arc that begins where the controller stands, at `from`.
pub(crate) fn arc_block(grid: Grid, axes: Axes, from: Words, end: Words, arc: &Arc) -> ArcBlock {
    let step = grid.step_mm();
    let half_turn = arc.sweep.abs() / 2.0;
    // 1 − cos, without cancellation.
    let rise = 2.0 * arc.radius * (half_turn / 2.0).sin().powi(2);
    if half_turn < 1.0 && rise <= step / 2.0 {
        return ArcBlock::Straight;
    }
    let start_mm = axes.read_position(grid, from);
    let end_mm = axes.read_position(grid, end);
    let Some(offset) = axes.offset(grid, arc.center - start_mm) else { return ArcBlock::Unspeakable };
    let center = start_mm + traverse_geometry::Vector::new(grid.mm(offset.x), grid.mm(offset.y));
    let radius = (start_mm - center).norm();
    if radius < SMALLEST_RADIUS_STEPS * step {
        return ArcBlock::Unspeakable;
    }
    let turn = read_turn(start_mm, end_mm, center, arc.sweep > 0.0);
    if (turn - arc.sweep.abs()).abs() * radius > TURN_STEPS * step {
        return ArcBlock::Unspeakable;
    }
    let mismatch_mm = ((end_mm - center).norm() - radius).abs();
    // Grbl computes positions in single precision: up to a micrometre more of what it sees is rounding.
    let share = if grid.dialect == GcodeDialect::Grbl { SHARE_ON_GRBL } else { SHARE_OF_TOLERANCE };
    let tolerance_mm = share * grid.dialect.radius_tolerance_mm(grid.unit, radius);
    if mismatch_mm > tolerance_mm {
        return ArcBlock::RadiiDiffer { mismatch_mm, tolerance_mm };
    }
    ArcBlock::Round { end, offset }
}

/// The angle that a controller turns over, within (0, 2π]: equal ends are a full turn.
fn read_turn(start: Point, end: Point, center: Point, counter_clockwise: bool) -> f64 {
    let (from, to) = (start - center, end - center);
    let turned = cross(from, to).atan2(from.dot(&to));
    let turned = if counter_clockwise { turned } else { -turned };
    if turned <= 0.0 { turned + TAU } else { turned }
}
