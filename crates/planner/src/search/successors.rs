//! Where a path can go from a label: along tangents to features and to the target, and over onto what a feature goes
//! over into.

use super::departure::Departure;
use super::label::{Label, Place, Step};
use super::{Search, Tangent};
use crate::barrier::Side;
use std::ops::Range;
use traverse_geometry::{Point, Vector};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 256;

/// Where a tangent begins: a place that stands for the start, or a feature.
#[derive(Clone, Copy)]
enum From {
    Start(Point),
    Feature(Departure),
}

impl Search<'_> {
    /// Offers the label `index` the target.
    pub(super) fn reach_for_target(&mut self, index: usize) {
        let Some(from) = self.from(index) else { return };
        for place in 0..self.target.places.len() {
            self.push_target(index, &from, self.target.places[place]);
        }
    }

    /// Offers the label `index` some features.
    pub(super) fn connect(
        &mut self,
        index: usize,
        features: Range<usize>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let Some(from) = self.from(index) else { return Ok(()) };
        let left_feature = match &from {
            From::Start(_) => None,
            From::Feature(departure) => {
                self.push_over(index, departure, &features);
                Some(departure.lane.feature)
            }
        };
        for other in features.filter(|&other| Some(other) != left_feature) {
            if other % FEATURES_BETWEEN_CHECKS == 0 {
                budget.check(0)?;
            }
            for side in Side::BOTH {
                self.push_tangent(index, &from, other, side);
            }
        }
        Ok(())
    }

    fn from(&self, index: usize) -> Option<From> {
        let label = &self.labels[index];
        match label.place {
            Place::Start => Some(From::Start(label.plan_at)),
            Place::Feature { .. } => self.departure(label).map(From::Feature),
            Place::Target => None,
        }
    }

    /// The label at a feature, about to leave it.
    pub(super) fn departure(&self, label: &Label) -> Option<Departure> {
        let Place::Feature { feature, offset, .. } = label.place else { return None };
        let lane = self.lane(label)?;
        Some(Departure {
            lane,
            circle: self.known.features[feature],
            free: self.known.stretches(feature).free[lane.stretch],
            offset,
            spoke: label.spoke,
            cost: label.cost,
        })
    }

    /// The offset at which `plan` leaves `from`, unless the way does not lead there or another label of the lane
    /// is there for less. A start is left anywhere.
    fn leaves_at(&self, from: &From, plan: &Tangent) -> Option<f64> {
        let From::Feature(departure) = from else { return Some(0.0) };
        let left = departure.leaves_at(plan)?;
        let cost = departure.planned_cost(left);
        let idle = self.settled.beats(departure.lane, departure.circle.price_radius, left, cost);
        (!idle).then_some(left)
    }

    /// Straight to a place that stands for the target.
    fn push_target(&mut self, index: usize, from: &From, place: Point) {
        let parent = self.labels[index];
        let goal = self.target.point;
        let planned = match from {
            // Both may stand in the same place on a border.
            From::Start(at) if *at == place => Some((0.0, *at, *at)),
            _ => from
                .planned(place, 0.0)
                .and_then(|plan| Some((self.leaves_at(from, &plan)?, plan.from, plan.to))),
        };
        let Some((left_at, plan_from, plan_at)) = planned else { return };
        let (cost, left_spoke) = match from {
            From::Start(_) => ((goal - self.start.point).norm(), Vector::zeros()),
            From::Feature(departure) => {
                let Some(price) = Tangent::between(departure.circle.center, departure.rho().1, goal, 0.0)
                else {
                    return;
                };
                let left_spoke = -price.normal * departure.lane.side.sign();
                (departure.cost_at(left_at, left_spoke) + price.length, left_spoke)
            }
        };
        let step = Step::Tangent { left_at };
        self.push(Label {
            place: Place::Target,
            step,
            parent: index,
            cost,
            plan_from,
            plan_at,
            left_spoke,
            ..parent
        });
    }

    /// Along a tangent to another feature.
    fn push_tangent(&mut self, index: usize, from: &From, other: usize, side: Side) {
        let circle = &self.known.features[other];
        if let From::Feature(departure) = from
            && departure.lane.side == side
            && self.known.goes_over(departure.lane.feature, other)
        {
            return;
        }
        let Some(plan) = from.planned(circle.center, circle.plan_radius * side.sign()) else { return };
        let Some(offset) = circle.offset_of(-plan.normal * side.sign(), plan.angle_error) else { return };
        let Some(left_at) = self.leaves_at(from, &plan) else { return };
        let price_rho = circle.price_radius * side.sign();
        let price = match from {
            From::Start(_) => Tangent::between(self.start.point, 0.0, circle.center, price_rho),
            From::Feature(departure) => {
                Tangent::between(departure.circle.center, departure.rho().1, circle.center, price_rho)
            }
        };
        // Where the priced circles nest by a tolerance, or the start is the corner itself, nothing lies between.
        let (normal, length) = price.map_or((plan.normal, 0.0), |price| (price.normal, price.length));
        let (cost, left_spoke) = match from {
            From::Start(_) => (length, Vector::zeros()),
            From::Feature(departure) => {
                let left_spoke = -normal * departure.lane.side.sign();
                (departure.cost_at(left_at, left_spoke) + length, left_spoke)
            }
        };
        self.push(Label {
            place: Place::Feature { feature: other, side, offset },
            step: Step::Tangent { left_at },
            parent: index,
            cost,
            plan_from: plan.from,
            plan_at: plan.to,
            spoke: -normal * side.sign(),
            left_spoke,
        });
    }

    /// Onto what the feature goes over into without a straight move: its neighbour on the border, or a feature on
    /// the same circle, at the first place from here on that both have.
    fn push_over(&mut self, index: usize, departure: &Departure, features: &Range<usize>) {
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
            self.push_onto(index, departure, left_at, other, offset);
        }
    }

    fn push_onto(&mut self, index: usize, departure: &Departure, left_at: f64, other: usize, offset: f64) {
        if !departure.reaches(left_at) {
            return;
        }
        let onto = &self.known.features[other];
        let left_spoke = departure.circle.direction_at(left_at);
        let at = onto.plan_point(offset);
        self.push(Label {
            place: Place::Feature { feature: other, side: departure.lane.side, offset },
            step: Step::Over { left_at },
            parent: index,
            cost: departure.cost_at(left_at, left_spoke),
            plan_from: at,
            plan_at: at,
            spoke: onto.direction_at(offset),
            left_spoke,
        });
    }
}

impl From {
    /// The planned tangent to a circle of signed radius `rho`.
    fn planned(&self, center: Point, rho: f64) -> Option<Tangent> {
        match self {
            Self::Start(at) => Tangent::between(*at, 0.0, center, rho),
            Self::Feature(departure) => {
                Tangent::between(departure.circle.center, departure.rho().0, center, rho)
            }
        }
    }
}
