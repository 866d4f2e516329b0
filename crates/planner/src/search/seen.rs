//! What a search along links needs to know of a prepared scene.

use super::Ground;
use crate::barrier::Side;
use crate::prepared::Link;
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt};

/// Where links and the tests of other moves come from.
pub(crate) trait Moves {
    type Ground: Ground;

    fn ground(&self) -> &Self::Ground;

    /// Works out what can be seen from a feature on one side, unless it is known.
    ///
    /// # Errors
    /// The budget ended.
    fn see(&mut self, feature: u32, side: Side, budget: &Budget) -> Result<(), Interrupt>;

    /// What can be seen from there, once that was worked out.
    fn links(&self, feature: u32, side: Side) -> &[Link];

    /// Whether all of a feature's range is free.
    fn is_whole(&self, feature: u32) -> bool;

    /// Whether nothing blocks a straight move.
    fn is_free(&self, from: Point, to: Point) -> bool;
}
