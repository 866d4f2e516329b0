//! Stances: labels that were looked into, about to leave where they are.

use super::Tangent;
use super::departure::Departure;
use super::label::Label;
use crate::barrier::{Feature, Side};
use traverse_geometry::{Point, Vector, left_of};

/// A label that was looked into.
#[derive(Clone, Copy)]
pub(super) struct Stance {
    pub(super) label: Label,
    pub(super) from: From,
}

/// Where a straight move begins: a place that stands for the start, or a feature.
#[derive(Clone, Copy)]
pub(super) enum From {
    Start(Point),
    Feature(Departure),
}

/// A straight move: as it is planned, and as the answered path has it.
#[derive(Clone, Copy)]
pub(super) struct Leg {
    pub(super) planned: Tangent,
    /// Left normal of its direction on the answered path.
    pub(super) normal: Vector,
    /// Its length on the answered path, millimetres.
    pub(super) length: f64,
}

impl Leg {
    /// A move that is answered as it is planned.
    pub(super) fn as_planned(planned: Tangent) -> Self {
        Self { planned, normal: planned.normal, length: planned.length }
    }
}

impl From {
    /// Straight to `circle`, which lies on `side`, for a path from `start`.
    pub(super) fn leg_to(&self, circle: &Feature, side: Side, start: Point) -> Option<Leg> {
        let planned = self.planned(circle.center, circle.plan_radius * side.sign())?;
        let price_rho = circle.price_radius * side.sign();
        let (at, rho) = self.priced(start);
        // Where the priced circles nest by a tolerance, or the start is the corner itself, nothing lies between.
        let price = Tangent::between(at, rho, circle.center, price_rho);
        let (normal, length) = price.map_or((planned.normal, 0.0), |price| (price.normal, price.length));
        Some(Leg { planned, normal, length })
    }

    /// Straight to `target`, for which `place` stands, for a path from `start`.
    pub(super) fn leg_to_end(&self, place: Point, target: Point, start: Point) -> Option<Leg> {
        let (at, rho) = self.priced(start);
        let planned = match self {
            // Both may stand in the same place on a border.
            Self::Start(at) if *at == place => Tangent::nowhere(place),
            _ => self.planned(place, 0.0)?,
        };
        if let Self::Start(_) = self {
            let by = target - start;
            let normal = left_of(by).try_normalize(0.0).unwrap_or(planned.normal);
            return Some(Leg { planned, normal, length: by.norm() });
        }
        let price = Tangent::between(at, rho, target, 0.0)?;
        Some(Leg { planned, normal: price.normal, length: price.length })
    }

    /// The outward direction in which the answered path leaves along `leg`; zero at the start.
    pub(super) fn spoke_along(&self, leg: &Leg) -> Vector {
        match self {
            Self::Start(_) => Vector::zeros(),
            Self::Feature(departure) => -leg.normal * departure.lane.side.sign(),
        }
    }

    /// Its circle as the answered path has it: a point for the start.
    fn priced(&self, start: Point) -> (Point, f64) {
        match self {
            Self::Start(_) => (start, 0.0),
            Self::Feature(departure) => (departure.circle.center, departure.rho().1),
        }
    }

    fn planned(&self, center: Point, rho: f64) -> Option<Tangent> {
        match self {
            Self::Start(at) => Tangent::between(*at, 0.0, center, rho),
            Self::Feature(departure) => {
                Tangent::between(departure.circle.center, departure.rho().0, center, rho)
            }
        }
    }
}
