//! Directions that a way may have where it touches a feature: a quick test that leaves out most tangents before any
//! root or angle is worked out. It errs on the side of letting them pass; the tangent itself decides.

use super::departure::Departure;
use crate::barrier::{Feature, Side};
use std::f64::consts::{FRAC_PI_2, PI};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Point, Vector, cross, left_of};

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
    /// One circle over at most a quarter of a turn: which side of a way it lies on counts.
    narrow: bool,
}

impl Sector {
    /// All of a feature's range.
    pub(crate) fn of(feature: &Feature) -> Self {
        Self::over(feature, 0.0, feature.sweep)
    }

    /// Every direction from a point.
    pub(crate) fn all_round(center: Point) -> Self {
        Self { center, radius: 0.0, first: Vector::zeros(), last: Vector::zeros(), wide: true, narrow: false }
    }

    /// Directions from `first` counter-clockwise to `last`, less than half a turn, along a circle.
    pub(super) fn between(center: Point, radius: f64, first: Vector, last: Vector) -> Self {
        Self { center, radius, first, last, wide: false, narrow: false }
    }

    /// Every direction along a circle.
    pub(super) fn wide(center: Point, radius: f64) -> Self {
        Self { radius, ..Self::all_round(center) }
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
            narrow: to - from <= FRAC_PI_2,
        }
    }

    /// On which sides a tangent that leaves this sector's circle on `side` may touch the circle of `other`: left, right.
    ///
    /// With signed radii (positive on the left) the centres lie `across` = ρ2 − ρ1 to the left of a tangent's direction
    /// from each other. So the tangent turns to the left of a direction if the other centre lies further left of that
    /// than `across`: exact while it turns from the line of centres by at most a third of a right angle and ranges are
    /// narrow. Otherwise either side is allowed for.
    pub(crate) fn may_reach(&self, side: Side, other: &Self) -> [Option<Side>; 2] {
        let between = other.center - self.center;
        let slack = SLACK_MM + SLACK_RATIO * (between.x.abs() + between.y.abs());
        let is_sharp = self.narrow && other.narrow;
        let square = between.norm_squared();
        [Side::Left, Side::Right].map(|other_side| {
            let across = other.radius * other_side.sign() - self.radius * side.sign();
            let is_near = square < 4.0 * across * across;
            if is_sharp && is_near && across.abs() - 2.0 * CONTACT_TOLERANCE_MM > square.sqrt() {
                return None;
            }
            let (across, slack) = if is_sharp && !is_near {
                (across, slack)
            } else {
                (0.0, slack + self.radius + other.radius)
            };
            let may =
                self.admits(side, between, across, slack) && other.admits(other_side, between, across, slack);
            may.then_some(other_side)
        })
    }

    /// Whether a tangent that leaves the circle on `side` may lead to a place within `slack` of `to`.
    pub(crate) fn may_lead_to(&self, side: Side, to: Point, slack: f64) -> bool {
        let between = to - self.center;
        let slack = slack + SLACK_MM + SLACK_RATIO * (between.x.abs() + between.y.abs());
        self.admits(side, between, 0.0, slack)
    }

    /// Whether a way with the centre of one circle `across` to the left of its direction from the other's, which lies
    /// along `between`, runs along the circle on `side` within the range.
    fn admits(&self, side: Side, between: Vector, across: f64, slack: f64) -> bool {
        let (after_first, before_last) = (cross(self.first, between), cross(between, self.last));
        self.wide
            || match side {
                Side::Left => after_first >= across - slack && before_last >= -across - slack,
                Side::Right => after_first <= -across + slack && before_last <= across + slack,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::Tangent;
    use rand::RngExt;
    use std::f64::consts::TAU;
    use traverse_solve::Seed;

    /// No tangent that leaves and arrives within both ranges is left out, and most others are.
    #[test]
    fn every_tangent_passes() {
        let mut random = Seed(7).stream();
        let (mut tangents, mut passed) = (0, 0);
        for _ in 0..400_000 {
            let mut feature = |near: f64| Feature {
                center: Point::new(random.random_range(-near..near), random.random_range(-near..near)),
                plan_radius: [1e-6, 1.0, random.random_range(0.1..4.0)][random.random_range(0..3)],
                price_radius: 0.0,
                start_angle: random.random_range(0.0..TAU),
                sweep: random.random_range(0.0..2.5),
                before: None,
                after: None,
                straight_after: None,
                owner: 0,
            };
            let (one, other) = (feature(4.0), feature(9.0));
            for side in [Side::Left, Side::Right] {
                let may = Sector::of(&one).may_reach(side, &Sector::of(&other));
                for (other_side, may) in [Side::Left, Side::Right].into_iter().zip(may) {
                    let (rho1, rho2) = (one.plan_radius * side.sign(), other.plan_radius * other_side.sign());
                    let tangent = Tangent::between(one.center, rho1, other.center, rho2).filter(|tangent| {
                        let error = tangent.angle_error;
                        one.offset_of(-tangent.normal * side.sign(), error).is_some()
                            && other.offset_of(-tangent.normal * other_side.sign(), error).is_some()
                    });
                    assert!(tangent.is_none() || may.is_some(), "{one:?} {side:?} {other:?} {other_side:?}");
                    tangents += u32::from(tangent.is_some());
                    passed += u32::from(may.is_some());
                }
            }
        }
        assert!(tangents > 30_000 && passed < 4 * tangents, "{passed} for {tangents}");
    }
}
