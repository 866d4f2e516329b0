//! CheckSections' question, and orders that clients read from answers.

use super::layout::WireLayout;
use super::order::inner_overlap;
use super::reader::Reader;
use crate::{Limits, Refused, v1};
use traverse_checker::BoundClaim;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Finding, PlacedSection, Reason, SectionLayout};
use traverse_layout_sequencing::InnerOverlap;
use traverse_solve::Budget;

/// What CheckSections asks. Every value is sound by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckSectionsQuestion {
    /// What was to be laid out.
    pub layout: SectionLayout,
    /// Whether parts may overlap inside their section.
    pub inner_overlap: InnerOverlap,
    /// The layout to check, left to right.
    pub order: Vec<PlacedSection>,
    /// How much nearer than the gap parts of different sections may come, millimetres.
    pub tolerance_mm: f64,
    /// What is said of all layouts beside it.
    pub bound_claim: Option<BoundClaim>,
}

impl CheckSectionsQuestion {
    /// Reads and validates a request. `budget` is asked between its parts.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(
        request: v1::CheckSectionsRequest,
        limits: &Limits,
        budget: &Budget,
    ) -> Result<Self, Refused> {
        let mut reader = Reader::new(limits, budget);
        if let Some(request) = &request.request {
            reader.layout_fits("request.", request);
        }
        reader.at_most("order", "sections", request.order.len(), limits.section_count);
        reader.so_far()?;
        let holds = |mm: f64| (1e-9..=1.0).contains(&mm);
        let tolerance_mm = match request.tolerance_mm {
            None => Some(CONTACT_TOLERANCE_MM),
            Some(mm) => reader.within("tolerance_mm", mm, holds, "1e-9 to 1 mm"),
        };
        let Some(mut asked) = request.request else {
            reader.missing("request", "the OrderSectionsRequest that the layout answers");
            return reader.finish(None);
        };
        let inner_overlap = inner_overlap(asked.allow_overlap_inside);
        let (layout, ids) = reader.layout("request.", WireLayout::take(&mut asked));
        let order = reader.order("order", &request.order, &ids);
        if let (Some(layout), Some(order), Some(tolerance)) = (&layout, &order, tolerance_mm) {
            reader.heights(&request.order, order, layout, tolerance);
        }
        let (certificate, claimed) = (request.certificate, request.claimed_lower_bound_mm);
        let bound_claim = reader.bound_claim(certificate, claimed, layout.as_ref(), &ids);
        let read = || {
            Some(Self {
                layout: layout?,
                inner_overlap,
                order: order?,
                tolerance_mm: tolerance_mm?,
                bound_claim: bound_claim?,
            })
        };
        let read = read();
        reader.finish(read)
    }
}

/// The order of an answer, as clients need it.
///
/// # Errors
/// Every finding at once.
pub fn order_from_wire(
    order: &[v1::PlacedSection],
    layout: &SectionLayout,
) -> Result<Vec<PlacedSection>, Refused> {
    let (limits, budget) = (Limits::default(), Budget::unlimited());
    let mut reader = Reader::new(&limits, &budget);
    let ids = super::section::Ids::of(layout);
    let read = reader.order("order", order, &ids);
    reader.finish(read)
}

impl Reader<'_> {
    /// Reports sections that stand at another height than they were sent at: they move along the strip only.
    fn heights(
        &mut self,
        wire: &[v1::PlacedSection],
        order: &[PlacedSection],
        layout: &SectionLayout,
        tolerance: f64,
    ) {
        let own: Vec<f64> = layout.sections.iter().map(|section| section.bounds().min.y).collect();
        for (index, (wire, placed)) in wire.iter().zip(order).enumerate() {
            let own = own[placed.section];
            if !wire.y_mm.is_finite() || (wire.y_mm - own).abs() > tolerance {
                let field = format!("order[{index}].y_mm");
                let message = format!(
                    "{} is not {own}, where the section was sent; sections keep their height in the strip",
                    wire.y_mm
                );
                self.report(Finding::new(field, Reason::OutOfRange, wire.y_mm, message));
            }
        }
    }
}
