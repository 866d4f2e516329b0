//! Best-first search over tangents (A*: P. Hart, N. Nilsson, B. Raphael 1968), straight moves tested only when they
//! are reached. Cost: each expanded label meets every feature once; a test costs about log n.

use super::departure::Departure;
use super::label::{Label, Place, Route, Step, Stop};
use super::settled::{Lane, Settled};
use super::{End, Relaxation, Tangent};
use crate::barrier::Side;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Point, Segment, Vector};
use traverse_solve::{Budget, Interrupt};

/// The shortest path from `start` to `target` among the barriers of `relaxation`; none if they part them.
/// `expanded` counts the labels that were expanded, over calls.
///
/// # Errors
/// The budget ended.
pub(crate) fn shortest(
    relaxation: &Relaxation,
    start: &End,
    target: &End,
    budget: &Budget,
    expanded: &mut u64,
) -> Result<Option<Route>, Interrupt> {
    let mut search = Search {
        relaxation,
        start,
        target,
        labels: Vec::new(),
        open: BinaryHeap::new(),
        settled: Settled::default(),
    };
    search.begin();
    while let Some(Reverse((_, _, index))) = search.open.pop() {
        budget.check(*expanded)?;
        let label = search.labels[index];
        if search.is_served(&label) || search.is_blocked(&label) {
            continue;
        }
        if label.place == Place::Target {
            return Ok(Some(search.route(index)));
        }
        *expanded += 1;
        search.expand(index, budget)?;
    }
    Ok(None)
}

/// Most labels of one search: about 400 MB.
const LABEL_LIMIT: usize = 2_000_000;

/// An order of costs for the heap; costs are finite and not negative, so their bits sort as they do.
type Priority = u64;

struct Search<'a> {
    relaxation: &'a Relaxation,
    start: &'a End,
    target: &'a End,
    labels: Vec<Label>,
    /// Lowest estimate first; the later label of equals, which is nearer to the target.
    open: BinaryHeap<Reverse<(Priority, Reverse<usize>, usize)>>,
    settled: Settled,
}

/// Where a tangent begins: a place that stands for the start, or a feature.
#[derive(Clone, Copy)]
enum From<'a> {
    Start(Point),
    Feature(Departure<'a>),
}

impl<'a> Search<'a> {
    fn begin(&mut self) {
        for &place in &self.start.places {
            self.push(Label {
                place: Place::Start,
                step: Step::Begin,
                parent: usize::MAX,
                cost: 0.0,
                plan_from: place,
                plan_at: place,
                spoke: Vector::zeros(),
                left_spoke: Vector::zeros(),
            });
        }
    }

    fn push(&mut self, label: Label) {
        if self.is_served(&label) {
            return;
        }
        let at = match label.place {
            Place::Start => self.start.point,
            Place::Target => self.target.point,
            Place::Feature { lane, .. } => {
                let feature = &self.relaxation.features[lane.feature];
                feature.center + label.spoke * feature.price_radius
            }
        };
        let estimate = label.cost + (self.target.point - at).norm();
        let index = self.labels.len();
        self.labels.push(label);
        self.open.push(Reverse((estimate.to_bits(), Reverse(index), index)));
    }

    /// Whether a label that was expanded before does all that this one could, at no higher cost.
    fn is_served(&self, label: &Label) -> bool {
        let Place::Feature { lane, offset } = label.place else { return false };
        let radius = self.relaxation.features[lane.feature].price_radius;
        self.settled.serves(lane, radius, offset, label.cost)
    }

    /// Whether some barrier is in the way of the straight move that leads to the label.
    fn is_blocked(&self, label: &Label) -> bool {
        if label.plan_from == label.plan_at {
            return false;
        }
        let piece = Edge::Segment(Segment::new(label.plan_from, label.plan_at));
        self.relaxation.obstruction.blocking(&piece).next().is_some()
    }

    fn expand(&mut self, index: usize, budget: &Budget) -> Result<(), Interrupt> {
        let label = self.labels[index];
        let (from, left_feature) = match label.place {
            Place::Start => (From::Start(label.plan_at), None),
            Place::Feature { lane, offset } => {
                self.settled.add(lane, offset, label.cost);
                let departure = self.departure(&label, lane, offset);
                self.push_over(index, &departure);
                (From::Feature(departure), Some(lane.feature))
            }
            Place::Target => return Ok(()),
        };
        for &place in &self.target.places {
            self.push_target(index, &from, place);
        }
        for other in (0..self.relaxation.features.len()).filter(|&other| Some(other) != left_feature) {
            // A label may meet a hundred thousand features, each with thousands of blockers near it.
            if other % 8 == 7 || !self.relaxation.knows_stretches(other) {
                budget.check(0)?;
            }
            for side in Side::BOTH {
                self.push_tangent(index, &from, other, side);
            }
        }
        if self.labels.len() > LABEL_LIMIT { Err(Interrupt::Memory) } else { Ok(()) }
    }

