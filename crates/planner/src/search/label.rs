//! Labels: ways of touching a feature, found and not yet looked into, and the route that they add up to.
//!
//! There are many of them, nearly all never looked into: a label holds what can't be worked out again from the one
//! that it came from ([`super::Stance`]).

use crate::barrier::{Feature, Side};
use traverse_geometry::{Point, Vector};

/// Where a label is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At this one of the places that stand for the start.
    Start(u32),
    /// At a feature with its circle on that side.
    Feature(u32, Side),
    /// At this one of the places that stand for the target.
    Target(u32),
}

/// How a label is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Not at all: a start.
    Begin,
    /// Along a tangent.
    Tangent,
    /// Along a tangent that is known to be free.
    #[allow(dead_code, reason = "for searches from one end to many")]
    Link,
    /// Without a straight move: the feature before goes over into this one.
    Over,
}

/// One way of touching a feature, and what it costs so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label {
    /// From the start.
    pub(crate) cost: f64,
    /// The offset of the feature before at which it is left.
    pub(crate) left_at: f64,
    /// The offset of arrival; 0 at the ends.
    pub(crate) offset: f64,
    pub(crate) place: Place,
    /// The stance that it comes from; of no meaning at a start.
    pub(crate) parent: u32,
    pub(crate) step: Step,
}

/// One feature that a route bends round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub(crate) circle: Feature,
    pub(crate) side: Side,
    /// Outward directions on the answered path at arrival and departure, and the angle turned between.
    pub(crate) spoke_in: Vector,
    pub(crate) spoke_out: Vector,
    pub(crate) turned: f64,
}

/// A shortest path among some barriers.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    /// What it costs.
    pub(crate) cost: f64,
    /// Features that it bends round, in order.
    pub(crate) stops: Vec<Stop>,
    /// The places that stand for start and target.
    pub(crate) places: [Point; 2],
}
