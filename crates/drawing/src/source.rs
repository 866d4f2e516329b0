//! What a file says of a curve beside its shape: by that it is chosen for a role.

use crate::Color;

/// What a file says of a curve beside its shape and layer. Shared by the curves of one entity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// Its own name: the id of an SVG element, the handle of a DXF entity.
    pub id: Option<String>,
    /// Names of the groups around it, outermost first: ids of SVG groups, names of DXF blocks.
    pub groups: Vec<String>,
    /// The colour that it is drawn in, as far as the file says.
    pub color: Option<Color>,
}
