//! Where a placed section touches what stopped it.

use traverse_geometry::Point;

/// Where a placed section touches what stopped it. A section that the start of the strip stopped, or the rule that
/// none passes the left edge of the one before it, has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Number in the order.
    pub index: usize,
    /// Number in the order of the earlier section that it touches.
    pub against: usize,
    /// On the section's border, in the layout, millimetres.
    pub point: Point,
    /// On the other's border: as far away as the gap asks for.
    pub against_point: Point,
}
