//! How wide a section is, not more than it is, and how exactly the edges of its box are known: where the box ends at an arc,
//! they are rounded.

use crate::facing::Facing;
use crate::flank::Flank;
use traverse_geometry::{Pose, Section};

/// Roundings of a width that are taken off it.
const WIDTH_ROUNDINGS: f64 = 4.0;

/// The extent of a section along the strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// Not more than its width, millimetres.
    pub(crate) width_mm: f64,
    /// By how much either edge of its box may lie off, millimetres.
    pub(crate) edge_slack_mm: f64,
}

impl Extent {
    /// Measures `section`. None: given up. Cost: linear.
    pub(crate) fn of(section: &Section, go_on: &dyn Fn() -> bool) -> Option<Self> {
        let furthest = |facing: Facing| {
            let mut furthest = f64::NEG_INFINITY;
            let see = |flank: Flank| furthest = furthest.max(flank.furthest(flank.low, flank.high));
            facing.flanks(section, Pose::AsIs, go_on, see)?;
            Some(furthest)
        };
        let (right, left) = (furthest(Facing::Right)?, furthest(Facing::Left)?);
        let box_mm = section.bounds().size().x;
        let rounding = WIDTH_ROUNDINGS * f64::EPSILON * box_mm;
        Some(Self {
            width_mm: (right + left.min(0.0)).min(box_mm) - rounding,
            edge_slack_mm: left.abs().max((right - box_mm).abs()),
        })
    }
}
