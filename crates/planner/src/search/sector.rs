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
pub(super) struct Sector {
    center: Point,
    radius: f64,
    first: Vector,
    last: Vector,
    /// More than half a turn: every direction passes.
    wide: bool,
}

impl Sector {
    /// All of a feature's range.
    pub(super) fn of(feature: &Feature) -> Self {
        Self::over(feature, 0.0, feature.sweep)
    }

    /// What is left of a feature's range for a departure.
    pub(super) fn ahead(departure: &Departure) -> Self {
        match departure.lane.side {
            Side::Left => Self::over(&departure.circle, departure.offset, departure.free.1),
            Side::Right => Self::over(&departure.circle, departure.free.0, departure.offset),
        }
    }

    fn over(feature: &Feature, from: f64, to: f64) -> Self {
        Self {
            center: feature.center,
            radius: feature.plan_radius,
            first: left_of(feature.direction_at(from)),
            last: left_of(feature.direction_at(to)),
            wide: to - from > PI - 1e-6,
        }
    }

    /// Whether a way along `between`, from or to the centre, may run along the sector's circle on each side, when it
    /// touches another circle of `radius` at its other end: on the left, on the right.
    pub(super) fn admits(&self, between: Vector, radius: f64) -> [bool; 2] {
        if self.wide {
            return [true, true];
        }
        let slack = self.radius + radius + SLACK_MM + SLACK_RATIO * (between.x.abs() + between.y.abs());
        let (after_first, before_last) = (cross(self.first, between), cross(between, self.last));
        [after_first >= -slack && before_last >= -slack, after_first <= slack && before_last <= slack]
    }

    /// From the centre to another one's.
    pub(super) fn to(&self, other: &Self) -> Vector {
        other.center - self.center
    }

    /// From a point to the centre.
    pub(super) fn seen_from(&self, point: Point) -> Vector {
        self.center - point
    }

    pub(super) fn radius(&self) -> f64 {
        self.radius
    }
}
