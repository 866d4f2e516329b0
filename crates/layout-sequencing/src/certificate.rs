//! What proves a lower bound without any search, in a form that another program recomputes.

/// What proves a lower bound without any search.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum BoundCertificate {
    /// Nothing: the bound is 0.
    #[default]
    None,
    /// Only where sections keep their order: duals of the joins. Holds whatever is forbidden or precedes.
    Joins(JoinDuals),
    /// The layout is at least as long as the thicknesses of all copies at this height add up to, with a gap between
    /// each two that reach the height in every pose. The thickness of a section at a height is the distance from its
    /// leftmost to its rightmost point there, of its allowed poses the least. Holds for both slide rules.
    Height {
        /// The height, millimetres.
        y_mm: f64,
    },
    /// The layout is at least as long as this section's least width in its allowed poses.
    Width {
        /// Which section.
        section: usize,
    },
}

/// Duals of joins. With row duals u, column duals v and weights w ≥ 0 of sets S of nodes such that for every arc
/// u_i + v_j + Σ over sets with i in and j out of w ≤ c_ij, every layout is at least Σ q·u + Σ q·v + Σ w long.
///
/// Nodes are the sections, each visited as often as its quantity q says, and last the ends of the strip, visited once.
/// The arc between two sections costs the least offset of their joins in any allowed poses, not below 0 (also from a
/// section to another copy of itself); the arc to the ends costs the section's least width; the arc from the ends
/// costs nothing. Where a section is named first, arcs from the ends to others don't count, and likewise for last;
/// arcs of forbidden joins don't count. Offsets are those of left edges, a nanometre may be missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JoinDuals {
    /// u, millimetres, one for each section and one for the ends.
    pub row_mm: Vec<f64>,
    /// v, likewise.
    pub column_mm: Vec<f64>,
    /// Sets that every layout must leave, some but not all nodes each, with their weight in millimetres.
    pub sets: Vec<(Vec<usize>, f64)>,
}
