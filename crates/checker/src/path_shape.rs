//! Whether a path is a path: finite numbers, arcs that agree with their ends, start and target as asked.

use crate::curve::{Curve, cross};
use crate::{Violation, ViolationReason};
use traverse_geometry::{ARC_RADIUS_RATIO, Path, PathArc, Point};

/// Beyond this a coordinate is treated as not finite, millimetres: its square's square overflows.
const LARGEST_COORDINATE_MM: f64 = 1e75;

/// How far beyond a full turn a sweep may lie, radians: 2π itself is rounded.
const SWEEP_SLACK: f64 = 1e-12;

/// Rounding of an angle, as a share of the radius.
const ANGLE_ROUNDING: f64 = 1e-14;

/// Every number that is not finite.
pub(crate) fn not_finite(start: Point, target: Point, path: &Path) -> Vec<Violation> {
    let mut found = Vec::new();
    let mut ask = |number: f64, field: &dyn Fn() -> String| {
        if !(number.is_finite() && number.abs() <= LARGEST_COORDINATE_MM)
            && found.len() < crate::VIOLATION_LIMIT
        {
            let field = field();
            let message = format!(
                "{field} is {number:e}, which no distance can be computed from; give a finite number"
            );
            found.push(Violation {
                field,
                reason: ViolationReason::NotFinite,
                message,
                amount: 0.0,
                at: None,
                obstacle: None,
            });
        }
    };
    if let Some(z) = path.start_z_mm {
        ask(z, &|| "path.start_z_mm".to_owned());
    }
    for (name, p) in [("start", start), ("target", target), ("path.start", path.start)] {
        ask(p.x, &|| format!("{name}.x_mm"));
        ask(p.y, &|| format!("{name}.y_mm"));
    }
    for (index, step) in path.steps.iter().enumerate() {
        ask(step.end.x, &|| format!("path.steps[{index}].end.x_mm"));
        ask(step.end.y, &|| format!("path.steps[{index}].end.y_mm"));
        if let Some(z) = step.z_mm {
            ask(z, &|| format!("path.steps[{index}].z_mm"));
        }
        if let Some(arc) = step.arc {
            ask(arc.center.x, &|| format!("path.steps[{index}].arc.center.x_mm"));
            ask(arc.center.y, &|| format!("path.steps[{index}].arc.center.y_mm"));
            ask(arc.sweep, &|| format!("path.steps[{index}].arc.sweep_rad"));
        }
    }
    found
}

/// What is wrong with both ends.
pub(crate) fn wrong_ends(start: Point, target: Point, path: &Path, tolerance: f64) -> Vec<Violation> {
    let last = match path.steps.len() {
        0 => "path.start".to_owned(),
        count => format!("path.steps[{}].end", count - 1),
    };
    let ends = [
        ("path.start".to_owned(), ViolationReason::WrongStart, "begins", "start", path.start, start),
        (last, ViolationReason::WrongEnd, "ends", "target", path.end(), target),
    ];
    ends.into_iter()
        .filter_map(|(field, reason, verb, asked, found, wanted)| {
            let amount = (found - wanted).norm();
            (amount > tolerance).then(|| Violation {
                field,
                reason,
                message: format!(
                    "the path {verb} {} mm from the {asked} that was asked for",
                    crate::message::millimetres(amount)
                ),
                amount,
                at: Some(found),
                obstacle: None,
            })
        })
        .collect()
}

/// The steps as curves. An arc that does not agree with its ends has no curve and is reported.
pub(crate) fn curves(path: &Path, tolerance: f64, report: &mut dyn FnMut(Violation)) -> Vec<Option<Curve>> {
    let mut from = path.start;
    path.steps
        .iter()
        .enumerate()
        .map(|(index, step)| {
            let start = std::mem::replace(&mut from, step.end);
            let Some(arc) = step.arc else { return Some(Curve::straight(start, step.end)) };
            let violation = wrong_arc(index, start, step.end, arc, tolerance);
            let sound = violation.is_none();
            violation.into_iter().for_each(&mut *report);
            sound.then(|| Curve::from_center(start, step.end, arc))
        })
        .collect()
}

fn wrong_arc(index: usize, start: Point, end: Point, arc: PathArc, tolerance: f64) -> Option<Violation> {
    let (from, to) = (start - arc.center, end - arc.center);
    let radius = (from.norm() + to.norm()) / 2.0;
    let violation = |part: &str, reason, amount, message| {
        let field = format!("path.steps[{index}].arc{part}");
        Some(Violation { field, reason, message, amount, at: Some(end), obstacle: None })
    };
    let turned = arc.sweep.abs();
    if turned == 0.0 || turned > std::f64::consts::TAU + SWEEP_SLACK {
        let message = format!(
            "step {index} turns by {turned} rad; an arc turns by more than 0 and at most one full turn"
        );
        let amount = (turned - std::f64::consts::TAU).max(0.0);
        return violation(".sweep_rad", ViolationReason::SweepOutOfRange, amount, message);
    }
    let difference = (from.norm() - to.norm()).abs();
    let allowed = f64::max(ARC_RADIUS_RATIO * radius, tolerance);
    if difference > allowed {
        let message = format!(
            "the centre of step {index} is {} mm from its start and {} mm from its end; they may differ by {} mm",
            crate::message::millimetres(from.norm()),
            crate::message::millimetres(to.norm()),
            crate::message::millimetres(allowed),
        );
        return violation(".center", ViolationReason::ArcRadiiDiffer, difference, message);
    }
    // The angle that is left between the turned start and the end.
    let (sin, cos) = arc.sweep.sin_cos();
    let reached = nalgebra::Vector2::new(cos * from.x - sin * from.y, sin * from.x + cos * from.y);
    let missed = cross(reached, to).atan2(reached.dot(&to)).abs() * radius;
    // A sweep of nearly nothing must not stand for nearly a full turn, nor the other way round.
    if missed > tolerance + ANGLE_ROUNDING * radius {
        let message = format!(
            "step {index} turns by {} rad and so ends {} mm from where it says",
            arc.sweep,
            crate::message::millimetres(missed),
        );
        return violation(".sweep_rad", ViolationReason::SweepMissesEnd, missed, message);
    }
    None
}
