//! Best-first search over tangents (A*: P. Hart, N. Nilsson, B. Raphael 1968), straight moves tested only when they
//! are reached. Cost: each expanded label meets every feature once; a test costs about log n.

use super::label::{Label, Place, Route, Step, Stop};
use super::{End, Relaxation, Tangent};
use crate::barrier::{Feature, Side};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Point, Segment, Vector, cross};
use traverse_solve::{Budget, Interrupt};

/// Costs that differ by less than this are equal, millimetres: rounding, far below what is promised.
const COST_TOLERANCE_MM: f64 = 1e-12;

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
        settled: HashMap::new(),
    };
    search.begin();
    while let Some(Reverse((_, _, index))) = search.open.pop() {
        let label = search.labels[index];
        if search.is_served(&label) || search.is_blocked(&label) {
            continue;
        }
        match label.place {
            Place::Target => return Ok(Some(search.route(index))),
            Place::Start => {
                budget.check(*expanded)?;
                *expanded += 1;
                search.expand_start(index, budget)?;
            }
            Place::Feature { feature, side, stretch, offset } => {
                budget.check(*expanded)?;
                *expanded += 1;
                search.settled.entry((feature, side.index(), stretch)).or_default().push((offset, label.cost));
                search.expand_feature(index, feature, side, stretch, offset, budget)?;
            }
        }
    }
    Ok(None)
}

/// An order of costs for the heap; costs are finite and not negative, so their bits sort as they do.
type Priority = u64;

struct Search<'a> {
    relaxation: &'a Relaxation,
    start: &'a End,
    target: &'a End,
    labels: Vec<Label>,
    /// Lowest estimate first; the later label of equals, which is nearer to the target.
    open: BinaryHeap<Reverse<(Priority, Reverse<usize>, usize)>>,
    /// Offsets and costs of expanded labels per feature, side and free stretch.
    settled: HashMap<(usize, usize, usize), Vec<(f64, f64)>>,
}

