//! What `traverse order` prints: the order as a table, lengths, how good it is, what the checker says.

use crate::rapid::duration;
use traverse_geometry::SectionLayout;
use traverse_proto::v1;

/// So many rows are printed.
const MOST_ROWS: usize = 60;

/// The lines of the report.
pub(crate) fn lines(layout: &SectionLayout, answer: &v1::OrderSectionsResponse) -> Vec<String> {
    let mut lines = Vec::new();
    let width_of_ids =
        layout.sections.iter().map(|section| section.id.chars().count()).max().unwrap_or(0).clamp(7, 30);
    lines.push(format!(
        "{:>5}  {:<width_of_ids$}  {:>4}  {:<9}  {:>12}  {:>12}",
        "place", "section", "copy", "pose", "x mm", "width mm"
    ));
    for (place, placed) in answer.order.iter().enumerate().take(MOST_ROWS) {
        let section = layout.sections.iter().find(|section| section.id == placed.section_id);
        let width = section.map_or(0.0, |section| section.bounds().size().x);
        lines.push(format!(
            "{:>5}  {:<width_of_ids$}  {:>4}  {:<9}  {:>12.3}  {width:>12.3}",
            place + 1,
            placed.section_id,
            placed.copy + 1,
            pose(placed.pose()),
            placed.x_mm,
        ));
    }
    if answer.order.len() > MOST_ROWS {
        lines.push(format!("  and {} more; write them with -o layout.json", answer.order.len() - MOST_ROWS));
    }
    let (length, boxes) = (answer.length_mm, answer.bounding_box_length_mm);
    let share = |part: f64, whole: f64| if whole > 0.0 { 100.0 * part / whole } else { 0.0 };
    lines.push(format!("length           {length:.6} mm"));
    let saved = boxes - length;
    lines.push(format!(
        "by boxes         {boxes:.6} mm, of which {saved:.6} mm are saved ({:.2} %)",
        share(saved, boxes)
    ));
    lines.push(format!(
        "published model  {:.6} mm, by effects of neighbours alone",
        answer.published_length_mm
    ));
    if let Some(report) = &answer.report {
        lines.extend(report_lines(report, length));
    }
    lines
}

/// What the checker says of a sound layout.
pub(crate) fn checked(found: &v1::CheckSectionsResponse) -> String {
    let bound = match found.certified_lower_bound_mm {
        Some(proven) => format!("; its certificate, recomputed, proves {proven:.6} mm"),
        None => String::new(),
    };
    format!("checked          sound, {:.6} mm long{bound}", found.length_mm)
}

/// What the checker says of one that is not.
pub(crate) fn violated(found: &v1::CheckSectionsResponse) -> String {
    let first = found.violations.first();
    let first =
        first.map(|violation| format!("{} {}: {}", violation.reason, violation.field, violation.message));
    format!("the checker found {} violations: {}", found.violations.len(), first.unwrap_or_default())
}

fn report_lines(report: &v1::SolveReport, length: f64) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(bound) = report.lower_bound {
        let good = match report.proven_optimal {
            true => "proven: no layout reached by sliding is shorter".to_owned(),
            false => format!("within {:.3} % of the best", 100.0 * report.gap_ratio),
        };
        lines.push(format!("lower bound      {bound:.6} mm, {good}"));
    }
    if let Some(certified) = report.certified_lower_bound.filter(|&certified| certified < length) {
        lines.push(format!("certified        {certified:.6} mm without any search"));
    }
    let took = report.solve_duration.as_ref().map(duration).unwrap_or_default();
    lines.push(format!(
        "method           {}, {:.3} s, {} steps, ended by {}",
        report.algorithm,
        took.as_secs_f64(),
        report.iteration_count,
        ending(report.stop_reason())
    ));
    lines
}

fn pose(pose: v1::SectionPose) -> &'static str {
    match pose {
        v1::SectionPose::Unspecified | v1::SectionPose::AsIs => "as is",
        v1::SectionPose::HalfTurn => "half turn",
        v1::SectionPose::MirrorX => "mirror x",
        v1::SectionPose::MirrorY => "mirror y",
    }
}

fn ending(reason: v1::StopReason) -> &'static str {
    match reason {
        v1::StopReason::ProvenOptimal => "proof",
        v1::StopReason::GapLimit => "the gap limit",
        v1::StopReason::TimeLimit => "the time limit",
        v1::StopReason::Deadline => "the server's limit",
        v1::StopReason::IterationLimit => "the iteration limit",
        v1::StopReason::Converged => "itself",
        v1::StopReason::MemoryLimit => "the memory limit",
        v1::StopReason::Unspecified => "something unknown",
    }
}
