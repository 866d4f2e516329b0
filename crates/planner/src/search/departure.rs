//! Leaving a feature: how far along its arc a label can go, and what that costs.

use super::Tangent;
use super::settled::Lane;
use crate::barrier::Feature;
use crate::measure::Measure;
use crate::prepared::Link;
use traverse_geometry::{Vector, cross};

/// A label at a feature, about to leave it.
#[derive(Clone, Copy)]
pub(super) struct Departure {
    pub(super) lane: Lane,
    pub(super) circle: Feature,
    /// The free stretch of the circle that the label is on.
    pub(super) free: (f64, f64),
    /// Offset of arrival.
    pub(super) offset: f64,
    /// Outward direction of arrival on the answered path.
    pub(super) spoke: Vector,
    /// What the label costs.
    pub(super) cost: f64,
}

impl Departure {
    /// Signed radii of the circle as tangents take them: planned and priced.
    pub(super) fn rho(&self) -> (f64, f64) {
        let sign = self.lane.side.sign();
        (self.circle.plan_radius * sign, self.circle.price_radius * sign)
    }

    /// The offset at which `plan` leaves the feature, if the free way along the arc leads there.
    pub(super) fn leaves_at(&self, plan: &Tangent) -> Option<f64> {
        let sign = self.lane.side.sign();
        let left = self.circle.offset_of(-plan.normal * sign, plan.angle_error)?;
        // A turn back by rounding is none.
        let back = (self.offset - left) * sign;
        let is_rounding = back > 0.0 && back <= plan.angle_error.max(self.circle.offset_tolerance());
        let left = if is_rounding { self.offset } else { left };
        self.reaches(left).then_some(left)
    }

    /// The offset at which `link` leaves the feature, if the free way along the arc leads there.
    pub(super) fn leaves_along(&self, link: &Link) -> Option<f64> {
        let back = (self.offset - link.left_at) * self.lane.side.sign();
        let is_rounding = back > 0.0 && back <= link.angle_error().max(self.circle.offset_tolerance());
        let left = if is_rounding { self.offset } else { link.left_at };
        self.reaches(left).then_some(left)
    }

    /// Whether `left` lies ahead on the same free stretch.
    pub(super) fn reaches(&self, left: f64) -> bool {
        let tolerance = self.circle.offset_tolerance();
        let (from, to) = self.free;
        (left - self.offset) * self.lane.side.sign() >= 0.0
            && from - tolerance <= left
            && left <= to + tolerance
    }

    /// The cost at `left` on the planned circle: what other labels of the lane are compared at.
    pub(super) fn planned_cost(&self, measure: impl Measure, left: f64) -> f64 {
        self.cost + measure.between(&self.circle, self.offset, left)
    }

    /// The angle that the answered path turns until `left`, which it leaves in direction `left_spoke`: the planned
    /// path's, and what both directions differ by. Radians, not negative.
    pub(super) fn turned(&self, left: f64, left_spoke: Vector) -> f64 {
        let sign = self.lane.side.sign();
        let in_by = small_angle(self.circle.direction_at(self.offset), self.spoke);
        let out_by = small_angle(self.circle.direction_at(left), left_spoke);
        ((left - self.offset + out_by - in_by) * sign).max(0.0)
    }

    /// The cost of the answered path where it leaves.
    pub(super) fn cost_at(&self, measure: impl Measure, left: f64, left_spoke: Vector) -> f64 {
        if self.circle.price_radius == 0.0 {
            return self.cost;
        }
        let sweep = self.turned(left, left_spoke) * self.lane.side.sign();
        self.cost + measure.turn(self.circle.price_radius, self.spoke, sweep)
    }
}

/// The angle from `a` to `b`, both unit vectors that hardly differ.
pub(crate) fn small_angle(a: Vector, b: Vector) -> f64 {
    cross(a, b).atan2(a.dot(&b))
}
