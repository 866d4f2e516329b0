//! Labels: ways of touching a feature, and the route that they add up to.

use crate::barrier::Side;
use traverse_geometry::{Point, Vector};

/// Where a label is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// At the start, or one of the places that stand for it.
    Start,
    /// At a feature, having arrived at `offset`, with its circle on that side.
    Feature { feature: usize, side: Side, offset: f64 },
    /// At the target, or one of the places that stand for it.
    Target,
}

/// How a label was reached from its parent.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// Not at all: a start.
    Begin,
    /// Along a tangent, left at this offset of the parent's feature.
    Tangent { left_at: f64 },
    /// Without a straight move: the parent's feature goes over into this one at this offset of the parent's.
    Over { left_at: f64 },
}

/// One way of touching a feature, and what it costs so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label {
    pub(crate) place: Place,
    pub(crate) step: Step,
    pub(crate) parent: usize,
    /// Millimetres from the start.
    pub(crate) cost: f64,
    /// Where the planned path is: end of the planned straight move from `plan_from`.
    pub(crate) plan_from: Point,
    pub(crate) plan_at: Point,
    /// Outward direction of the feature on the answered path at arrival.
    pub(crate) spoke: Vector,
    /// The same direction where the parent's feature was left.
    pub(crate) left_spoke: Vector,
}

/// One feature that a route bends round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub(crate) feature: usize,
    pub(crate) side: Side,
    /// Outward directions on the answered path at arrival and departure, and the angle turned between.
    pub(crate) spoke_in: Vector,
    pub(crate) spoke_out: Vector,
    pub(crate) turned: f64,
}

/// A shortest path among some barriers.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    /// What it costs, millimetres.
    pub(crate) cost: f64,
    /// Features that it bends round, in order.
    pub(crate) stops: Vec<Stop>,
}
