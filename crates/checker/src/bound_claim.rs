//! A bound that is claimed beside a layout, held against what its certificate proves.

use crate::certificate::LayoutCertificate;
use crate::certified_bound::{certified_bound_mm_while, claim_tolerance_mm};
use crate::message::millimetres;
use crate::rapid_check::{SMALLEST_TOLERANCE_MM, VIOLATION_LIMIT};
use crate::sections_check::{SectionsCheck, check_sections_while};
use crate::{Violation, ViolationReason};
use traverse_geometry::{PlacedSection, SectionLayout};

/// What is said of all layouts beside one of them.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundClaim {
    /// What is said to prove it.
    pub certificate: LayoutCertificate,
    /// No layout is said to be shorter, millimetres. Absent: nothing is said, what is proven is asked for.
    pub lower_bound_mm: Option<f64>,
}

/// As [`crate::check_sections_while`], and what the claim's certificate proves is recomputed. A claim that exceeds it by more than
/// [`claim_tolerance_mm`] is a violation.
#[must_use]
pub fn check_certified_sections_while(
    layout: &SectionLayout,
    order: &[PlacedSection],
    claim: &BoundClaim,
    tolerance_mm: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<SectionsCheck> {
    let mut check = check_sections_while(layout, order, tolerance_mm, go_on)?;
    let proven = certified_bound_mm_while(layout, &claim.certificate, go_on)?;
    check.certified_bound_mm = Some(proven);
    if let Some(claimed) = claim.lower_bound_mm {
        let allowed = claim_tolerance_mm(layout, tolerance_mm.max(SMALLEST_TOLERANCE_MM));
        // What is no number can't be proven.
        if claimed.is_nan() || claimed > proven + allowed {
            check.violations.truncate(VIOLATION_LIMIT - 1);
            check.violations.push(not_proven(claimed, proven));
        }
    }
    Some(check)
}

fn not_proven(claimed: f64, proven: f64) -> Violation {
    let amount = if claimed.is_nan() { 0.0 } else { claimed - proven };
    let (claimed, proven) = (millimetres(claimed), millimetres(proven));
    Violation {
        field: "claimed_lower_bound_mm".to_owned(),
        reason: ViolationReason::BoundNotProven,
        message: format!("a lower bound of {claimed} mm is claimed; the certificate proves {proven} mm"),
        amount,
        at: None,
        obstacle: None,
    }
}
