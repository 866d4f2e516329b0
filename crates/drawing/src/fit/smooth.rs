//! A curve that has a direction everywhere.

use traverse_geometry::{Point, Vector};

/// A curve without corners, run through from t = 0 to t = 1. Its derivative may vanish, best at the ends only.
pub(crate) trait Smooth {
    /// The point at `t`.
    fn point(&self, t: f64) -> Point;

    /// The point and the derivative by `t`.
    fn at(&self, t: f64) -> (Point, Vector);
}
