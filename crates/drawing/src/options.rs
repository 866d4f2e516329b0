//! How a file is read.

use crate::LengthUnit;

/// How a file is read, and how much of it at most.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReadOptions {
    /// Longest file, bytes. Default: 64 MiB.
    pub byte_limit: u64,
    /// Most entities of all types, in blocks as often as they are drawn. Default: 400 000.
    pub entity_limit: usize,
    /// Most vertices of all curves together. Default: 2 000 000.
    pub vertex_limit: usize,
    /// How far arcs and segments may run from the ellipse or spline that they stand for, millimetres. Default: 0.001.
    pub fit_tolerance_mm: f64,
    /// The unit of a file that does not name one. Default: millimetres.
    pub default_unit: LengthUnit,
    /// Pixels in an inch: sizes of SVG files that give none in millimetres, inches or the like. Default: 96, as CSS
    /// says; older Inkscape took 90, Illustrator 72.
    pub pixels_per_inch: f64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self {
            byte_limit: 64 << 20,
            entity_limit: 400_000,
            vertex_limit: 2_000_000,
            fit_tolerance_mm: 0.001,
            default_unit: LengthUnit::MILLIMETRES,
            pixels_per_inch: 96.0,
        }
    }
}
