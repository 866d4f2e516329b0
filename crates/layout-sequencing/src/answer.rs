//! What ordering says: the layout, how good it is known to be, and why the search stopped.

use crate::certificate::BoundCertificate;
use crate::contact::Contact;
use traverse_geometry::PlacedSection;
use traverse_solve::Interrupt;

/// Why the search stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No layout is shorter, among those that are reached by sliding in x. Of up to some 20 sections, more than 1.07 m long
    /// together, tables count in units of length / 2³⁰: shorter by no more than one of those for each section and one more
    /// (0.4 µm at 20 sections of 1 m); the bound is then lower than the length by as much.
    ProvenOptimal,
    /// Forbidden joins, ends and precedence leave no order.
    ProvenInfeasible,
    /// The gap limit is reached.
    GapReached,
    /// The method has nothing more to try, and proves nothing.
    Exhausted,
    /// The budget ended.
    Interrupted(Interrupt),
}

/// A layout: sections side by side, none overlapping another.
#[derive(Clone, Debug, PartialEq)]
pub struct LayoutPlan {
    /// Every copy of every section, in order from left to right. Left edges are whole nanometres.
    pub order: Vec<PlacedSection>,
    /// The right end of what reaches furthest, millimetres; the strip begins at 0.
    pub length_mm: f64,
    /// The same order joined by bounding boxes, a gap between each two.
    pub bounding_box_length_mm: f64,
    /// What the published model says of this order: the sum of widths and gaps less the published effects of
    /// neighbours. Shorter than any layout can be where those are too large.
    pub published_length_mm: f64,
    /// What stopped each section, at most one contact for each.
    pub contacts: Vec<Contact>,
}

/// What ordering says.
#[derive(Clone, Debug, PartialEq)]
pub struct LayoutAnswer {
    /// The best layout found. Absent: no order is allowed, none was found, or the work was cancelled.
    pub plan: Option<LayoutPlan>,
    /// No layout is shorter; the engine's word. Never above the plan's length; equal to it when proven, but for what
    /// [`Ending::ProvenOptimal`] may miss.
    pub lower_bound_mm: f64,
    /// What can be recomputed without a search.
    pub certificate: BoundCertificate,
    /// The length that the certificate proves, millimetres; never above `lower_bound_mm`.
    pub certified_lower_bound_mm: f64,
    /// Why the search stopped.
    pub ending: Ending,
    /// Kicks of local search, layouts tried and nodes of searches, all together.
    pub iterations: u64,
    /// The method that decided, [`crate::Algorithm::name`].
    pub algorithm: &'static str,
}

impl LayoutAnswer {
    /// Whether the search closed the gap.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        matches!(self.ending, Ending::ProvenOptimal | Ending::ProvenInfeasible)
    }
}
