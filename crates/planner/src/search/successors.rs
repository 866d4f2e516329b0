//! Where a path can go from a stance: along tangents to features and to the target, and over onto what a feature
//! goes over into.

use super::departure::Departure;
use super::label::{Label, Place, Step};
use super::stance::{From, Leg};
use super::tree::{Tree, lane};
use super::{End, Ground};
use crate::barrier::Side;
use crate::measure::Measure;

impl<M: Measure> Tree<'_, M> {
    /// Offers a stance the target.
    pub(super) fn reach_for_target(&mut self, ground: &impl Ground, stance: u32) {
        for place in 0..self.target.places.len() {
            self.push_target(ground, stance, place as u32);
        }
    }

    /// The label at a feature, about to leave it.
    pub(super) fn departure(&self, ground: &impl Ground, label: &Label) -> Option<Departure> {
        let Place::Feature(feature, _) = label.place else { return None };
        let lane = lane(ground, label)?;
        Some(Departure {
            lane,
            circle: *ground.feature(feature),
            free: ground.stretches(feature).free[lane.stretch],
            offset: label.offset,
            spoke: self.spoke(ground, label)?,
            cost: label.cost,
        })
    }

    /// The offset at which `leg` leaves `from`, unless the way does not lead there or another label of the lane
    /// is there for less. A start is left anywhere.
    fn leaves_at(&self, from: &From, leg: &Leg) -> Option<f64> {
        let From::Feature(departure) = from else { return Some(0.0) };
        let left = departure.leaves_at(&leg.planned)?;
        let cost = departure.planned_cost(self.measure, left);
        let arc = |from| self.measure.between(&departure.circle, from, left);
        let idle = self.settled.beats(departure.lane, left, cost, arc);
        (!idle).then_some(left)
    }

    /// Straight to a place that stands for the target.
    fn push_target(&mut self, ground: &impl Ground, stance: u32, place: u32) {
        if let Some(label) = self.at_target(stance, self.target, place) {
            self.push(ground, label, self.target.point);
        }
    }

    /// What going straight from a stance to a place that stands for `target` comes to, if the way leads there.
    pub(super) fn at_target(&self, stance: u32, target: &End, place: u32) -> Option<Label> {
        let from = &self.stances[stance as usize].from;
        let leg = from.leg_to_end(target.places[place as usize], target.point, self.start.point)?;
        // A start that stands in the target's place leaves it for nowhere.
        let left_at = self.leaves_at(from, &leg)?;
        let cost = self.cost_along(from, left_at, &leg);
        let place = Place::Target(place);
        Some(Label { cost, left_at, offset: 0.0, place, parent: stance, step: Step::Tangent })
    }

    /// Along a tangent to another feature.
    pub(super) fn push_tangent(&mut self, ground: &impl Ground, stance: u32, other: u32, side: Side) {
        let from = &self.stances[stance as usize].from;
        let circle = ground.feature(other);
        if !self.measure.admits(circle.owner, side) {
            return;
        }
        if let From::Feature(departure) = from {
            let lane = departure.lane;
            if lane.feature == other || lane.side == side && ground.goes_over(lane.feature, other) {
                return;
            }
        }
        let Some(leg) = self.leg_to(ground, from, other, side) else { return };
        let Some(offset) = circle.offset_of(-leg.planned.normal * side.sign(), leg.planned.angle_error)
        else {
            return;
        };
        let Some(left_at) = self.leaves_at(from, &leg) else { return };
        let cost = self.cost_along(from, left_at, &leg);
        let at = circle.center - leg.normal * (circle.price_radius * side.sign());
        let place = Place::Feature(other, side);
        self.push(ground, Label { cost, left_at, offset, place, parent: stance, step: Step::Tangent }, at);
    }

    /// Onto what a stance's feature goes over into without a straight move, as far as it is `wanted`: its neighbour on
    /// the border, or a feature on the same circle, at the first place from here on that both have.
    pub(super) fn push_over(&mut self, ground: &impl Ground, stance: u32, wanted: impl Fn(u32) -> bool) {
        let From::Feature(departure) = self.stances[stance as usize].from else { return };
        let (lane, circle) = (departure.lane, departure.circle);
        let entry = |onto: u32| match lane.side {
            Side::Left => 0.0,
            Side::Right => ground.feature(onto).sweep,
        };
        let (neighbour, end) = match lane.side {
            Side::Left => (circle.after, circle.sweep),
            Side::Right => (circle.before, 0.0),
        };
        if let Some(onto) = neighbour.filter(|&onto| wanted(onto)) {
            self.push_onto(ground, stance, &departure, end, onto, entry(onto));
        }
        for other in
            ground.on_same_circle(lane.feature).filter(|&other| Some(other) != neighbour && wanted(other))
        {
            let onto = ground.feature(other);
            if let Some(here) = onto.offset_of(circle.direction_at(departure.offset), 0.0) {
                self.push_onto(ground, stance, &departure, departure.offset, other, here);
            } else if let Some(left) = circle.offset_of(onto.direction_at(entry(other)), 0.0) {
                self.push_onto(ground, stance, &departure, left, other, entry(other));
            }
        }
    }

    fn push_onto(
        &mut self,
        ground: &impl Ground,
        stance: u32,
        departure: &Departure,
        left_at: f64,
        other: u32,
        offset: f64,
    ) {
        if !departure.reaches(left_at) {
            return;
        }
        let onto = ground.feature(other);
        if !self.measure.admits(onto.owner, departure.lane.side) {
            return;
        }
        let cost = departure.cost_at(self.measure, left_at, departure.circle.direction_at(left_at));
        let at = onto.center + onto.direction_at(offset) * onto.price_radius;
        let place = Place::Feature(other, departure.lane.side);
        self.push(ground, Label { cost, left_at, offset, place, parent: stance, step: Step::Over }, at);
    }

    /// What a path costs that leaves along `leg`, where that ends.
    pub(super) fn cost_along(&self, from: &From, left_at: f64, leg: &Leg) -> f64 {
        let before = match from {
            From::Start(_) => 0.0,
            From::Feature(departure) => departure.cost_at(self.measure, left_at, from.spoke_along(leg)),
        };
        before + self.measure.straight(leg.normal, leg.length)
    }
}
