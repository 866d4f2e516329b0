//! Paths to check.

use super::reader::Reader;
use crate::{Limits, Refused, v1};
use std::f64::consts::TAU;
use traverse_geometry::{COORDINATE_LIMIT_MM, Path, PathArc, PathStep, Point, RADIUS_LIMIT_MM};
use traverse_solve::Budget;

/// A full turn, rounded up by what computing it costs.
const LARGEST_SWEEP: f64 = TAU * (1.0 + 1e-12);

/// The path of an answer, as clients need it.
///
/// # Errors
/// Every finding at once.
pub fn path_from_wire(path: v1::Path) -> Result<Path, Refused> {
    let (limits, budget) = (Limits::default(), Budget::unlimited());
    let mut reader = Reader::new(&limits, &budget);
    let read = reader.path("path", Some(path));
    reader.finish(read)
}

impl Reader<'_> {
    /// A path that must be there.
    pub(crate) fn path(&mut self, field: &str, path: Option<v1::Path>) -> Option<Path> {
        let Some(path) = path else {
            self.missing(field, "the path to check");
            return None;
        };
        let start = self.point(&format!("{field}.start"), path.start);
        let steps: Vec<Option<PathStep>> = (path.steps.into_iter().enumerate())
            .map(|(index, step)| self.step(&format!("{field}.steps[{index}]"), step))
            .collect();
        let start_z_mm = self.height(&format!("{field}.start_z_mm"), path.start_z_mm);
        Some(Path {
            start: start?,
            start_z_mm: start_z_mm?,
            steps: steps.into_iter().collect::<Option<_>>()?,
        })
    }

    fn step(&mut self, field: &str, step: v1::PathStep) -> Option<PathStep> {
        let end = self.point(&format!("{field}.end"), step.end);
        let z_mm = self.height(&format!("{field}.z_mm"), step.z_mm);
        let Some(arc) = step.arc else {
            return Some(PathStep { end: end?, arc: None, z_mm: z_mm? });
        };
        let center = self.center(&format!("{field}.arc.center"), arc.center);
        let holds = |sweep: f64| sweep > 0.0 && sweep <= LARGEST_SWEEP;
        let sweep =
            self.within(&format!("{field}.arc.sweep_rad"), arc.sweep_rad, holds, "more than 0, at most 2π");
        let sweep = if arc.clockwise { -sweep? } else { sweep? };
        Some(PathStep { end: end?, arc: Some(PathArc { center: center?, sweep }), z_mm: z_mm? })
    }

    /// A height that may be absent.
    #[expect(clippy::option_option, reason = "the outer one: it was read")]
    fn height(&mut self, field: &str, z_mm: Option<f64>) -> Option<Option<f64>> {
        match z_mm {
            None => Some(None),
            Some(z_mm) => self.coordinate(field, z_mm).map(Some),
        }
    }

    /// A centre may lie beyond the coordinate limit by a radius.
    fn center(&mut self, field: &str, center: Option<v1::Point>) -> Option<Point> {
        let Some(v1::Point { x_mm, y_mm }) = center else {
            self.missing(field, "a point with x_mm and y_mm");
            return None;
        };
        let most = COORDINATE_LIMIT_MM + RADIUS_LIMIT_MM;
        let range = format!("at most ±{most} mm");
        let x = self.within(&format!("{field}.x_mm"), x_mm, |x| x.abs() <= most, &range);
        let y = self.within(&format!("{field}.y_mm"), y_mm, |y| y.abs() <= most, &range);
        Some(Point::new(x?, y?))
    }
}
