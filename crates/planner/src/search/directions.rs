//! A range of directions of travel, and a quick test whether a way may run in one of them. It errs on the side of
//! letting ways pass.

use crate::barrier::Side;
use std::f64::consts::PI;
use traverse_geometry::{Vector, cross, left_of, unit};

/// Ranges wider than this have every direction, radians: short of half a turn by more than rounding.
const WIDE_RAD: f64 = PI - 1e-6;

/// What distances are taken for nearer by, as a share: above rounding where a tangent hardly turns from the line of centres.
const NEAR_RATIO: f64 = 1.05;

/// The directions of travel along one side of circles. With them on the left they turn counter-clockwise from `first` to
/// `last`; with them on the right the opposite ones do, the other way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Directions {
    first: Vector,
    last: Vector,
    /// About half a turn or more: every direction passes.
    wide: bool,
    /// Circles whose centres are further apart than this many times `across` ([`Self::admits`]) tell what passes; nearer
    /// ones don't. Infinite where none do.
    pub(super) near: f64,
}

impl Directions {
    /// Every direction.
    pub(super) const ALL: Self =
        Self { first: Vector::new(0.0, 0.0), last: Vector::new(0.0, 0.0), wide: true, near: f64::INFINITY };

    /// Along circles on the left that are touched from angle `from` to angle `to`, radians.
    pub(super) fn touching(from: f64, to: f64) -> Self {
        Self::between([from, to].map(unit), to - from)
    }

    /// Along circles on the left that are touched where a radius has one of these directions, from the first
    /// counter-clockwise to the last, `sweep` radians apart.
    pub(super) fn between([first, last]: [Vector; 2], sweep: f64) -> Self {
        let (first, last) = (left_of(first), left_of(last));
        let wide = sweep > WIDE_RAD;
        // With the line of centres turned by α from a tangent that is θ after the first direction, sin(θ + α) ≥ sin α as long as
        // θ ≤ π − 2α; sin α is `across` by the distance.
        let near = if wide { f64::INFINITY } else { NEAR_RATIO / (sweep / 2.0).cos() };
        Self { first, last, wide, near }
    }

    /// Whether a way may run along a circle on `side` in one of these directions: the centre that it comes from or goes to
    /// next lies somewhere between `ends` from that of the circle, `across` to the left of it, within `slack`.
    pub(super) fn admits<const N: usize>(
        &self,
        side: Side,
        ends: &[Vector; N],
        across: f64,
        slack: f64,
    ) -> bool {
        if self.wide {
            return true;
        }
        // Linear in the place: greatest at an end.
        let any =
            |after: fn(&Self, Vector) -> f64, least: f64| ends.iter().any(|&end| after(self, end) >= least);
        match side {
            Side::Left => any(Self::after_first, across - slack) && any(Self::before_last, -across - slack),
            Side::Right => any(Self::before_first, across - slack) && any(Self::after_last, -across - slack),
        }
    }

    fn after_first(&self, way: Vector) -> f64 {
        cross(self.first, way)
    }

    fn before_first(&self, way: Vector) -> f64 {
        -cross(self.first, way)
    }

    fn before_last(&self, way: Vector) -> f64 {
        cross(way, self.last)
    }

    fn after_last(&self, way: Vector) -> f64 {
        -cross(way, self.last)
    }
}
