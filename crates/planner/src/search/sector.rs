//! Directions that a way may have where it touches a feature: a quick test that leaves out most tangents before any
//! root or angle is worked out. It errs on the side of letting them pass; the tangent itself decides.

use super::departure::Departure;
use crate::barrier::{Feature, Side};
use std::f64::consts::PI;
use traverse_geometry::{Point, Vector, cross, left_of};

/// What a direction may be off, as a share of the way: above the tolerance of offsets.
const SLACK_RATIO: f64 = 1e-8;

/// The same for ways of no length, millimetres: above the rounding of coordinates.
const SLACK_MM: f64 = 1e-8;

/// The directions of travel along one side of a circle, over a range of it. With the circle on the left they turn
/// counter-clockwise from `first` to `last`; with the circle on the right the opposite ones do, the other way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sector {
    center: Point,
    radius: f64,
    first: Vector,
    last: Vector,
    /// More than half a turn: every direction passes.
    wide: bool,
}

impl Sector {
    /// All of a feature's range.
    pub(crate) fn of(feature: &Feature) -> Self {
        Self::over(feature, 0.0, feature.sweep)
    }

    /// Every direction from a point.
    pub(crate) fn all_round(center: Point) -> Self {
        Self { center, radius: 0.0, first: Vector::zeros(), last: Vector::zeros(), wide: true }
    }

    /// What is left of a feature's range for a departure.
    pub(super) fn ahead(departure: &Departure) -> Self {
        match departure.lane.side {
            Side::Left => Self::over(&departure.circle, departure.offset, departure.free.1),
            Side::Right => Self::over(&departure.circle, departure.free.0, departure.offset),
        }
    }

    /// A part of a feature's range.
    pub(crate) fn over(feature: &Feature, from: f64, to: f64) -> Self {
        Self {
            center: feature.center,
            radius: feature.plan_radius,
            first: left_of(feature.direction_at(from)),
            last: left_of(feature.direction_at(to)),
            wide: to - from > PI - 1e-6,
        }
    }

    /// On which sides a tangent that leaves this sector's circle on `side` may touch the circle of `other`: left, right.
    pub(crate) fn may_reach(&self, side: Side, other: &Self) -> [Option<Side>; 2] {
        let between = other.center - self.center;
        let slack = self.radius + other.radius + SLACK_MM + SLACK_RATIO * (between.x.abs() + between.y.abs());
        if !self.admits(between, slack)[side as usize] {
            return [None, None];
        }
        let [left, right] = other.admits(between, slack);
        [left.then_some(Side::Left), right.then_some(Side::Right)]
    }

    /// Whether a tangent that leaves the circle on `side` may lead to a place within `slack` of `to`.
    pub(crate) fn may_lead_to(&self, side: Side, to: Point, slack: f64) -> bool {
        let between = to - self.center;
        let slack = slack + SLACK_MM + SLACK_RATIO * (between.x.abs() + between.y.abs());
        self.admits(between, slack)[side as usize]
    }

    /// Whether a way along `between` runs along the circle within the range, on the left and on the right.
    fn admits(&self, between: Vector, slack: f64) -> [bool; 2] {
        let (after_first, before_last) = (cross(self.first, between), cross(between, self.last));
        [
            self.wide || after_first >= -slack && before_last >= -slack,
            self.wide || after_first <= slack && before_last <= slack,
        ]
    }
}
