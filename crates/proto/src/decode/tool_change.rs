//! PlaceToolChange's question.

use super::reader::Reader;
use super::shape::wire_vertices;
use crate::{Limits, Refused, v1};
use traverse_geometry::{Finding, Polygon, Reason, Scene};
use traverse_planner::{Algorithm, ToolChange};
use traverse_solve::Budget;

/// What PlaceToolChange asks, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolChangeQuestion {
    /// What to keep away from.
    pub scene: Scene,
    /// From where to where, and where the tool may be changed.
    pub change: ToolChange,
    /// Stop after this many expanded nodes. Absent: no limit.
    pub iteration_limit: Option<u64>,
    /// Only say what is wrong.
    pub validate_only: bool,
}

impl ToolChangeQuestion {
    /// Reads and validates a request. `budget` is asked between its parts.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(
        request: v1::PlaceToolChangeRequest,
        limits: &Limits,
        budget: &Budget,
    ) -> Result<Self, Refused> {
        let mut reader = Reader::new(limits, budget);
        if let Some(scene) = &request.scene {
            reader.scene_fits("scene", scene);
        }
        let vertices = request.regions.iter().map(wire_vertices).sum::<usize>() + request.points.len();
        reader.at_most("regions", "vertices and points", vertices, limits.vertex_count);
        reader.so_far()?;
        let question = reader.tool_change(request);
        reader.finish(question)
    }
}

impl Reader<'_> {
    fn tool_change(&mut self, request: v1::PlaceToolChangeRequest) -> Option<ToolChangeQuestion> {
        let start = self.point("start", request.start);
        let target = self.point("target", request.target);
        let rules = request.rules.unwrap_or_default();
        let algorithm = self.algorithm("rules.algorithm", rules.algorithm);
        if algorithm == Some(Algorithm::SupportingLines) {
            let message =
                "the published scan places no tool changes; leave it out or ask for RAPID_ALGORITHM_EXACT";
            self.not_applicable("rules.algorithm", "RAPID_ALGORITHM_SUPPORTING_LINES", message);
        }
        if rules.alternative_count != 0 {
            let message = "a tool change has no alternatives; leave it out, and ask PlanRapidMove for those of each move";
            self.not_applicable("rules.alternative_count", rules.alternative_count, message);
        }
        let options = rules.options.unwrap_or_default();
        let rules = self.rules("rules", v1::RapidRules { alternative_count: 0, ..rules });
        let iteration_limit = self.iteration_limit("rules.options", &options);
        let scene = self.scene("scene", request.scene);
        let regions: Vec<Option<Polygon>> = (request.regions.into_iter().enumerate())
            .map(|(index, region)| self.polygon(&format!("regions[{index}]"), Some(region)))
            .collect();
        let points: Vec<_> = (request.points.into_iter().enumerate())
            .map(|(index, point)| self.point(&format!("points[{index}]"), Some(point)))
            .collect();
        let are_read = regions.iter().all(Option::is_some) && points.iter().all(Option::is_some);
        let change = ToolChange {
            start: start.unwrap_or_default(),
            target: target.unwrap_or_default(),
            // What could not be read was reported; nothing must not be reported as well.
            regions: regions.into_iter().flatten().collect(),
            points: points.into_iter().flatten().collect(),
            place_z_mm: request.place_z_mm.map(|mm| mm + 0.0),
            rules,
        };
        let findings = change.findings().into_iter().filter(|finding| are_read || finding.field != "regions");
        self.report_under("", findings.collect());
        let (Some(_), Some(_), Some(_), true) = (start, target, algorithm, are_read) else { return None };
        Some(ToolChangeQuestion {
            scene: scene?,
            change,
            iteration_limit,
            validate_only: request.validate_only,
        })
    }

    /// Reports a value that means nothing here.
    fn not_applicable(&mut self, field: &str, value: impl ToString, message: &str) {
        self.report(Finding::new(field, Reason::NotApplicable, value, message));
    }
}