    fn departure(&self, label: &Label, lane: Lane, offset: f64) -> Departure<'a> {
        Departure {
            lane,
            circle: &self.relaxation.features[lane.feature],
            free: self.relaxation.free_stretches(lane.feature)[lane.stretch],
            offset,
            spoke: label.spoke,
            cost: label.cost,
        }
    }

    /// The offset at which `plan` leaves `from`, unless the way does not lead there or another label of the lane
    /// is there for less. A start is left anywhere.
    fn leaves_at(&self, from: &From<'_>, plan: &Tangent) -> Option<f64> {
        let From::Feature(departure) = from else { return Some(0.0) };
        let left = departure.leaves_at(plan)?;
        let cost = departure.planned_cost(left);
        let idle = self.settled.beats(departure.lane, departure.circle.price_radius, left, cost);
        (!idle).then_some(left)
    }

    /// Straight to a place that stands for the target.
    fn push_target(&mut self, index: usize, from: &From<'_>, place: Point) {
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
    fn push_tangent(&mut self, index: usize, from: &From<'_>, other: usize, side: Side) {
        let circle = &self.relaxation.features[other];
        if let From::Feature(departure) = from
            && departure.lane.side == side
            && self.goes_over(departure.lane.feature, other)
        {
            return;
        }
        let Some(plan) = from.planned(circle.center, circle.plan_radius * side.sign()) else { return };
        let Some(offset) = circle.offset_of(-plan.normal * side.sign(), plan.angle_error) else { return };
        let Some(left_at) = self.leaves_at(from, &plan) else { return };
        let Some(stretch) = self.relaxation.stretch_at(other, offset) else { return };
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
            place: Place::Feature { lane: Lane { feature: other, side, stretch }, offset },
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
    fn push_over(&mut self, index: usize, departure: &Departure<'_>) {
        let (lane, circle) = (departure.lane, departure.circle);
        let entry = |onto: usize| match lane.side {
            Side::Left => 0.0,
            Side::Right => self.relaxation.features[onto].sweep,
        };
        let (neighbour, end) = match lane.side {
            Side::Left => (circle.after, circle.sweep),
            Side::Right => (circle.before, 0.0),
        };
        let mut over: Vec<(usize, f64, f64)> =
            neighbour.map(|onto| (onto, end, entry(onto))).into_iter().collect();
        for (other, onto) in self.relaxation.features.iter().enumerate() {
            if other == lane.feature || Some(other) == neighbour || !self.same_circle(lane.feature, other) {
                continue;
            }
            if let Some(here) = onto.offset_of(circle.direction_at(departure.offset), 0.0) {
                over.push((other, departure.offset, here));
            } else if let Some(left) = circle.offset_of(onto.direction_at(entry(other)), 0.0) {
                over.push((other, left, entry(other)));
            }
        }
        for (other, left_at, offset) in over {
            self.push_onto(index, departure, left_at, other, offset);
        }
    }

    fn push_onto(
        &mut self,
        index: usize,
        departure: &Departure<'_>,
        left_at: f64,
        other: usize,
        offset: f64,
    ) {
        if !departure.reaches(left_at) {
            return;
        }
        let Some(stretch) = self.relaxation.stretch_at(other, offset) else { return };
        let onto = &self.relaxation.features[other];
        let left_spoke = departure.circle.direction_at(left_at);
        let at = onto.plan_point(offset);
        self.push(Label {
            place: Place::Feature { lane: Lane { feature: other, stretch, ..departure.lane }, offset },
            step: Step::Over { left_at },
            parent: index,
            cost: departure.cost_at(left_at, left_spoke),
            plan_from: at,
            plan_at: at,
            spoke: onto.direction_at(offset),
            left_spoke,
        });
    }

    /// Whether both circles are the same.
    fn same_circle(&self, one: usize, other: usize) -> bool {
        let (a, b) = (&self.relaxation.features[one], &self.relaxation.features[other]);
        a.plan_radius > 0.0
            && (a.plan_radius - b.plan_radius).abs() < CONTACT_TOLERANCE_MM / 2.0
            && (a.center - b.center).norm() < CONTACT_TOLERANCE_MM / 2.0
    }

    /// Whether a path passes from one feature to the other without a straight move.
    fn goes_over(&self, one: usize, other: usize) -> bool {
        let feature = &self.relaxation.features[one];
        feature.after == Some(other) || feature.before == Some(other) || self.same_circle(one, other)
    }

    fn route(&self, last: usize) -> Route {
        let mut stops = Vec::new();
        let mut straights = Vec::new();
        let mut index = last;
        loop {
            let label = &self.labels[index];
            let left = match label.step {
                Step::Begin => break,
                Step::Tangent { left_at } => {
                    straights.push((label.plan_from, label.plan_at));
                    left_at
                }
                Step::Over { left_at } => left_at,
            };
            let parent = &self.labels[label.parent];
            if let Place::Feature { lane, offset } = parent.place {
                stops.push(Stop {
                    feature: lane.feature,
                    side: lane.side,
                    from: offset,
                    to: left,
                    spoke_in: parent.spoke,
                    spoke_out: label.left_spoke,
                    turned: self.departure(parent, lane, offset).turned(left, label.left_spoke),
                });
            }
            index = label.parent;
        }
        stops.reverse();
        straights.reverse();
        Route { cost: self.labels[last].cost, stops, straights }
    }
}

impl From<'_> {
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
