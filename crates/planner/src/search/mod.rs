//! The shortest path among a set of barriers: best first over the tangents between their features.
//!
//! A path that can't be shortened runs on common tangents of features and bends round them along arcs. The search
//! keeps a label for each way of touching a feature: which, on which side, at which offset. One label per feature
//! and side is not enough as soon as radii are above 0: an early arrival that costs more can still serve departures
//! that a later, cheaper one has passed, and arcs blocked by other barriers split a circle.

mod alternatives;
mod best;
mod bundles;
mod circles;
mod departure;
mod directions;
mod end;
mod fan;
mod ground;
mod known;
mod label;
mod route;
mod sector;
mod seen;
mod settled;
mod shortest;
mod spread;
mod stance;
mod successors;
mod tangent;
mod trail;
mod tree;

pub(crate) use alternatives::{Between, locally_shortest};
pub(crate) use best::{Best, TURN_TOLERANCE};
pub(crate) use circles::{Circles, is_same_circle};
pub(crate) use departure::small_angle;
pub(crate) use end::End;
#[cfg(test)]
pub(crate) use fan::Turn;
pub(crate) use fan::{Aim, Bend, Fan, outside};
pub(crate) use ground::{Ground, Stretches};
pub(crate) use known::Known;
use known::Way;
pub(crate) use label::{Route, Stop};
pub(crate) use sector::Sector;
pub(crate) use seen::Moves;
pub(crate) use shortest::{LABEL_LIMIT, Search};
pub(crate) use spread::{Goal, Sighted, Spread};
pub(crate) use tangent::Tangent;
pub(crate) use tree::Room;
