//! The question and the answer of a rapid move.

use traverse_geometry::{CostUnit, Path, Point, RapidRules};
use traverse_solve::Interrupt;

/// One rapid move to plan.
#[derive(Clone, Debug, PartialEq)]
pub struct RapidMove {
    /// Where the tool's centre is.
    pub start: Point,
    /// Where it has to go.
    pub target: Point,
    /// By which method.
    pub algorithm: Algorithm,
    /// What it may do. Must have no findings.
    pub rules: RapidRules,
}

/// How a rapid move is planned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Algorithm {
    /// The shortest path, proven.
    #[default]
    Exact,
    /// The supporting-line scan published in 2008: one obstacle, mitred, both ends outside its convex hull.
    SupportingLines,
}

/// What came of a rapid move.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// A path.
    Plan(RapidPlan),
    /// Proven: there is none.
    NoPath(NoPath),
}

/// A collision-free path and how good it is.
#[derive(Clone, Debug, PartialEq)]
pub struct RapidPlan {
    /// The way.
    pub path: Path,
    /// What it costs by the rules' measure: its length in space, or seconds.
    pub cost: f64,
    /// What cost and bound count.
    pub cost_unit: CostUnit,
    /// No collision-free path of horizontal and vertical moves that follows the rules costs less, whichever way arcs are
    /// put out and axes run. Equal to `cost` when proven.
    pub lower_bound: f64,
    /// The scene's clearance that was used, millimetres: of the rules' clearances the first that admits a path.
    pub clearance_mm: f64,
    /// Ids of the obstacles that bend the path, in path order; `work_area` where its border does.
    pub bending_obstacles: Vec<String>,
    /// Other locally shortest ways, none cheaper than the plan, cheapest first. Of the published scan: its
    /// clockwise and counter-clockwise candidates, shortest first.
    pub alternatives: Vec<Path>,
    /// What each of them costs.
    pub alternative_costs: Vec<f64>,
}

/// Why no collision-free path exists.
#[derive(Clone, Debug, PartialEq)]
pub struct NoPath {
    /// Ids of obstacles whose barriers, with the work area's border, part start from target: none can be left out.
    pub separating_obstacles: Vec<String>,
    /// What would have to be given up.
    pub feasible_clearance: FeasibleClearance,
}

/// The most that all clearances may keep if each is lowered by the same amount, not below 0, until a path appears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FeasibleClearance {
    /// The scene's clearance then, millimetres: at this one there is a path, at one that is larger by a contact
    /// tolerance there is none.
    Millimetres(f64),
    /// There is no path even at 0.
    None,
    /// The budget ended before it was known.
    Unknown,
}

/// What planning took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Corners and arcs of the barriers that the search looked at.
    pub barrier_vertices: u64,
    /// Nodes that the search expanded.
    pub expanded_nodes: u64,
}

/// Why a rapid move that is well formed can't be planned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// Start or target lies inside a barrier.
    #[error(
        "{field} lies {depth_mm} mm inside the barrier of {obstacle}: move it out or lower the clearance"
    )]
    EndInsideBarrier {
        /// `start` or `target`.
        field: &'static str,
        /// The obstacle's id, or `work_area`.
        obstacle: String,
        /// How far inside, millimetres.
        depth_mm: f64,
    },
    /// Start or target lies inside a barrier, and no straight way that the rules allow leads out.
    #[error(
        "{field} lies in the barrier of {obstacle} and has no way out: {why}; move it or lower the clearance"
    )]
    EndShutIn {
        /// `start` or `target`.
        field: &'static str,
        /// The obstacle's id, or `work_area`.
        obstacle: String,
        /// Why there is no way.
        why: &'static str,
    },
    /// Each axis runs at its own speed, and every way leads through a passage that is no wider than the path and slanted.
    #[error(
        "every way leads through a passage with no room for dog-legs: lower the clearance, or run straight moves as G1 and \
         ask for linear motion"
    )]
    NoRoomForDogLegs,
    /// The published scan does not cover the request.
    #[error("the published supporting-line scan does not cover this request: {why}; use the exact algorithm")]
    PublishedMethodNotApplicable {
        /// What it does not cover.
        why: &'static str,
    },
    /// The budget ended first.
    #[error("stopped before a path was proven shortest")]
    Interrupted {
        /// Why.
        interrupt: Interrupt,
        /// What is known: no path costs less.
        lower_bound: f64,
    },
}

impl Refusal {
    /// Whether a smaller clearance may help.
    pub(crate) fn is_about_room(&self) -> bool {
        matches!(self, Self::EndInsideBarrier { .. } | Self::EndShutIn { .. } | Self::NoRoomForDogLegs)
    }
}
