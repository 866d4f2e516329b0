//! A point of a route: where it is planned, and where the answer has it.

use crate::search::Stop;
use traverse_geometry::{Point, Vector};

/// Where a route is planned to pass, and where the answered path passes. They differ by at most a contact tolerance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) planned: Point,
    pub(super) priced: Point,
}

impl Pair {
    /// Where a stop's circle is reached.
    pub(super) fn arrival(stop: &Stop) -> Self {
        Self::beside(stop, stop.spoke_in)
    }

    /// Where it is left.
    pub(super) fn departure(stop: &Stop) -> Self {
        Self::beside(stop, stop.spoke_out)
    }

    /// So many radii from the circle's centre.
    pub(super) fn beside(stop: &Stop, radii: Vector) -> Self {
        let circle = &stop.circle;
        Self {
            planned: circle.center + radii * circle.plan_radius,
            priced: circle.center + radii * circle.price_radius,
        }
    }

    /// The middle between two.
    pub(super) fn middle(self, other: Self) -> Self {
        Self {
            planned: nalgebra::center(&self.planned, &other.planned),
            priced: nalgebra::center(&self.priced, &other.priced),
        }
    }
}
