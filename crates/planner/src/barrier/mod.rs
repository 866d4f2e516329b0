//! Barriers: obstacles grown by their clearance, as what blocks a move and what a path bends round.
//!
//! Nothing is offset as a whole and no union is built. A barrier is taken apart into [`Blocker`]s, edges that a move
//! keeps a distance from, and [`Feature`]s, the corners and arcs that a shortest path can bend round. What lies
//! inside another barrier is found blocked when the search gets there.
//!
//! **Clearance 0** is the limit of ever smaller clearances. It is planned at one contact tolerance (1e-6 mm), so
//! that obstacles that touch let nothing pass and the tool still slides along edges and past vertices, and it is
//! priced at 0: costs and the path that is answered come from the obstacle's own corners. See
//! docs/decisions/0001-clearance-zero.md.

mod blocked_offsets;
mod blocker;
mod feature;
mod grid;
mod miter;
mod obstruction;
mod obstruction_parts;
mod oriented_ring;
mod outline;
mod quick_test;
mod run;

pub(crate) use blocker::Blocker;
pub(crate) use feature::{Feature, Side};
pub(crate) use grid::{Grid, Load};
pub(crate) use miter::miter_gauge;
pub(crate) use obstruction::Obstruction;
pub(crate) use obstruction_parts::ObstructionParts;
pub(crate) use oriented_ring::OrientedRing;
pub(crate) use outline::{Clearance, Outline};
