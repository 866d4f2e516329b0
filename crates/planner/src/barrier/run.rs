//! Runs of blockers: what the grid of an obstruction holds.

use super::Blocker;
use std::ops::Range;
use traverse_geometry::{Bounds, Edge, Point};

/// Widest piece of an arc that enters the grid by its chord, radians.
const ARC_PIECE_RAD: f64 = std::f64::consts::FRAC_PI_8;

/// Most blockers in a run of a long chain.
pub(super) const RUN_LENGTH: usize = 8;

/// Neighbouring blockers of a chain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    /// Its outline; none ([`Run::KEPT`]) where blockers are kept.
    pub(super) outline: u32,
    /// Numbers of blockers: edges of the outline, or among all that are kept.
    pub(super) first: u32,
    pub(super) end: u32,
    /// The blocker that follows on the same chain.
    pub(super) following: u32,
    /// What they can reach.
    pub(super) bounds: Bounds,
}

impl Run {
    /// No outline.
    pub(super) const KEPT: u32 = u32::MAX;

    /// All edges of an outline, which have these bounds.
    pub(super) fn whole(outline: u32, len: usize, bounds: Bounds) -> Self {
        Self { outline, first: 0, end: len as u32, following: 0, bounds }
    }

    /// The runs of a closed chain of blockers that are kept.
    pub(super) fn of_kept(blockers: &[Blocker], chain: Range<usize>) -> impl Iterator<Item = Self> {
        let bounds_of = |number: usize| blockers[number].edge.bounds();
        Self::of_chain(Self::KEPT, chain.start, chain.end, bounds_of)
    }

    /// The runs of a closed chain, blockers `first` to `end`, whose edges have these bounds.
    pub(super) fn of_chain(
        outline: u32,
        first: usize,
        end: usize,
        bounds_of: impl Fn(usize) -> Bounds,
    ) -> impl Iterator<Item = Self> {
        (first..end).step_by(RUN_LENGTH).map(move |run| {
            let run_end = end.min(run + RUN_LENGTH);
            let bounds = (run..run_end).fold(Bounds::EMPTY, |bounds, number| bounds.union(bounds_of(number)));
            let following = if run_end == end { first } else { run_end } as u32;
            Self { outline, first: run as u32, end: run_end as u32, following, bounds }
        })
    }
}

/// The thick segments that hold all that a blocker forbids.
pub(super) fn pieces(blocker: &Blocker, mut add: impl FnMut(Point, Point, f64)) {
    match &blocker.edge {
        Edge::Segment(segment) => add(segment.start, segment.end, blocker.limit),
        Edge::Arc(arc) => {
            let count = (arc.sweep.abs() / ARC_PIECE_RAD).ceil().max(1.0);
            let sagitta = arc.radius * (1.0 - (arc.sweep.abs() / count / 2.0).cos());
            let mut from = arc.start;
            for piece in 1..=count as usize {
                let to = arc.point_at(piece as f64 / count);
                add(from, to, blocker.limit + sagitta);
                from = to;
            }
        }
    }
}
