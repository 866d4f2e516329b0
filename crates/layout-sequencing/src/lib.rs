//! In which order, and in which pose, the sections of a cutting layout join tightest: exact joins, true lengths, lower
//! bounds always and mostly a proof.

mod answer;
mod certificate;
mod contact;
mod options;

pub use answer::{Ending, LayoutAnswer, LayoutPlan};
pub use certificate::{BoundCertificate, JoinDuals};
pub use contact::Contact;
pub use options::{Algorithm, EffectModel, InnerOverlap, OrderOptions};

use traverse_geometry::{Finding, PlacedSection, Pose, Section, SectionLayout};
use traverse_solve::{Budget, Interrupt, Observer};

/// Orders the sections of a layout.
///
/// # Errors
/// Everything that is wrong with the question, as [`layout_findings`] says; none when the budget ends meanwhile.
pub fn order_sections(
    layout: &SectionLayout,
    options: &OrderOptions,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<LayoutAnswer, Vec<Finding>> {
    let _ = (layout, options, budget, observer);
    Err(vec![])
}

/// Everything that is wrong with a question; none for one that [`order_sections`] takes. Fields are relative to the
/// request: `sections[3].quantity`, `gap_mm`, `first_section_id`, `precedences[1].before_section_id`,
/// `forbidden_joins[0].left_section_id`, `initial_order[2].section_id`.
///
/// # Errors
/// When the budget ends first: looking for parts that overlap can take long.
pub fn layout_findings(
    layout: &SectionLayout,
    options: &OrderOptions,
    budget: &Budget,
) -> Result<Vec<Finding>, Interrupt> {
    let _ = (layout, options, budget);
    Ok(vec![])
}

/// One section in one pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct JoinItem {
    /// Which section.
    pub section: usize,
    /// How it is turned.
    pub pose: Pose,
}

/// The effects of all ordered pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct JoinMatrix {
    /// Every section in each of its poses, in the order of the layout.
    pub items: Vec<JoinItem>,
    /// `effects_mm[i · n + j]`: how far item j slides into item i standing on its left, against joining their bounding
    /// boxes with the gap between them. At most width and gap: no section passes the left edge of the one before it.
    pub effects_mm: Vec<f64>,
}

/// The effects of all ordered pairs of (section, pose), on `threads` threads.
///
/// # Errors
/// When the budget ends first.
pub fn joins(
    layout: &SectionLayout,
    model: EffectModel,
    threads: usize,
    budget: &Budget,
) -> Result<JoinMatrix, Interrupt> {
    let _ = (layout, model, threads, budget);
    Ok(JoinMatrix { items: vec![], effects_mm: vec![] })
}

/// How one section stands tightly to the right of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Join {
    /// From the left section's left edge to the right section's left edge, millimetres. Absent: they share no height,
    /// nothing is in the way.
    pub offset_mm: Option<f64>,
    /// As [`JoinMatrix::effects_mm`].
    pub effect_mm: f64,
    /// Where they touch, on the left and on the right section, with the left section's left edge at x = 0 and the
    /// right one at the offset. Absent with the offset.
    pub witness: Option<[traverse_geometry::Point; 2]>,
}

/// The exact join of two sections in their poses, `gap_mm` apart.
#[must_use]
pub fn join(left: (&Section, Pose), right: (&Section, Pose), gap_mm: f64) -> Join {
    let _ = (left, right, gap_mm);
    Join { offset_mm: None, effect_mm: 0.0, witness: None }
}

/// The effect as published in 2009, millimetres: from local extremes of parts near the joint only. The gap plays no
/// part: it stands between the boxes before and after.
#[must_use]
pub fn published_effect(left: (&Section, Pose), right: (&Section, Pose)) -> f64 {
    let _ = (left, right);
    0.0
}

/// Places an order exactly: each section as far left as the slide rule lets it go. `order` as
/// [`OrderOptions::initial_order`], but any part of it will do.
#[must_use]
pub fn place(layout: &SectionLayout, order: &[PlacedSection]) -> Vec<PlacedSection> {
    let _ = layout;
    order.to_vec()
}

/// Places an order as the published model has it, by effects of neighbours alone: sections may overlap.
#[must_use]
pub fn place_as_published(layout: &SectionLayout, order: &[PlacedSection]) -> Vec<PlacedSection> {
    let _ = layout;
    order.to_vec()
}

/// The right end of what reaches furthest, millimetres; 0 for nothing.
#[must_use]
pub fn layout_length_mm(layout: &SectionLayout, placed: &[PlacedSection]) -> f64 {
    let _ = (layout, placed);
    0.0
}

/// What stopped each section of a layout as [`place`] gives it.
#[must_use]
pub fn contacts(layout: &SectionLayout, placed: &[PlacedSection]) -> Vec<Contact> {
    let _ = (layout, placed);
    vec![]
}
