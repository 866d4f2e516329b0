//! The seam between programs and whoever knows what lies in the way.

use crate::reason::Reason;
use traverse_geometry::{ArcOutput, Path, Point};

/// A way that is shorter by less stays as it is, millimetres.
pub(crate) const LEAST_GAIN_MM: f64 = 0.01;

/// A way to find: from here to there, by this tool, at this height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Travel {
    /// Where it begins, in the drawing, millimetres.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// The lowest height on the way, in the program's coordinates, millimetres; none: it is not known, so everything
    /// counts that could be in the way.
    pub z: Option<f64>,
    /// Heights of start and target where the tool may rise and sink between; none: it stays at `z`, or above it.
    pub ends_z: Option<[f64; 2]>,
    /// The tool's number, if the program has said one.
    pub tool: Option<u32>,
    /// Whether `tool` can be relied on: otherwise the largest clearance counts.
    pub tool_is_known: bool,
    /// How its straight moves are run: fed ones are interpolated, whatever G0 does.
    pub straight: Straight,
    /// How its arcs are put out.
    pub arcs: ArcOutput,
}

/// How straight moves are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Straight {
    /// As G0.
    Rapid,
    /// As G1.
    Fed,
}

/// What lies on a way.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Ids of what it comes too near to; empty: it is free.
    pub hits: Vec<String>,
    /// The least distance beyond the clearance, millimetres; none: nothing is near enough to tell.
    pub margin_mm: Option<f64>,
}

impl Found {
    /// Whether nothing is in the way.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.hits.is_empty()
    }
}

/// Knows what lies in the way of rapid moves: in the plane, or at heights.
///
/// A planner that knows heights answers [`RapidPlanner::look`] by what reaches up to `z`, and plans links with their retract
/// and plunge: where [`Travel::ends_z`] is there, paths have heights.
pub trait RapidPlanner {
    /// What lies on `path`, by code that shares nothing with the planning.
    ///
    /// # Errors
    /// Why it is not known: time was over.
    fn look(&self, travel: &Travel, path: &Path) -> Result<Found, Reason>;

    /// Whether it plans moves that rise, pass over what is low and sink.
    fn knows_heights(&self) -> bool {
        false
    }

    /// What a way costs, in a unit of the planner's own.
    fn cost(&self, path: &Path) -> f64 {
        path.length()
    }

    /// A way that costs less by less than this is no better, in the unit of [`RapidPlanner::cost`].
    fn least_gain(&self) -> f64 {
        LEAST_GAIN_MM
    }

    /// The best free way, with `reserve_mm` more room than asked for: what rounding its numbers may use up.
    ///
    /// # Errors
    /// Why there is none.
    fn shortest(&self, travel: &Travel, reserve_mm: f64) -> Result<Path, Reason>;
}
