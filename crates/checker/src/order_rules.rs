//! What the list of placed sections says by itself: copies, poses, first and last, precedence, neighbours, places.

use crate::message::millimetres;
use crate::{VIOLATION_LIMIT, Violation, ViolationReason};
use std::collections::{BTreeSet, HashSet};
use traverse_geometry::{PlacedSection, Point, SectionLayout, SlideRule};

/// Reports every violation that needs no geometry of parts.
pub(crate) fn order_violations(
    layout: &SectionLayout,
    order: &[PlacedSection],
    tolerance: f64,
    mut report: impl FnMut(Violation),
) {
    copies(layout, order, &mut report);
    ends(layout, order, &mut report);
    precedences(layout, order, &mut report);
    joins(layout, order, &mut report);
    places(layout, order, tolerance, &mut report);
}

/// A violation of the placed section `index`.
pub(crate) fn at_index(
    index: usize,
    field: &str,
    reason: ViolationReason,
    message: String,
    amount: f64,
) -> Violation {
    let field = if field.is_empty() { format!("order[{index}]") } else { format!("order[{index}].{field}") };
    Violation { field, reason, message, amount, at: None, obstacle: None }
}

fn in_order(reason: ViolationReason, message: String) -> Violation {
    Violation { field: "order".to_owned(), reason, message, amount: 0.0, at: None, obstacle: None }
}

fn id(layout: &SectionLayout, section: usize) -> &str {
    layout.sections.get(section).map_or("", |section| &section.id)
}

fn copies(layout: &SectionLayout, order: &[PlacedSection], report: &mut impl FnMut(Violation)) {
    let mut seen: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); layout.sections.len()];
    for (index, placed) in order.iter().enumerate() {
        let Some(section) = layout.sections.get(placed.section) else {
            let message =
                format!("there is no section {}; the layout has {}", placed.section, layout.sections.len());
            report(at_index(index, "section_id", ViolationReason::UnknownSection, message, 0.0));
            continue;
        };
        let id = &section.id;
        if placed.copy >= section.quantity {
            let message =
                format!("copy {} of section {id} is placed, and there are {}", placed.copy, section.quantity);
            report(at_index(index, "copy", ViolationReason::UnknownCopy, message, 0.0));
        } else if !seen[placed.section].insert(placed.copy) {
            let message = format!("copy {} of section {id} is placed again", placed.copy);
            report(at_index(index, "copy", ViolationReason::CopyRepeated, message, 0.0));
        }
        if !section.poses.contains(&placed.pose) {
            let message = format!("section {id} must not be turned like this");
            report(at_index(index, "pose", ViolationReason::PoseNotAllowed, message, 0.0));
        }
    }
    let missing = layout.sections.iter().zip(&seen).flat_map(|(section, seen)| {
        (0..section.quantity).filter(|copy| !seen.contains(copy)).map(move |copy| (copy, &section.id))
    });
    for (copy, id) in missing.take(VIOLATION_LIMIT) {
        report(in_order(ViolationReason::CopyMissing, format!("copy {copy} of section {id} is not placed")));
    }
}

fn ends(layout: &SectionLayout, order: &[PlacedSection], report: &mut impl FnMut(Violation)) {
    let ends = [
        (layout.first, order.first(), 0, "first", ViolationReason::WrongFirst),
        (layout.last, order.last(), order.len().saturating_sub(1), "last", ViolationReason::WrongLast),
    ];
    for (wanted, placed, index, place, reason) in ends {
        let (Some(wanted), Some(placed)) = (wanted, placed) else { continue };
        if placed.section != wanted {
            let (found, wanted) = (id(layout, placed.section), id(layout, wanted));
            report(at_index(
                index,
                "",
                reason,
                format!("section {found} comes {place}, not section {wanted}"),
                0.0,
            ));
        }
    }
}

/// One violation for each pair of sections, where it begins.
fn precedences(layout: &SectionLayout, order: &[PlacedSection], report: &mut impl FnMut(Violation)) {
    let mut first_of = vec![None; layout.sections.len()];
    let mut last_of = vec![None; layout.sections.len()];
    for (index, placed) in
        order.iter().enumerate().filter(|(_, placed)| placed.section < layout.sections.len())
    {
        first_of[placed.section].get_or_insert(index);
        last_of[placed.section] = Some(index);
    }
    for &(before, after) in &layout.precedences {
        let (Some(last), Some(first)) =
            (last_of.get(before).copied().flatten(), first_of.get(after).copied().flatten())
        else {
            continue;
        };
        if first < last {
            let message = format!(
                "section {} comes before the copy of section {} at order[{last}], which must come earlier",
                id(layout, after),
                id(layout, before)
            );
            report(at_index(first, "", ViolationReason::PrecedenceBroken, message, 0.0));
        }
    }
}

fn joins(layout: &SectionLayout, order: &[PlacedSection], report: &mut impl FnMut(Violation)) {
    if layout.forbidden_joins.is_empty() {
        return;
    }
    let forbidden: HashSet<(usize, usize)> = layout.forbidden_joins.iter().copied().collect();
    for (index, pair) in order.windows(2).enumerate() {
        let (left, right) = (pair[0].section, pair[1].section);
        if forbidden.contains(&(left, right)) {
            let message =
                format!("section {} must not stand right of section {}", id(layout, right), id(layout, left));
            report(at_index(index + 1, "", ViolationReason::ForbiddenJoin, message, 0.0));
        }
    }
}

fn places(
    layout: &SectionLayout,
    order: &[PlacedSection],
    tolerance: f64,
    report: &mut impl FnMut(Violation),
) {
    for (index, placed) in order.iter().enumerate() {
        if placed.x_mm < -tolerance {
            let amount = -placed.x_mm;
            let message = format!("begins {} mm left of the strip's start", millimetres(amount));
            report(at_index(index, "x_mm", ViolationReason::LeftOfStart, message, amount));
        }
    }
    if layout.slide_rule != SlideRule::KeepOrder {
        return;
    }
    for (index, pair) in order.windows(2).enumerate() {
        let amount = pair[0].x_mm - pair[1].x_mm;
        if amount > tolerance {
            let message = format!(
                "begins {} mm left of the section before it, and the order is to be kept",
                millimetres(amount)
            );
            let violation = at_index(index + 1, "x_mm", ViolationReason::PassesPrevious, message, amount);
            report(Violation { at: Some(Point::new(pair[1].x_mm, 0.0)), ..violation });
        }
    }
}
