//! Shortest costs between many points of one scene: what sequencing asks for.
//!
//! Every entry is what [`crate::plan_rapid_move`] would answer. The data's way: clearances are tried in turn (`at_clearance`), as for a single move; the points' ways out of the barriers are found
//! once; at each level that matters the barriers are prepared once (`at_level`), and from each point one search goes to each
//! that may still be nearer there, or one to all, whichever takes less (`single_searches`). What is not the length of the
//! shortest path (time, chords, dog-legs, the published scan) is planned pair by pair (`by_pairs`).
//!
//! A way is as long in either direction. So where the list of targets is the list of starts and both ends follow the same
//! rules, only pairs of different points are worked out, each once; and the searches run from whichever list is shorter.

mod at_clearance;
mod at_level;
mod by_pairs;
mod matrix;
mod single_searches;

use crate::{Algorithm, Refusal};
use at_clearance::AtClearance;
use matrix::Matrix;
use traverse_geometry::{ArcOutput, Point, RapidMotion, RapidRules, Scene, TravelCost};
use traverse_solve::{Budget, Interrupt};

/// What shortest costs are asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceQuery {
    /// Where ways begin.
    pub from: Vec<Point>,
    /// Where they end. Empty: the same points.
    pub to: Vec<Point>,
    /// By which method.
    pub algorithm: Algorithm,
    /// What every move may do. Must have no findings.
    pub rules: RapidRules,
}

impl DistanceQuery {
    /// Where ways end.
    #[must_use]
    pub fn targets(&self) -> &[Point] {
        if self.to.is_empty() { &self.from } else { &self.to }
    }

    /// Whether costs are lengths of shortest paths.
    fn asks_for_lengths(&self) -> bool {
        let RapidRules { cost, motion, arcs, .. } = &self.rules;
        self.algorithm == Algorithm::Exact
            && *cost == TravelCost::Length
            && *motion == RapidMotion::Linear
            && *arcs == ArcOutput::Arcs
    }

    /// Whether the cost from one point to another is the cost back: each pair is asked for twice.
    fn is_symmetric(&self) -> bool {
        let heights_meet = self.rules.heights.is_none_or(|rule| rule.start_z_mm == rule.target_z_mm);
        // What the machine makes of a way back may cost another time.
        self.to.is_empty() && heights_meet && self.rules.leave == self.rules.enter && self.asks_for_lengths()
    }
}

/// One end of many ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DistanceEnd {
    /// This one of the points where ways begin.
    From(usize),
    /// This one of the points where ways end.
    To(usize),
}

/// Why shortest costs can't be given.
#[derive(Clone, Debug, PartialEq)]
pub enum DistancesRefusal {
    /// Ends that lie inside barriers and may not, or can not, leave them; one entry for each end and barrier.
    Ends(Vec<(DistanceEnd, Refusal)>),
    /// One move is refused for another reason than its ends.
    Move(Refusal),
    /// The budget ended first.
    Interrupted(Interrupt),
}

impl From<Interrupt> for DistancesRefusal {
    fn from(interrupt: Interrupt) -> Self {
        Self::Interrupted(interrupt)
    }
}

/// The cost of the shortest way from each point to each target in a valid scene, row by row; infinity where there is
/// none. Iterations are counted over all searches.
///
/// # Errors
/// See [`DistancesRefusal`].
pub fn plan_distances(
    scene: &Scene,
    query: &DistanceQuery,
    budget: &Budget,
) -> Result<Vec<f64>, DistancesRefusal> {
    let mut matrix = Matrix::new(query.from.len(), query.targets().len(), query.is_symmetric());
    if !query.asks_for_lengths() {
        by_pairs::fill(scene, query, &mut matrix, budget)?;
        return Ok(matrix.into_costs());
    }
    let mut steps = 0;
    let clearances = match query.rules.clearances_mm.as_slice() {
        [] => &[scene.clearance_mm],
        clearances => clearances,
    };
    for (i, &clearance_mm) in clearances.iter().enumerate() {
        let scene = crate::lowered::with_clearance(scene, clearance_mm);
        let is_last = i + 1 == clearances.len();
        AtClearance { scene: &scene, query, is_last, budget }.fill(&mut matrix, &mut steps)?;
        if matrix.is_full() {
            break;
        }
    }
    Ok(matrix.into_costs())
}
