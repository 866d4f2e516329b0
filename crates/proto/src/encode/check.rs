//! The checker's answers.

use super::path::point;
use super::plan::cost_unit;
use crate::v1;
use traverse_checker::{PathCheck, SectionsCheck, Violation};

/// The checker's findings as their message.
#[must_use]
pub fn check_answer(check: &PathCheck) -> v1::CheckRapidMoveResponse {
    v1::CheckRapidMoveResponse {
        violations: check.violations.iter().map(violation).collect(),
        cost: check.cost,
        smallest_margin_mm: check.smallest_margin_mm,
        clearance_mm: check.clearance_mm,
        cost_unit: cost_unit(check.cost_unit).into(),
    }
}

/// The checker's findings about a layout as their message.
#[must_use]
pub fn check_sections_answer(check: &SectionsCheck) -> v1::CheckSectionsResponse {
    v1::CheckSectionsResponse {
        violations: check.violations.iter().map(violation).collect(),
        length_mm: check.length_mm,
        smallest_margin_mm: check.smallest_margin_mm,
        certified_lower_bound_mm: check.certified_bound_mm,
    }
}

fn violation(violation: &Violation) -> v1::Violation {
    v1::Violation {
        field: violation.field.clone(),
        reason: violation.reason.as_str().to_owned(),
        message: violation.message.clone(),
        amount: violation.amount,
        at: violation.at.map(point),
        obstacle_id: violation.obstacle.clone().unwrap_or_default(),
    }
}
