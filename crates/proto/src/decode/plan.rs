//! PlanRapidMove's question.

use super::reader::Reader;
use crate::{Limits, Refused, v1};
use traverse_geometry::Scene;
use traverse_planner::RapidMove;
use traverse_solve::Budget;

/// What PlanRapidMove asks, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanQuestion {
    /// What to keep away from.
    pub scene: Scene,
    /// From where to where, and how.
    pub query: RapidMove,
    /// Stop after this many expanded nodes. Absent: no limit.
    pub iteration_limit: Option<u64>,
    /// Only say what is wrong.
    pub validate_only: bool,
}

impl PlanQuestion {
    /// Reads and validates a request. `budget` is asked between its parts.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(
        request: v1::PlanRapidMoveRequest,
        limits: &Limits,
        budget: &Budget,
    ) -> Result<Self, Refused> {
        let mut reader = Reader::new(limits, budget);
        if let Some(scene) = &request.scene {
            reader.scene_fits("scene", scene);
        }
        reader.so_far()?;
        let question = reader.question("", request);
        reader.finish(question)
    }
}

impl Reader<'_> {
    /// A plan's request, standing at `parent` (empty, or ending in a dot).
    pub(crate) fn question(
        &mut self,
        parent: &str,
        request: v1::PlanRapidMoveRequest,
    ) -> Option<PlanQuestion> {
        let read = self.rapid_move(parent, request.start, request.target, request.rules);
        let scene = self.scene(&format!("{parent}scene"), request.scene);
        let (query, iteration_limit) = read?;
        Some(PlanQuestion { scene: scene?, query, iteration_limit, validate_only: request.validate_only })
    }

    /// A move and its iteration limit, standing at `parent` (empty, or ending in a dot).
    pub(crate) fn rapid_move(
        &mut self,
        parent: &str,
        start: Option<v1::Point>,
        target: Option<v1::Point>,
        rules: Option<v1::RapidRules>,
    ) -> Option<(RapidMove, Option<u64>)> {
        let start = self.point(&format!("{parent}start"), start);
        let target = self.point(&format!("{parent}target"), target);
        let rules = rules.unwrap_or_default();
        let algorithm = self.algorithm(&format!("{parent}rules.algorithm"), rules.algorithm);
        let options = rules.options.unwrap_or_default();
        let rules = self.rules(&format!("{parent}rules"), rules);
        let iteration_limit = self.iteration_limit(&format!("{parent}rules.options"), &options);
        let query = RapidMove { start: start?, target: target?, algorithm: algorithm?, rules };
        Some((query, iteration_limit))
    }
}
