//! What a shortest path can bend round: a circle, of radius 0 for a control point, over a range of directions.

use std::f64::consts::PI;
use traverse_geometry::{Point, Vector, positive_angle, unit};

/// A convex corner or arc of a barrier.
///
/// Directions on it are given by their offset: the angle counter-clockwise from where its range begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feature {
    /// Centre of the circle.
    pub(crate) center: Point,
    /// Radius that a path keeps while it is planned, millimetres.
    pub(crate) plan_radius: f64,
    /// Radius that the answered path has, millimetres: the same, or less one contact tolerance at clearance 0.
    pub(crate) price_radius: f64,
    /// Outward direction where the range begins, radians.
    pub(crate) start_angle: f64,
    /// Width of the range, radians, at most a full turn.
    pub(crate) sweep: f64,
    /// The feature that the range's beginning goes over into without a straight edge between.
    pub(crate) before: Option<u32>,
    /// The feature that the range's end goes over into without a straight edge between.
    pub(crate) after: Option<u32>,
    /// The feature that the border of a mitred barrier leads to from the range's end, straight, where one of both is an arc:
    /// a tangent so short against the radius that both circles don't tell its direction.
    pub(crate) straight_after: Option<u32>,
    /// Whose barrier it belongs to, as in [`super::Blocker::owner`].
    pub(crate) owner: usize,
}

/// On which side of the direction of travel the circle lies that a path bends round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Side {
    /// Left: the path turns counter-clockwise, offsets grow.
    Left,
    /// Right: the path turns clockwise, offsets shrink.
    Right,
}

impl Side {
    /// +1 on the left, −1 on the right.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

impl Feature {
    /// The offset of an outward `direction` that is known to `angle_error` radians, moved onto the range's ends from
    /// just beyond: neighbouring ranges overlap, so that rounding leaves no direction between them.
    pub(crate) fn offset_of(&self, direction: Vector, angle_error: f64) -> Option<f64> {
        let tolerance = angle_error + self.offset_tolerance();
        let offset = positive_angle(direction.y.atan2(direction.x) - self.start_angle);
        if offset <= self.sweep {
            Some(offset)
        } else if offset <= self.sweep + tolerance {
            Some(self.sweep)
        } else if offset >= std::f64::consts::TAU - tolerance {
            Some(0.0)
        } else {
            None
        }
    }

    /// Offsets nearer to each other than this are the same place: a nanometre's thousandth on the circle.
    pub(crate) fn offset_tolerance(&self) -> f64 {
        1e-9 / self.plan_radius.max(1.0)
    }

    /// The outward direction at `offset`.
    pub(crate) fn direction_at(&self, offset: f64) -> Vector {
        unit(self.start_angle + offset)
    }

    /// The middle and radius of a disc that holds what a planned path passes.
    pub(crate) fn disc(&self) -> (Point, f64) {
        let far = 2.0 * (self.sweep / 4.0).sin();
        if self.sweep < PI && far < 1.0 {
            (self.plan_point(self.sweep / 2.0), far * self.plan_radius)
        } else {
            (self.center, self.plan_radius)
        }
    }

    /// The point at `offset` that a planned path passes.
    pub(crate) fn plan_point(&self, offset: f64) -> Point {
        self.center + self.direction_at(offset) * self.plan_radius
    }

    /// The point at `offset` that the answered path passes.
    pub(crate) fn price_point(&self, offset: f64) -> Point {
        self.center + self.direction_at(offset) * self.price_radius
    }
}