impl Search<'_> {
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
            Place::Feature { feature, .. } => {
                let feature = &self.relaxation.features[feature];
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
        let Place::Feature { feature, side, stretch, offset } = label.place else { return false };
        self.is_served_at(feature, side, stretch, offset, label.cost)
    }

    fn is_served_at(&self, feature: usize, side: Side, stretch: usize, offset: f64, cost: f64) -> bool {
        let radius = self.relaxation.features[feature].price_radius;
        self.settled.get(&(feature, side.index(), stretch)).is_some_and(|settled| {
            settled.iter().any(|&(from, paid)| {
                let turn = (offset - from) * side.sign();
                turn >= 0.0 && paid + radius * turn <= cost + COST_TOLERANCE_MM
            })
        })
    }

    /// Whether some barrier is in the way of the straight move that leads to the label.
    fn is_blocked(&self, label: &Label) -> bool {
        if label.plan_from == label.plan_at {
            return false;
        }
        let piece = Edge::Segment(Segment::new(label.plan_from, label.plan_at));
        self.relaxation.obstruction.blocking(&piece).next().is_some()
    }

    fn expand_start(&mut self, index: usize, budget: &Budget) -> Result<(), Interrupt> {
        let at = self.labels[index].plan_at;
        self.push_targets(index, at, 0.0, None);
        let from = Leaving { center: at, plan_rho: 0.0, price_center: self.start.point, price_rho: 0.0 };
        for feature in 0..self.relaxation.features.len() {
            check_sometimes(feature, budget)?;
            for side in Side::BOTH {
                self.push_tangent(index, &from, None, feature, side);
            }
        }
        Ok(())
    }

    fn expand_feature(
        &mut self,
        index: usize,
        feature: usize,
        side: Side,
        stretch: usize,
        offset: f64,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let circle = self.relaxation.features[feature];
        let departing = Departing { feature, side, stretch, offset };
        self.push_over(index, &departing, &circle);
        let from = Leaving {
            center: circle.center,
            plan_rho: circle.plan_radius * side.sign(),
            price_center: circle.center,
            price_rho: circle.price_radius * side.sign(),
        };
        for place in self.target.places.clone() {
            let Some(plan) = Tangent::between(from.center, from.plan_rho, place, 0.0) else { continue };
            self.push_targets(index, place, from.price_rho, Some((&departing, &plan)));
        }
        for other in (0..self.relaxation.features.len()).filter(|&other| other != feature) {
            check_sometimes(other, budget)?;
            for other_side in Side::BOTH {
                self.push_tangent(index, &from, Some(&departing), other, other_side);
            }
        }
        Ok(())
    }

    /// Straight to the target: from a start place, or along `plan` from a feature.
    fn push_targets(&mut self, index: usize, at: Point, price_rho: f64, from: Option<(&Departing, &Tangent)>) {
        let parent = self.labels[index];
        let goal = self.target.point;
        match from {
            None => {
                for place in self.target.places.clone() {
                    self.push(Label {
                        place: Place::Target,
                        step: Step::Tangent { left_at: 0.0 },
                        parent: index,
                        cost: (goal - self.start.point).norm(),
                        plan_from: at,
                        plan_at: place,
                        ..parent
                    });
                }
            }
            Some((departing, plan)) => {
                let circle = &self.relaxation.features[departing.feature];
                let Some(left) = self.leave(&parent, departing, plan) else { return };
                let Some(price) = Tangent::between(circle.center, price_rho, goal, 0.0) else { return };
                let left_spoke = -price.normal * departing.side.sign();
                let turned = self.turned(&parent, departing, left, left_spoke);
                self.push(Label {
                    place: Place::Target,
                    step: Step::Tangent { left_at: left },
                    parent: index,
                    cost: parent.cost + circle.price_radius * turned + price.length,
                    plan_from: plan.from,
                    plan_at: plan.to,
                    left_spoke,
                    ..parent
                });
            }
        }
    }

    /// Along a tangent to another feature.
    fn push_tangent(
        &mut self,
        index: usize,
        from: &Leaving,
        departing: Option<&Departing>,
        other: usize,
        side: Side,
    ) {
        let circle = &self.relaxation.features[other];
        let plan_rho = circle.plan_radius * side.sign();
        if departing.is_some_and(|d| d.side == side && self.goes_over(d.feature, other)) {
            return;
        }
        let Some(plan) = Tangent::between(from.center, from.plan_rho, circle.center, plan_rho) else { return };
        let arriving = -plan.normal * side.sign();
        let Some(offset) = circle.offset_of(arriving, plan.angle_error) else { return };
        let parent = self.labels[index];
        let left = match departing {
            None => 0.0,
            Some(departing) => match self.leave(&parent, departing, &plan) {
                Some(left) => left,
                None => return,
            },
        };
        let Some(stretch) = self.relaxation.stretch_at(other, offset) else { return };
        let price_rho = circle.price_radius * side.sign();
        let price = Tangent::between(from.price_center, from.price_rho, circle.center, price_rho);
        let (normal, length) = price.map_or((plan.normal, 0.0), |price| (price.normal, price.length));
        let left_spoke = departing.map_or(Vector::zeros(), |departing| -normal * departing.side.sign());
        let arc = departing.map_or(0.0, |departing| {
            let radius = self.relaxation.features[departing.feature].price_radius;
            radius * self.turned(&parent, departing, left, left_spoke)
        });
        self.push(Label {
            place: Place::Feature { feature: other, side, stretch, offset },
            step: Step::Tangent { left_at: left },
            parent: index,
            cost: parent.cost + arc + length,
            plan_from: plan.from,
            plan_at: plan.to,
            spoke: -normal * side.sign(),
            left_spoke,
        });
    }

    /// Onto what the feature goes over into without a straight move: its neighbour on the border, or a feature on
    /// the same circle.
    fn push_over(&mut self, index: usize, departing: &Departing, circle: &Feature) {
        let (neighbour, end) = match departing.side {
            Side::Left => (circle.after, circle.sweep),
            Side::Right => (circle.before, 0.0),
        };
        if let Some(other) = neighbour {
            let entry = match departing.side {
                Side::Left => 0.0,
                Side::Right => self.relaxation.features[other].sweep,
            };
            self.push_onto(index, departing, end, other, entry);
        }
        for other in 0..self.relaxation.features.len() {
            if other == departing.feature || Some(other) == neighbour || !self.same_circle(departing.feature, other) {
                continue;
            }
            // The first place from here on that both have.
            let onto = self.relaxation.features[other];
            let entry = match departing.side {
                Side::Left => 0.0,
                Side::Right => onto.sweep,
            };
            let here = onto.offset_of(circle.direction_at(departing.offset), 0.0);
            match here {
                Some(here) => self.push_onto(index, departing, departing.offset, other, here),
                None => {
                    if let Some(offset) = circle.offset_of(onto.direction_at(entry), 0.0) {
                        self.push_onto(index, departing, offset, other, entry);
                    }
                }
            }
        }
    }

    fn push_onto(&mut self, index: usize, departing: &Departing, left: f64, other: usize, entry: f64) {
        let parent = self.labels[index];
        if !self.reaches(departing, left) {
            return;
        }
        let Some(stretch) = self.relaxation.stretch_at(other, entry) else { return };
        let circle = &self.relaxation.features[departing.feature];
        let onto = &self.relaxation.features[other];
        let left_spoke = circle.direction_at(left);
        let at = onto.plan_point(entry);
        self.push(Label {
            place: Place::Feature { feature: other, side: departing.side, stretch, offset: entry },
            step: Step::Over { left_at: left },
            parent: index,
            cost: parent.cost + circle.price_radius * self.turned(&parent, departing, left, left_spoke),
            plan_from: at,
            plan_at: at,
            spoke: onto.direction_at(entry),
            left_spoke,
        });
    }

    /// The offset at which `plan` leaves the feature, if the way along the arc leads there.
    fn leave(&self, parent: &Label, departing: &Departing, plan: &Tangent) -> Option<f64> {
        let circle = &self.relaxation.features[departing.feature];
        let leaving = -plan.normal * departing.side.sign();
        let mut left = circle.offset_of(leaving, plan.angle_error)?;
        // A turn back by rounding is none.
        let back = (departing.offset - left) * departing.side.sign();
        if back > 0.0 && back <= plan.angle_error.max(circle.offset_tolerance()) {
            left = departing.offset;
        }
        if !self.reaches(departing, left) {
            return None;
        }
        let turn = (left - departing.offset) * departing.side.sign();
        let cost = parent.cost + circle.price_radius * turn;
        // Another label of this feature that does the same for less makes this departure idle.
        let settled = self.settled.get(&(departing.feature, departing.side.index(), departing.stretch))?;
        let idle = settled.iter().any(|&(from, paid)| {
            let turn = (left - from) * departing.side.sign();
            turn >= 0.0 && paid + circle.price_radius * turn < cost - COST_TOLERANCE_MM
        });
        (!idle).then_some(left)
    }

    /// Whether `left` lies ahead on the same free stretch.
    fn reaches(&self, departing: &Departing, left: f64) -> bool {
        let circle = &self.relaxation.features[departing.feature];
        let tolerance = circle.offset_tolerance();
        let (from, to) = self.relaxation.free_stretches(departing.feature)[departing.stretch];
        (left - departing.offset) * departing.side.sign() >= 0.0
            && from - tolerance <= left
            && left <= to + tolerance
    }

    /// The angle that the answered path turns on the feature, radians, not negative: the planned path's, and what
    /// both directions differ by.
    fn turned(&self, parent: &Label, departing: &Departing, left: f64, left_spoke: Vector) -> f64 {
        let circle = &self.relaxation.features[departing.feature];
        let planned = (left - departing.offset) * departing.side.sign();
        let in_by = small_angle(circle.direction_at(departing.offset), parent.spoke);
        let out_by = small_angle(circle.direction_at(left), left_spoke);
        (planned + (out_by - in_by) * departing.side.sign()).max(0.0)
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
            if let Place::Feature { feature, side, stretch, offset } = parent.place {
                let departing = Departing { feature, side, stretch, offset };
                stops.push(Stop {
                    feature,
                    side,
                    from: offset,
                    to: left,
                    spoke_in: parent.spoke,
                    spoke_out: label.left_spoke,
                    turned: self.turned(parent, &departing, left, label.left_spoke),
                });
            }
            index = label.parent;
        }
        stops.reverse();
        straights.reverse();
        Route { cost: self.labels[last].cost, stops, straights }
    }
}

/// A circle or point that a tangent leaves.
struct Leaving {
    center: Point,
    plan_rho: f64,
    price_center: Point,
    price_rho: f64,
}

/// The label's place that is being left.
struct Departing {
    feature: usize,
    side: Side,
    stretch: usize,
    offset: f64,
}

/// The angle from `a` to `b`, both unit vectors that hardly differ.
fn small_angle(a: Vector, b: Vector) -> f64 {
    cross(a, b).atan2(a.dot(&b))
}

/// The budget is looked at between features too: a label may meet a hundred thousand of them.
fn check_sometimes(count: usize, budget: &Budget) -> Result<(), Interrupt> {
    if count % 4096 == 4095 { budget.check(0) } else { Ok(()) }
}
