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
//! Cost: each expanded label meets every feature once; a test costs about log n.

use super::label::{Label, Place, Route, Step};
use super::route::route;
use super::sector::Sector;
use super::settled::{Lane, Settled};
use super::stance::{From, Stance};
use super::{End, Known};
use crate::barrier::Side;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt, Observer};

/// Most labels of one search: about 60 MB. Giving back more would take longer than a cancelled call may go on.
const LABEL_LIMIT: usize = 1_000_000;

/// Barriers of so few features are offered to many stances between two looks at the budget.
const SMALL_BARRIER: usize = 64;

/// The budget is looked at once for so many stances.
const STANCES_BETWEEN_CHECKS: u32 = 256;

/// An order of costs for the heap; costs are finite and not negative, so their bits sort as they do.
type Priority = u64;

/// A search under way.
pub(crate) struct Search<'a> {
    pub(super) start: &'a End,
    pub(super) target: &'a End,
    pub(crate) known: Known<'a>,
    labels: Vec<Label>,
    /// Labels that were looked into, in order.
    pub(super) stances: Vec<Stance>,
    /// Where each of them may still go, and with its circle on which side.
    pub(super) ahead: Vec<(Side, Sector)>,
    /// Lowest estimate first; the later label of equals, which is nearer to the target.
    open: BinaryHeap<(Reverse<Priority>, u32)>,
    pub(super) settled: Settled,
    /// No path costs less, millimetres.
    pub(crate) lower_bound: f64,
}

impl<'a> Search<'a> {
    /// A search from `start` to `target` that has met what `known` has.
    pub(crate) fn new(known: Known<'a>, start: &'a End, target: &'a End) -> Self {
        let mut search = Self {
            start,
            target,
            known,
            labels: Vec::new(),
            stances: Vec::new(),
            ahead: Vec::new(),
            open: BinaryHeap::new(),
            settled: Settled::default(),
            lower_bound: 0.0,
        };
        for place in 0..start.places.len() as u32 {
            let label = Label {
                cost: 0.0,
                left_at: 0.0,
                offset: 0.0,
                place: Place::Start(place),
                parent: 0,
                step: Step::Begin,
            };
            search.push(label, start.point);
        }
        search
    }

    /// The shortest path; none if the barriers that were met part start from target. `steps` counts the labels that
    /// were expanded, over calls. `observer` hears of the bound whenever another barrier is met.
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
        while let Some((Reverse(estimate), index)) = self.open.pop() {
            budget.check(*steps)?;
            self.lower_bound = self.lower_bound.max(f64::from_bits(estimate));
            if self.known.features.len() > known && self.lower_bound > told {
                (known, told) = (self.known.features.len(), self.lower_bound);
                observer.better_bound(told);
            }
            let label = self.labels[index as usize];
            if self.is_served(&label) || !self.is_free(&label, budget)? {
                continue;
            }
            let from = match label.place {
                Place::Target(_) => return Ok(Some(route(self, &label))),
                Place::Start(place) => From::Start(self.start.places[place as usize]),
                Place::Feature(feature, _) => {
                    self.meet_beside(feature, budget)?;
                    if self.is_served(&label) {
                        continue;
                    }
                    let Some(departure) = self.departure(&label) else { continue };
                    self.settled.add(departure.lane, label.offset, label.cost);
                    From::Feature(departure)
                }
            };
            *steps += 1;
            let stance = self.stances.len() as u32;
            self.ahead.push(match &from {
                From::Start(at) => (Side::Left, Sector::all_round(*at)),
                From::Feature(departure) => (departure.lane.side, Sector::ahead(departure)),
            });
            self.stances.push(Stance { label, from });
            self.reach_for_target(stance);
            self.connect(stance, 0..self.known.features.len(), budget)?;
        }
        Ok(None)
    }

    /// Adds a label whose place on the answered path is `at`.
    pub(super) fn push(&mut self, label: Label, at: Point) {
        if self.is_served(&label) {
            return;
        }
        let estimate = label.cost + (self.target.point - at).norm();
        self.open.push((Reverse(estimate.to_bits()), self.labels.len() as u32));
        self.labels.push(label);
    }

    /// Whether a label that was looked into before does all that this one could, at no higher cost.
    fn is_served(&self, label: &Label) -> bool {
        let Place::Feature(feature, _) = label.place else { return false };
        if !self.known.knows_stretches(feature) {
            return false;
        }
        let radius = self.known.feature(feature).price_radius;
        self.lane(label).is_none_or(|lane| self.settled.serves(lane, radius, label.offset, label.cost))
    }

    /// The lane of a label at a feature; none where the arc is blocked.
    pub(super) fn lane(&self, label: &Label) -> Option<Lane> {
        let Place::Feature(feature, side) = label.place else { return None };
        let stretch = self.known.stretch_at(feature, label.offset)?;
        Some(Lane { feature, side, stretch })
    }

    /// Whether nothing is in the way of the straight move that leads to the label. Meets what is.
    fn is_free(&mut self, label: &Label, budget: &Budget) -> Result<bool, Interrupt> {
        let Some(leg) = self.leg(label) else { return Ok(true) };
        match self.known.way(leg.planned.from, leg.planned.to) {
            super::Way::Free => Ok(true),
            super::Way::Blocked => Ok(false),
            super::Way::Meets(owner) => self.meet(owner, budget).map(|()| false),
        }
    }

    /// Meets the barriers that block the feature's arc.
    fn meet_beside(&mut self, feature: u32, budget: &Budget) -> Result<(), Interrupt> {
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
    fn meet(&mut self, owner: usize, budget: &Budget) -> Result<(), Interrupt> {
        let met = self.known.meet(owner, budget)?;
        let is_small = met.features.len() <= SMALL_BARRIER && !met.has_same_circles;
        for stance in 0..self.stances.len() as u32 {
            if is_small {
                self.push_tangents(stance, met.features.clone());
            } else {
                self.connect(stance, met.features.clone(), budget)?;
            }
            if stance.is_multiple_of(STANCES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
        }
        if self.labels.len() > LABEL_LIMIT { Err(Interrupt::Memory) } else { Ok(()) }
    }
}
