//! Ends of a rapid move that lie inside a barrier.

use std::borrow::Cow;
use std::fmt;

/// An end of a rapid move that lies inside a barrier.
#[derive(Clone, Debug, PartialEq)]
pub struct InsideEnd {
    /// `start`, `target`, or where it stands in a list of points, such as `from_xy_mm[4]`.
    pub field: Cow<'static, str>,
    /// The obstacle's id, or `work_area`.
    pub obstacle: String,
    /// How far inside, millimetres.
    pub depth_mm: f64,
}

impl fmt::Display for InsideEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, obstacle, depth_mm } = self;
        write!(
            f,
            "{field} lies {depth_mm} mm inside the barrier of {obstacle}: move it out or lower the clearance"
        )
    }
}

/// An end of a rapid move inside a barrier that no permitted way leads out of.
#[derive(Clone, Debug, PartialEq)]
pub struct ShutInEnd {
    /// `start`, `target`, or where it stands in a list of points, such as `from_xy_mm[4]`.
    pub field: Cow<'static, str>,
    /// The obstacle's id, or `work_area`.
    pub obstacle: String,
    /// Why there is no way.
    pub why: &'static str,
}

impl fmt::Display for ShutInEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, obstacle, why } = self;
        write!(
            f,
            "{field} lies in the barrier of {obstacle} and has no way out: {why}; move it, choose another rule or lower \
             the clearance"
        )
    }
}
