//! SVG in: shapes, paths, nested pages, symbols and their uses.
//!
//! The `roxmltree` crate reads the XML and `svgtypes` the lists of numbers and commands; all geometry is here, in
//! double precision, and circular arcs stay circular arcs. What XML could make costly (entities that repeat,
//! thousands of attributes or namespaces) is bounded before it is parsed ([`bounds`]), and every use of an element is
//! counted like an element ([`budget`]). Cost: linear in what is drawn.

mod affine;
mod arc_command;
mod bounds;
mod budget;
mod curve;
mod element;
mod encoding;
mod layers;
mod length;
mod outline;
mod page;
mod path_data;
mod properties;
mod reader;
mod shapes;
mod style;
mod style_sheet;
mod transform;
mod unused_count;
mod viewport;
mod walk;

pub(crate) use encoding::is_utf16;
pub use reader::{read_svg, read_svg_from};
