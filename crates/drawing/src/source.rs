//! What a file says of a curve beside its shape: by that it is chosen for a role.

use crate::Color;

/// A group as it is drawn: a block that is inserted twice, or a symbol that is used twice, is drawn twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DrawnGroup {
    /// Which of the file, in the order of drawing, from 0.
    pub number: u32,
    /// Its place in [`Source::groups`].
    pub place: usize,
}

/// What a file says of a curve beside its shape and layer. Shared by the curves of one entity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// Its own name: the id of an SVG element, the handle of a DXF entity.
    pub id: Option<String>,
    /// Names of the groups around it, outermost first: ids of SVG groups, names of DXF blocks.
    pub groups: Vec<String>,
    /// The outermost of these groups that is no layer.
    pub drawn_group: Option<DrawnGroup>,
    /// The colour that it is drawn in, as far as the file says.
    pub color: Option<Color>,
}
