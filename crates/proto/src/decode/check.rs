//! CheckRapidMove's question.

use super::reader::Reader;
use crate::{Limits, Refused, v1};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Path, Point, RapidRules, Scene};
use traverse_solve::Budget;

/// What CheckRapidMove asks, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckQuestion {
    /// What to keep away from.
    pub scene: Scene,
    /// What the path may do.
    pub rules: RapidRules,
    /// Where the path has to begin.
    pub start: Point,
    /// Where it has to end.
    pub target: Point,
    /// The path to check.
    pub path: Path,
    /// How far inside a barrier still counts as touching it, millimetres.
    pub tolerance_mm: f64,
}

impl CheckQuestion {
    /// Reads and validates a request. `budget` is asked between its parts.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(
        request: v1::CheckRapidMoveRequest,
        limits: &Limits,
        budget: &Budget,
    ) -> Result<Self, Refused> {
        let mut reader = Reader::new(limits, budget);
        if let Some(scene) = request.request.as_ref().and_then(|request| request.scene.as_ref()) {
            reader.scene_fits("request.scene", scene);
        }
        if let Some(path) = &request.path {
            reader.at_most("path.steps", "steps", path.steps.len(), limits.step_count);
        }
        reader.so_far()?;
        let path = reader.path("path", request.path);
        let holds = |mm: f64| (1e-9..=1.0).contains(&mm);
        let tolerance_mm = match request.tolerance_mm {
            None => Some(CONTACT_TOLERANCE_MM),
            Some(mm) => reader.within("tolerance_mm", mm, holds, "1e-9 to 1 mm"),
        };
        let question = match request.request {
            Some(request) => reader.question("request.", request),
            None => {
                reader.missing("request", "the PlanRapidMoveRequest that the path answers");
                None
            }
        };
        let read = question.zip(path).zip(tolerance_mm).map(|((question, path), tolerance_mm)| Self {
            scene: question.scene,
            start: question.query.start,
            target: question.query.target,
            rules: question.query.rules,
            path,
            tolerance_mm,
        });
        reader.finish(read)
    }
}
