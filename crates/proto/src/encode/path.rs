//! Points and paths.

use crate::v1;
use traverse_geometry::{Path, PathArc, PathStep, Point};

pub(super) fn point(point: Point) -> v1::Point {
    v1::Point { x_mm: point.x, y_mm: point.y }
}

pub(super) fn path(path: &Path) -> v1::Path {
    v1::Path {
        start: Some(point(path.start)),
        steps: path.steps.iter().map(step).collect(),
        length_mm: path.length(),
        start_z_mm: path.start_z_mm,
    }
}

fn step(step: &PathStep) -> v1::PathStep {
    let motion = if step.arc.is_some() { v1::StepMotion::Feed } else { v1::StepMotion::Rapid };
    v1::PathStep {
        end: Some(point(step.end)),
        arc: step.arc.as_ref().map(arc),
        z_mm: step.z_mm,
        motion: motion.into(),
    }
}

fn arc(arc: &PathArc) -> v1::Arc {
    v1::Arc { center: Some(point(arc.center)), clockwise: arc.sweep < 0.0, sweep_rad: arc.sweep.abs() }
}
