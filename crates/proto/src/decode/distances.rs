//! PlanDistances' question.

use super::reader::Reader;
use crate::{Limits, Refused, v1};
use traverse_geometry::{Finding, Point, Reason, Scene};
use traverse_planner::DistanceQuery;
use traverse_solve::Budget;

/// What PlanDistances asks, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct DistancesQuestion {
    /// What to keep away from.
    pub scene: Scene,
    /// From where to where, and how.
    pub query: DistanceQuery,
    /// Stop after this many expanded nodes, over all searches. Absent: no limit.
    pub iteration_limit: Option<u64>,
}

impl DistancesQuestion {
    /// Reads and validates a request. `budget` is asked between its parts.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(
        request: v1::PlanDistancesRequest,
        limits: &Limits,
        budget: &Budget,
    ) -> Result<Self, Refused> {
        let mut reader = Reader::new(limits, budget);
        if let Some(scene) = &request.scene {
            reader.scene_fits("scene", scene);
        }
        let [from, to] = [&request.from_xy_mm, &request.to_xy_mm].map(|list| list.len() / 2);
        reader.at_most("from_xy_mm", "points", from, limits.vertex_count);
        reader.at_most("to_xy_mm", "points", to, limits.vertex_count);
        let costs = from.saturating_mul(if request.to_xy_mm.is_empty() { from } else { to });
        reader.at_most("from_xy_mm", "costs", costs, limits.distance_count);
        reader.so_far()?;
        if request.from_xy_mm.is_empty() {
            reader.missing("from_xy_mm", "x and y of at least one point");
        }
        let from = reader.points("from_xy_mm", &request.from_xy_mm);
        let to = reader.points("to_xy_mm", &request.to_xy_mm);
        let rules = request.rules.unwrap_or_default();
        let algorithm = reader.algorithm("rules.algorithm", rules.algorithm);
        let options = rules.options.unwrap_or_default();
        let rules = reader.rules("rules", rules);
        let iteration_limit = reader.iteration_limit("rules.options", &options);
        let scene = reader.scene("scene", request.scene);
        let read = from.zip(to).zip(algorithm).zip(scene).map(|(((from, to), algorithm), scene)| Self {
            scene,
            query: DistanceQuery { from, to, algorithm, rules },
            iteration_limit,
        });
        reader.finish(read)
    }
}

impl Reader<'_> {
    /// Points as x0, y0, x1, y1, …
    fn points(&mut self, field: &str, xy_mm: &[f64]) -> Option<Vec<Point>> {
        if !xy_mm.len().is_multiple_of(2) {
            let message = format!("{} numbers given; send an x and a y for every point", xy_mm.len());
            self.report(Finding::new(field, Reason::OddCoordinateCount, xy_mm.len(), message));
        }
        let mut points = Vec::with_capacity(xy_mm.len() / 2);
        let mut complete = xy_mm.len().is_multiple_of(2);
        for (index, pair) in xy_mm.chunks_exact(2).enumerate() {
            let mut number = |at: usize| match pair[at] {
                value if value.abs() <= traverse_geometry::COORDINATE_LIMIT_MM => Some(value + 0.0),
                value => self.coordinate(&format!("{field}[{}]", 2 * index + at), value),
            };
            match (number(0), number(1)) {
                (Some(x), Some(y)) => points.push(Point::new(x, y)),
                _ => complete = false,
            }
        }
        complete.then_some(points)
    }
}
