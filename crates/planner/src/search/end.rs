//! Start and target as the search sees them.

use traverse_geometry::Point;

/// An end of the move: where it is, and where a planned path may stand for it.
#[derive(Clone, Debug)]
pub(crate) struct End {
    /// Where the tool's centre is.
    pub(crate) point: Point,
    /// Itself; or, where it lies on the border of an obstacle that is planned at one contact tolerance, the places
    /// that far from the border. Empty: it is shut in between obstacles that touch.
    pub(crate) places: Vec<Point>,
    /// Owners of the barriers that shut it in.
    pub(crate) shut_in_by: Vec<usize>,
}
