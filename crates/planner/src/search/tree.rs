//! What a search has found so far: labels that are open, stances that were looked into, and what these settle.
//!
//! The search among barriers that it meets and the search in a prepared scene grow the same kind of tree; they differ in
//! how they come by moves that nothing blocks.

use super::label::{Label, Place, Step};
use super::sector::Sector;
use super::settled::{Lane, Settled};
use super::stance::{From, Leg, Stance};
use super::{End, Ground};
use crate::barrier::Side;
use crate::measure::{Length, Measure};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_geometry::{Point, Vector};

/// An order of costs for the heap; costs are finite and not negative, so their bits sort as they do.
type Priority = u64;

/// The memory of a tree, to be used again.
#[derive(Default)]
pub(crate) struct Room {
    labels: Vec<Label>,
    stances: Vec<Stance>,
    ahead: Vec<(Side, Sector)>,
    open: BinaryHeap<(Reverse<Priority>, u32)>,
    settled: Settled,
}

/// A search tree from `start` towards `target`.
pub(crate) struct Tree<'a, M = Length> {
    pub(super) measure: M,
    pub(super) start: &'a End,
    pub(super) target: &'a End,
    labels: Vec<Label>,
    /// Labels that were looked into, in order.
    pub(super) stances: Vec<Stance>,
    /// Where each of them may still go, and with its circle on which side.
    pub(super) ahead: Vec<(Side, Sector)>,
    /// Lowest estimate first; the later label of equals, which is nearer to the target.
    open: BinaryHeap<(Reverse<Priority>, u32)>,
    pub(super) settled: Settled,
}

impl<'a, M: Measure> Tree<'a, M> {
    /// A tree of nothing but the start.
    pub(crate) fn new(measure: M, start: &'a End, target: &'a End, room: Room) -> Self {
        let Room { labels, stances, ahead, open, settled } = room;
        let mut tree = Self { measure, start, target, labels, stances, ahead, open, settled };
        for place in 0..start.places.len() as u32 {
            let place = Place::Start(place);
            tree.add(
                Label { cost: 0.0, left_at: 0.0, offset: 0.0, place, parent: 0, step: Step::Begin },
                start.point,
            );
        }
        tree
    }

    /// Gives its memory back, empty.
    #[allow(dead_code, reason = "for searches from one end to many")]
    pub(crate) fn into_room(self) -> Room {
        let Self { mut labels, mut stances, mut ahead, mut open, mut settled, .. } = self;
        for stance in &stances {
            if let From::Feature(departure) = &stance.from {
                settled.forget(departure.lane.feature);
            }
        }
        labels.clear();
        stances.clear();
        ahead.clear();
        open.clear();
        Room { labels, stances, ahead, open, settled }
    }

    /// How many labels there are, open or not.
    pub(crate) fn label_count(&self) -> usize {
        self.labels.len()
    }

    /// The open label of the lowest estimate, and that.
    pub(crate) fn pop(&mut self) -> Option<(f64, Label)> {
        let (Reverse(estimate), index) = self.open.pop()?;
        Some((f64::from_bits(estimate), self.labels[index as usize]))
    }

    /// The lowest estimate of an open label.
    pub(crate) fn lowest_estimate(&self) -> Option<f64> {
        self.open.peek().map(|(Reverse(estimate), _)| f64::from_bits(*estimate))
    }

    /// Adds a label whose place on the answered path is `at`, unless it is served.
    pub(super) fn push(&mut self, ground: &impl Ground, label: Label, at: Point) {
        if !self.is_served(ground, &label) {
            self.add(label, at);
        }
    }

    /// Adds a label whose place on the answered path is `at`.
    pub(super) fn add(&mut self, label: Label, at: Point) {
        let estimate = label.cost + self.measure.along(self.target.point - at);
        self.open.push((Reverse(estimate.to_bits()), self.labels.len() as u32));
        self.labels.push(label);
    }

    /// Looks into a label that is free: from now on its lane is settled. None at the target, or where its arc is
    /// blocked.
    pub(super) fn stand(&mut self, ground: &impl Ground, label: &Label) -> Option<u32> {
        let stance = self.stand_unsettled(ground, label)?;
        if let From::Feature(departure) = &self.stances[stance as usize].from {
            self.settled.add(departure.lane, label.offset, label.cost);
        }
        Some(stance)
    }

    /// The same, without a word to other labels of the lane.
    pub(super) fn stand_unsettled(&mut self, ground: &impl Ground, label: &Label) -> Option<u32> {
        let (from, ahead) = match label.place {
            Place::Target(_) => return None,
            Place::Start(place) => {
                let at = self.start.places[place as usize];
                (From::Start(at), (Side::Left, Sector::all_round(at)))
            }
            Place::Feature(_, side) => {
                let departure = self.departure(ground, label)?;
                (From::Feature(departure), (side, Sector::ahead(&departure)))
            }
        };
        self.ahead.push(ahead);
        self.stances.push(Stance { label: *label, from });
        Some(self.stances.len() as u32 - 1)
    }

    /// Whether a label that was looked into before does all that this one could, at no higher cost.
    pub(super) fn is_served(&self, ground: &impl Ground, label: &Label) -> bool {
        let Place::Feature(feature, _) = label.place else { return false };
        if !ground.knows_stretches(feature) {
            return false;
        }
        let circle = ground.feature(feature);
        let arc = |from| self.measure.between(circle, from, label.offset);
        lane(ground, label).is_none_or(|lane| self.settled.serves(lane, label.offset, label.cost, arc))
    }

    /// The straight move that leads to a label; none where there is none to make.
    pub(super) fn leg(&self, ground: &impl Ground, label: &Label) -> Option<Leg> {
        if matches!(label.step, Step::Begin | Step::Over) {
            return None;
        }
        let from = &self.stances[label.parent as usize].from;
        match label.place {
            Place::Start(_) => None,
            Place::Feature(feature, side) => self.leg_to(ground, from, feature, side),
            Place::Target(place) => {
                from.leg_to_end(self.target.places[place as usize], self.target.point, self.start.point)
            }
        }
    }

    /// Straight to a feature, which lies on `side`: along the border where that leads there.
    pub(super) fn leg_to(&self, ground: &impl Ground, from: &From, feature: u32, side: Side) -> Option<Leg> {
        if let From::Feature(departure) = from
            && departure.lane.side == side
            && let Some(along) = ground.along_border(departure.lane.feature, feature, side)
        {
            return Some(Leg::as_planned(along));
        }
        from.leg_to(ground.feature(feature), side, self.start.point)
    }

    /// Outward direction of a label's feature on the answered path at arrival.
    pub(super) fn spoke(&self, ground: &impl Ground, label: &Label) -> Option<Vector> {
        let Place::Feature(feature, side) = label.place else { return None };
        if label.step == Step::Over {
            return Some(ground.feature(feature).direction_at(label.offset));
        }
        Some(-self.leg(ground, label)?.normal * side.sign())
    }
}

/// The lane of a label at a feature; none where the arc is blocked.
pub(super) fn lane(ground: &impl Ground, label: &Label) -> Option<Lane> {
    let Place::Feature(feature, side) = label.place else { return None };
    let tolerance = ground.feature(feature).offset_tolerance();
    let stretch = ground.stretches(feature).at(label.offset, tolerance)?;
    Some(Lane { feature, side, stretch })
}
