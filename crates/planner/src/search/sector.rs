//! Directions that a way may have where it touches a feature: a quick test that leaves out most tangents before any
//! root or angle is worked out. It errs on the side of letting them pass; the tangent itself decides.

use super::departure::Departure;
use super::directions::Directions;
use crate::barrier::{Feature, Side};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Point, Vector};

/// What a direction may be off, as a share of the way: above the tolerance of offsets.
const SLACK_RATIO: f64 = 1e-8;

/// The same for ways of no length, millimetres: above the rounding of coordinates.
const SLACK_MM: f64 = 1e-8;

/// The directions of travel along one side of a circle, over a range of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sector {
    pub(super) center: Point,
    pub(super) radius: f64,
    pub(super) directions: Directions,
}

impl Sector {
    /// All of a feature's range.
    pub(crate) fn of(feature: &Feature) -> Self {
        Self::over(feature, 0.0, feature.sweep)
    }

    /// Every direction from a point.
    pub(crate) fn all_round(center: Point) -> Self {
        Self { center, radius: 0.0, directions: Directions::ALL }
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
        let ends = [from, to].map(|offset| feature.direction_at(offset));
        let directions = Directions::between(ends, to - from);
        Self { center: feature.center, radius: feature.plan_radius, directions }
    }

    /// On which sides a tangent that leaves this sector's circle on `side` may touch the circle of `other`: left, right.
    ///
    /// With signed radii (positive on the left) the centres lie `across` = ρ2 − ρ1 to the left of a tangent's direction
    /// from each other. So the tangent turns to the left of a direction if the other centre lies further left of that
    /// than `across`: exact while the centres are not too near for the ranges. Otherwise either side is allowed for.
    pub(crate) fn may_reach(&self, side: Side, other: &Self) -> [Option<Side>; 2] {
        let between = other.center - self.center;
        let slack = slack(between);
        let near = self.directions.near.max(other.directions.near);
        let square = between.norm_squared();
        [Side::Left, Side::Right].map(|other_side| {
            let across = other.radius * other_side.sign() - self.radius * side.sign();
            let is_near = square < near * near * across * across;
            if near.is_finite() && is_near && across.abs() - 2.0 * CONTACT_TOLERANCE_MM > square.sqrt() {
                return None;
            }
            let (across, slack) = if near.is_finite() && !is_near {
                (across, slack)
            } else {
                (0.0, slack + self.radius + other.radius)
            };
            let may = self.directions.admits(side, &[between], across, slack)
                && other.directions.admits(other_side, &[between], across, slack);
            may.then_some(other_side)
        })
    }

    /// Whether a tangent that leaves the circle on `side` may lead to a place within `slack` of `to`.
    pub(crate) fn may_lead_to(&self, side: Side, to: Point, slack: f64) -> bool {
        let between = to - self.center;
        self.directions.admits(side, &[between], 0.0, slack + self::slack(between))
    }
}

/// What the way between centres may be off.
pub(super) fn slack(between: Vector) -> f64 {
    SLACK_MM + SLACK_RATIO * (between.x.abs() + between.y.abs())
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
