//! An end of a rapid move that lies inside a barrier.

use std::fmt;

/// An end of a rapid move that lies inside a barrier.
#[derive(Clone, Debug, PartialEq)]
pub struct InsideEnd {
    /// `start` or `target`.
    pub field: &'static str,
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
