//! What an obstruction is made of.

use super::run::{RUN_LENGTH, Run};
use super::{Blocker, Load, Outline};
use std::ops::Range;
use traverse_solve::{Budget, Interrupt};

/// A ring of no more edges than this is one run, by the box that it is known to have.
const SHORT: usize = 16;

/// The budget is looked at once for so many edges.
const EDGES_BETWEEN_CHECKS: usize = 4096;

/// Blockers, or what they can be made of, in runs.
#[derive(Debug)]
pub(crate) struct ObstructionParts<'a> {
    /// Blockers that are kept.
    pub(super) blockers: Vec<Blocker>,
    /// Outlines whose blockers are their own edges.
    pub(super) outlines: Vec<Outline<'a>>,
    pub(super) runs: Vec<Run>,
    /// Owners whose inside does not lie within the box of a run.
    pub(super) wide: Vec<usize>,
    pub(super) load: Load,
}

impl<'a> ObstructionParts<'a> {
    /// Nothing yet, with room for so many blockers to keep and so many outlines.
    pub(crate) fn with_capacity(kept: usize, outlines: usize) -> Self {
        Self {
            blockers: Vec::with_capacity(kept),
            outlines: Vec::with_capacity(outlines),
            runs: Vec::with_capacity(outlines + kept / RUN_LENGTH),
            wide: Vec::new(),
            load: Load::NONE,
        }
    }

    /// Adds an outline, from whose ring blockers are made where a query comes near; those of mitred barriers are kept. Cost:
    /// constant for a short ring, otherwise linear.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn add(&mut self, outline: Outline<'a>, budget: &Budget) -> Result<(), Interrupt> {
        let (ring, owner, number) = (outline.ring, outline.owner, self.outlines.len() as u32);
        if outline.is_mitred() {
            self.wide.push(owner);
            self.keep(&outline);
            return Ok(());
        }
        let limit = outline.clearance.limit();
        self.outlines.push(outline);
        if ring.len() <= SHORT {
            self.push(Run::whole(number, ring.len(), ring.bounds()), limit);
            return Ok(());
        }
        self.wide.push(owner);
        for (i, run) in Run::of_chain(number, 0, ring.len(), |i| ring.edge(i).bounds()).enumerate() {
            if (i * RUN_LENGTH).is_multiple_of(EDGES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            self.push(run, limit);
        }
        Ok(())
    }

    /// Adds an outline's blockers, which are kept; answers their numbers. Cost: linear.
    pub(crate) fn keep(&mut self, outline: &Outline<'_>) -> Range<usize> {
        let first = self.blockers.len();
        outline.add_blockers(&mut self.blockers);
        let end = self.blockers.len();
        for run in Run::of_kept(&self.blockers, first..end) {
            self.load.add(&run.bounds, self.blockers[first].limit);
            self.runs.push(run);
        }
        first..end
    }

    fn push(&mut self, run: Run, limit: f64) {
        self.load.add(&run.bounds, limit);
        self.runs.push(run);
    }
}
