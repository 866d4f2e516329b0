//! The shortest path by best-first search over tangents (A*: P. Hart, N. Nilsson, B. Raphael 1968) that looks only at
//! barriers which were in its way.
//!
//! The search begins with no barrier at all. A move is tested against the whole scene when it is its turn; if a barrier
//! that was not met yet is in the way, that barrier is met: its features are offered to every label that was expanded
//! so far, and the move is dropped. The idea, look only at what blocks the line, is the published scan's (2008).
//!
//! Exact: a label that was expanded is a path that nothing in the scene blocks, and it was the cheapest among all ways
//! round what was met by then, of which there are only more than in the end. So it needs no second look when more
//! barriers are met, and the first path to the target is the shortest. Estimates are lower bounds of the optimum
//! whenever they come up.
//!
//! Cost: each expanded label meets every barrier once, and of its features those that a tangent may reach, by bundles; a test
//! costs about log n.

use super::label::{Label, Place, Route};
use super::route::route;
use super::tree::{Room, Tree};
use super::{End, Ground, Known, Way};
use crate::measure::{Length, Measure};
use std::ops::Range;
use traverse_solve::{Budget, Interrupt, Observer};

/// Most labels of one search: about 60 MB. Giving back more would take longer than a cancelled call may go on.
pub(crate) const LABEL_LIMIT: usize = 1_000_000;

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 256;

/// Barriers of so few features are offered to many stances between two looks at the budget.
const SMALL_BARRIER: usize = 64;

/// The budget is looked at once for so many stances.
const STANCES_BETWEEN_CHECKS: u32 = 256;

/// A search under way.
pub(crate) struct Search<'a, M = Length> {
    pub(super) tree: Tree<'a, M>,
    pub(crate) known: Known<'a>,
    /// No path costs less.
    pub(crate) lower_bound: f64,
}

impl<'a> Search<'a> {
    /// A search by length from `start` to `target` that has met what `known` has.
    pub(crate) fn new(known: Known<'a>, start: &'a End, target: &'a End) -> Self {
        Self::by(Length, known, start, target)
    }
}

impl<'a, M: Measure> Search<'a, M> {
    /// A search from `start` to `target` that has met what `known` has.
    pub(crate) fn by(measure: M, known: Known<'a>, start: &'a End, target: &'a End) -> Self {
        Self { tree: Tree::new(measure, start, target, Room::default()), known, lower_bound: 0.0 }
    }

    /// The shortest path; none if the barriers that were met part start from target. `steps` counts the labels that
    /// were looked into, over calls. `observer` hears of the bound whenever another barrier is met.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn run(
        &mut self,
        budget: &Budget,
        steps: &mut u64,
        observer: &mut dyn Observer,
    ) -> Result<Option<Route>, Interrupt> {
        let mut told = 0.0;
        let mut known = 0;
        while let Some((estimate, label)) = self.tree.pop() {
            budget.check(*steps)?;
            self.lower_bound = self.lower_bound.max(estimate);
            if self.known.features.len() > known && self.lower_bound > told {
                (known, told) = (self.known.features.len(), self.lower_bound);
                observer.better_bound(told);
            }
            if self.tree.is_served(&self.known, &label) || !self.is_free(&label, budget)? {
                continue;
            }
            match label.place {
                Place::Target(_) => return Ok(Some(route(&self.tree, &self.known, &label))),
                Place::Start(_) => {}
                Place::Feature(feature, _) => {
                    self.meet_beside(feature, budget)?;
                    if self.tree.is_served(&self.known, &label) {
                        continue;
                    }
                }
            }
            let Some(stance) = self.tree.stand(&self.known, &label) else { continue };
            *steps += 1;
            self.tree.reach_for_target(&self.known, stance);
            let (features, bundles) = (0..self.known.features.len(), 0..self.known.bundles.len());
            self.connect(stance, &features, bundles, budget)?;
        }
        Ok(None)
    }

    /// Offers a stance the features of some bundles, and what its own goes over into, as far as it is among `features`.
    pub(super) fn connect(
        &mut self,
        stance: u32,
        features: &Range<usize>,
        bundles: Range<usize>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        self.tree.push_over(&self.known, stance, |other| features.contains(&(other as usize)));
        self.push_tangents(stance, bundles, budget)?;
        if self.tree.label_count() > LABEL_LIMIT { Err(Interrupt::Memory) } else { Ok(()) }
    }

    /// Offers a stance tangents to the features of some bundles.
    fn push_tangents(
        &mut self,
        stance: u32,
        bundles: Range<usize>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let (side, ahead) = self.tree.ahead[stance as usize];
        let Range { start: mut at, end } = bundles;
        let mut looked_at = 0;
        while let Some((features, next)) = self.known.bundles.next_reached(at, end, &ahead, side) {
            at = next;
            looked_at += features.len();
            if looked_at > FEATURES_BETWEEN_CHECKS {
                budget.check(0)?;
                looked_at = 0;
            }
            for other in features {
                for side in ahead.may_reach(side, self.known.sector(other)).into_iter().flatten() {
                    self.tree.push_tangent(&self.known, stance, other, side);
                }
            }
        }
        Ok(())
    }

    /// Whether nothing is in the way of the straight move that leads to the label. Meets what is.
    pub(super) fn is_free(&mut self, label: &Label, budget: &Budget) -> Result<bool, Interrupt> {
        let Some(leg) = self.tree.leg(&self.known, label) else { return Ok(true) };
        match self.known.way(leg.planned.from, leg.planned.to) {
            Way::Free => match self.tree.measure.cramped_by(leg.planned.from, leg.planned.to) {
                None => Ok(true),
                Some(owners) => {
                    for owner in owners {
                        if !self.known.was_met(owner) {
                            self.meet(owner, budget)?;
                        }
                    }
                    Ok(false)
                }
            },
            Way::Blocked => Ok(false),
            Way::Meets(owner) => self.meet(owner, budget).map(|()| false),
        }
    }

    /// Meets the barriers that block the feature's arc.
    pub(super) fn meet_beside(&mut self, feature: u32, budget: &Budget) -> Result<(), Interrupt> {
        if self.known.knows_stretches(feature) {
            return Ok(());
        }
        for owner in self.known.stretches(feature).blocked_by.clone() {
            if !self.known.was_met(owner) {
                self.meet(owner, budget)?;
            }
        }
        Ok(())
    }

    /// Meets a barrier and offers its features to every stance.
    pub(super) fn meet(&mut self, owner: usize, budget: &Budget) -> Result<(), Interrupt> {
        let met = self.known.meet(owner, budget)?;
        let is_small = met.features.len() <= SMALL_BARRIER && !met.has_same_circles;
        for stance in 0..self.tree.stances.len() as u32 {
            if is_small {
                self.push_tangents(stance, met.bundles.clone(), budget)?;
            } else {
                self.connect(stance, &met.features, met.bundles.clone(), budget)?;
            }
            if stance.is_multiple_of(STANCES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
        }
        if self.tree.label_count() > LABEL_LIMIT { Err(Interrupt::Memory) } else { Ok(()) }
    }
}
