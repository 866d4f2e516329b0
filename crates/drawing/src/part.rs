//! Parts and sections of a drawing.

use traverse_geometry::Polygon;

/// A part to be cut out.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// `LAYER/1`, `LAYER/2`, … in the order in which their outer loops were drawn.
    pub id: String,
    /// Its outline and holes.
    pub shape: Polygon,
    /// How far at most the outline runs from what was drawn, millimetres.
    pub deviation_mm: f64,
}

/// A section of a cutting layout: shapes that keep their places to one another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// The name that it was chosen by: of a group, a layer, an id or a colour.
    pub id: String,
    /// Its shapes, in the order in which they were drawn.
    pub shapes: Vec<Polygon>,
    /// How far at most an outline runs from what was drawn, millimetres.
    pub deviation_mm: f64,
}
