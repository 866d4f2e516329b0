//! Where a path can go from a stance: along tangents to features and to the target, and over onto what a feature
//! goes over into.

use super::Search;
use super::departure::Departure;
use super::label::{Label, Place, Step};
use super::stance::{From, Leg};
use crate::barrier::Side;
use std::ops::Range;
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 256;

impl Search<'_> {
    /// Offers a stance the target.
    pub(super) fn reach_for_target(&mut self, stance: u32) {
        let from = self.stances[stance as usize].from;
        for place in 0..self.target.places.len() {
            self.push_target(stance, &from, place as u32);
        }
    }

    /// Offers a stance some features, and what its own goes over into, as far as it is among them.
    pub(super) fn connect(
        &mut self,
        stance: u32,
        features: Range<usize>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        if let From::Feature(departure) = self.stances[stance as usize].from {
            self.push_over(stance, &departure, &features);
        }
        for part in features.start / FEATURES_BETWEEN_CHECKS..=features.end / FEATURES_BETWEEN_CHECKS {
            let first = part * FEATURES_BETWEEN_CHECKS;
            budget.check(0)?;
            self.push_tangents(
                stance,
                first.max(features.start)..features.end.min(first + FEATURES_BETWEEN_CHECKS),
            );
        }
        Ok(())
    }

    /// Along tangents to features.
    pub(super) fn push_tangents(&mut self, stance: u32, features: Range<usize>) {
        let (side, ahead) = self.ahead[stance as usize];
        for other in features.start as u32..features.end as u32 {
            for side in ahead.may_reach(side, self.known.sector(other)).into_iter().flatten() {
                self.push_tangent(stance, other, side);
            }
        }
    }

    /// The label at a feature, about to leave it.
    pub(super) fn departure(&self, label: &Label) -> Option<Departure> {
        let Place::Feature(feature, _) = label.place else { return None };
        let lane = self.lane(label)?;
        Some(Departure {
            lane,
            circle: *self.known.feature(feature),
            free: self.known.stretches(feature).free[lane.stretch],
            offset: label.offset,
            spoke: self.spoke(label)?,
            cost: label.cost,
        })
    }

    /// The straight move that leads to a label; none where there is none to make.
    pub(super) fn leg(&self, label: &Label) -> Option<Leg> {
        if label.step != Step::Tangent {
            return None;
        }
        let from = &self.stances[label.parent as usize].from;
        match label.place {
            Place::Start(_) => None,
            Place::Feature(feature, side) => from.leg_to(self.known.feature(feature), side, self.start.point),
            Place::Target(place) => {
                from.leg_to_end(self.target.places[place as usize], self.target.point, self.start.point)
            }
        }
    }

    /// Outward direction of a label's feature on the answered path at arrival.
    fn spoke(&self, label: &Label) -> Option<traverse_geometry::Vector> {
        let Place::Feature(feature, side) = label.place else { return None };
        if label.step == Step::Over {
            return Some(self.known.feature(feature).direction_at(label.offset));
        }
        Some(-self.leg(label)?.normal * side.sign())
    }

    /// The offset at which `leg` leaves `from`, unless the way does not lead there or another label of the lane
    /// is there for less. A start is left anywhere.
    fn leaves_at(&self, from: &From, leg: &Leg) -> Option<f64> {
        let From::Feature(departure) = from else { return Some(0.0) };
        let left = departure.leaves_at(&leg.planned)?;
        let cost = departure.planned_cost(left);
        let idle = self.settled.beats(departure.lane, departure.circle.price_radius, left, cost);
        (!idle).then_some(left)
    }

    /// Straight to a place that stands for the target.
    fn push_target(&mut self, stance: u32, from: &From, place: u32) {
        let goal = self.target.point;
        let Some(leg) = from.leg_to_end(self.target.places[place as usize], goal, self.start.point) else {
            return;
        };
        // A start that stands in the target's place leaves it for nowhere.
        let Some(left_at) = self.leaves_at(from, &leg) else { return };
        let cost = cost_at(from, left_at, &leg) + leg.length;
        self.push(
            Label {
                cost,
                left_at,
                offset: 0.0,
                place: Place::Target(place),
                parent: stance,
                step: Step::Tangent,
            },
            goal,
        );
    }

    /// Along a tangent to another feature.
    fn push_tangent(&mut self, stance: u32, other: u32, side: Side) {
        let from = &self.stances[stance as usize].from;
        let circle = self.known.feature(other);
        if let From::Feature(departure) = from {
            let lane = departure.lane;
            if lane.feature == other || lane.side == side && self.known.goes_over(lane.feature, other) {
                return;
            }
        }
        let Some(leg) = from.leg_to(circle, side, self.start.point) else { return };
        let Some(offset) = circle.offset_of(-leg.planned.normal * side.sign(), leg.planned.angle_error)
        else {
            return;
        };
        let Some(left_at) = self.leaves_at(from, &leg) else { return };
        let cost = cost_at(from, left_at, &leg) + leg.length;
        let at = circle.center - leg.normal * (circle.price_radius * side.sign());
        let place = Place::Feature(other, side);
        self.push(Label { cost, left_at, offset, place, parent: stance, step: Step::Tangent }, at);
    }

    /// Onto what the feature goes over into without a straight move: its neighbour on the border, or a feature on
    /// the same circle, at the first place from here on that both have.
    fn push_over(&mut self, stance: u32, departure: &Departure, features: &Range<usize>) {
        let (lane, circle) = (departure.lane, departure.circle);
        let entry = |onto: usize| match lane.side {
            Side::Left => 0.0,
            Side::Right => self.known.features[onto].sweep,
        };
        let (neighbour, end) = match lane.side {
            Side::Left => (circle.after, circle.sweep),
            Side::Right => (circle.before, 0.0),
        };
        let mut over: Vec<(usize, f64, f64)> =
            neighbour.map(|onto| (onto, end, entry(onto))).into_iter().collect();
        for other in self.known.on_same_circle(lane.feature).filter(|&other| Some(other) != neighbour) {
            let onto = &self.known.features[other];
            if let Some(here) = onto.offset_of(circle.direction_at(departure.offset), 0.0) {
                over.push((other, departure.offset, here));
            } else if let Some(left) = circle.offset_of(onto.direction_at(entry(other)), 0.0) {
                over.push((other, left, entry(other)));
            }
        }
        over.retain(|(other, ..)| features.contains(other));
        for (other, left_at, offset) in over {
            self.push_onto(stance, departure, left_at, other as u32, offset);
        }
    }

    fn push_onto(&mut self, stance: u32, departure: &Departure, left_at: f64, other: u32, offset: f64) {
        if !departure.reaches(left_at) {
            return;
        }
        let onto = self.known.feature(other);
        let cost = departure.cost_at(left_at, departure.circle.direction_at(left_at));
        let at = onto.center + onto.direction_at(offset) * onto.price_radius;
        let place = Place::Feature(other, departure.lane.side);
        self.push(Label { cost, left_at, offset, place, parent: stance, step: Step::Over }, at);
    }
}

/// What a path costs where it leaves along `leg`.
fn cost_at(from: &From, left_at: f64, leg: &Leg) -> f64 {
    match from {
        From::Start(_) => 0.0,
        From::Feature(departure) => departure.cost_at(left_at, from.spoke_along(leg)),
    }
}
