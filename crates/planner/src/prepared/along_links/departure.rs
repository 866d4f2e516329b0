//! Leaving a feature along links: how far a label can go along its arc, and what that costs.

use super::super::label::Label;
use crate::barrier::Feature;
use crate::search::Tangent;
use traverse_geometry::Point;

/// A label at a feature, about to leave it.
#[derive(Clone, Copy)]
pub(super) struct Departure<'a> {
    pub(super) index: u32,
    pub(super) label: Label,
    pub(super) circle: &'a Feature,
    /// The free stretch of the circle that it is on.
    pub(super) free: (f64, f64),
    /// The start, where the label comes straight from it.
    pub(super) start: Option<Point>,
}

impl Departure<'_> {
    fn sign(&self) -> f64 {
        self.label.side().sign()
    }

    /// The offset at which `planned` leaves, if the free way along the arc leads there.
    pub(super) fn leaves_by(&self, planned: &Tangent) -> Option<f64> {
        let left_at = self.circle.offset_of(-planned.normal * self.sign(), planned.angle_error)?;
        self.leaves_along(left_at, planned.angle_error)
    }

    /// The same for a way of which the offset is known.
    pub(super) fn leaves_along(&self, left_at: f64, angle_error: f64) -> Option<f64> {
        // A turn back by rounding is none.
        let back = (self.label.offset - left_at) * self.sign();
        let is_rounding = back > 0.0 && back <= angle_error.max(self.circle.offset_tolerance());
        let left_at = if is_rounding { self.label.offset } else { left_at };
        self.reaches(left_at).then_some(left_at)
    }

    /// Whether `left_at` lies ahead on the same free stretch.
    pub(super) fn reaches(&self, left_at: f64) -> bool {
        let tolerance = self.circle.offset_tolerance();
        let (from, to) = self.free;
        (left_at - self.label.offset) * self.sign() >= 0.0
            && from - tolerance <= left_at
            && left_at <= to + tolerance
    }

    /// What the path costs where it leaves. A start that is priced from another place than it is planned from may touch the
    /// circle further on than where it leaves: then it goes straight there.
    pub(super) fn cost_at(&self, left_at: f64) -> f64 {
        let along_arc =
            self.label.cost + self.circle.price_radius * (left_at - self.label.offset) * self.sign();
        match self.start {
            Some(start) if self.circle.price_radius > 0.0 => {
                along_arc.max((self.circle.price_point(left_at) - start).norm())
            }
            _ => along_arc,
        }
    }
}
