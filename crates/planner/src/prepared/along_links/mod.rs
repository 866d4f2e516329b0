//! The shortest path in a prepared scene: best-first search (A*: P. Hart, N. Nilsson, B. Raphael 1968) along links,
//! tangents that nothing blocks.
//!
//! Only the ends are new to the scene. The target is tried from every feature that the search comes by. What can be seen
//! from the start is not worked out to the end: its tangents are offered as they can matter, by what is in view through a
//! mesh (`cones`) or, without one, by an ellipse round start and target that grows with the estimates (`growth`), at first with
//! a bound of what they cost; each is worked out and tested when it is its turn.
//!
//! Exact: before a label of some estimate is looked into, every feature that a path of that cost can touch was offered to
//! the start; labels are left out where [`Best`] says that they are idle.
//!
//! Cost: one look at the target for each label that is looked into, and a few nanoseconds for each link that goes on from
//! it.

mod departure;
mod route;

use super::cones::{ConeRoom, Cones};
use super::growth::Growth;
use super::horizon::Horizon;
use super::label::{Label, Step};
use super::mesh::Mesh;
use super::scene::horizon;
use super::sights::Sights;
use super::terrain::Terrain;
use crate::barrier::Side;
use crate::search::{Best, End, Ground, LABEL_LIMIT, Route, Sector, TURN_TOLERANCE, Tangent};
use departure::Departure;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt, Observer};

/// So many features are offered to the start before a horizon is worked out.
const OFFERED_WITHOUT_HORIZON: usize = 256;

/// A tangent from the start that costs more than was guessed by no more than this share is looked into at once.
const GUESS_RATIO: f64 = 1e-11;

/// The budget is looked at once for so many labels.
const LABELS_BETWEEN_CHECKS: u64 = 16;

/// A search with more labels than this does not keep its memory for the next one.
const ROOM_LABELS: usize = 1 << 16;

/// The memory of a search, to be used again.
#[derive(Default)]
pub(super) struct Room {
    labels: Vec<Label>,
    /// Lowest estimate first, by its bits: estimates are finite and not negative, so these sort as they do. The later
    /// label of equals, which is nearer to the target.
    open: BinaryHeap<(Reverse<u64>, u32)>,
    best: Best,
    /// Labels that were looked into at features that are blocked in part.
    paid: FxHashMap<(u32, Side), Vec<Paid>>,
    found: Vec<u32>,
    cones: ConeRoom,
    /// Features that only dearer paths can touch, with the least cost of such a path.
    waiting: Vec<(f64, u32)>,
}

/// A label that was looked into.
struct Paid {
    stretch: usize,
    offset: f64,
    cost: f64,
}

/// A search under way.
pub(super) struct AlongLinks<'a> {
    terrain: &'a Terrain,
    sights: &'a mut Sights,
    start: &'a End,
    target: &'a End,
    room: &'a mut Room,
    growth: Growth,
    /// What is in view, where there is a mesh.
    cones: Option<Cones<'a>>,
    /// Worked out when it begins to pay.
    horizon: Option<Horizon>,
    offered_count: usize,
    /// Every feature that a path of this cost may touch was offered to the start.
    offered: f64,
    /// No path costs less, millimetres.
    pub(super) lower_bound: f64,
}

impl<'a> AlongLinks<'a> {
    pub(super) fn new(
        terrain: &'a Terrain,
        mesh: Option<&'a Mesh>,
        sights: &'a mut Sights,
        [start, target]: [&'a End; 2],
        room: &'a mut Room,
    ) -> Self {
        if room.labels.capacity() > ROOM_LABELS {
            *room = Room::default();
        }
        room.labels.clear();
        room.open.clear();
        room.paid.clear();
        room.waiting.clear();
        room.best.begin(terrain.features.len());
        let growth = Growth::new(start.point, target.point);
        let cones = mesh.and_then(|mesh| {
            Cones::new(terrain, mesh, [start.point, target.point], &start.places, &mut room.cones)
        });
        let (horizon, offered_count) = (None, 0);
        Self {
            terrain,
            sights,
            start,
            target,
            room,
            growth,
            cones,
            horizon,
            offered_count,
            offered: 0.0,
            lower_bound: 0.0,
        }
    }

    /// The shortest path, if there is one. `steps` counts the labels that were looked into.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn run(
        &mut self,
        budget: &Budget,
        steps: &mut u64,
        observer: &mut dyn Observer,
    ) -> Result<Option<Route>, Interrupt> {
        budget.check(*steps)?;
        self.lower_bound = (self.target.point - self.start.point).norm();
        if let Some(places) = self.free_straight_way() {
            observer.better_bound(self.lower_bound);
            return Ok(Some(Route { cost: self.lower_bound, stops: Vec::new(), places }));
        }
        let mut looks: u64 = 0;
        loop {
            // Labels that come to nothing take time as well.
            looks += 1;
            if looks.is_multiple_of(LABELS_BETWEEN_CHECKS) {
                budget.check(*steps)?;
            }
            let lowest =
                self.room.open.peek().map_or(f64::INFINITY, |(Reverse(bits), _)| f64::from_bits(*bits));
            if self.offered < lowest {
                budget.check(*steps)?;
                self.offer(lowest, budget)?;
                continue;
            }
            let Some((_, index)) = self.room.open.pop() else { return Ok(None) };
            self.lower_bound = self.lower_bound.max(lowest);
            let mut label = self.room.labels[index as usize];
            match label.step {
                Step::ToTarget => {
                    if self.reaches_target(&label) {
                        observer.better_bound(self.lower_bound);
                        return Ok(Some(self.route(&label)));
                    }
                    continue;
                }
                Step::Guess | Step::Untested => {
                    let Some(tested) = self.tested(index, lowest) else { continue };
                    label = tested;
                }
                Step::FromStart | Step::Link | Step::Over => {}
            }
            let Some(departure) = self.stand(index, label) else { continue };
            *steps += 1;
            if steps.is_multiple_of(LABELS_BETWEEN_CHECKS) || budget.iterations.is_some() {
                budget.check(*steps)?;
            }
            if self.room.labels.len() > LABEL_LIMIT {
                return Err(Interrupt::Memory);
            }
            self.reach_for_target(&departure);
            if self.terrain.is_joined(label.feature()) {
                self.push_over(&departure);
            }
            self.sights.see(self.terrain, label.feature(), label.side(), budget)?;
            self.push_links(&departure);
        }
    }

    /// Places that stand for start and target, with nothing between them.
    fn free_straight_way(&self) -> Option<[Point; 2]> {
        let from_each = |&from: &Point| self.target.places.iter().map(move |&to| [from, to]);
        self.start.places.iter().flat_map(from_each).find(|&[from, to]| self.terrain.is_free(from, to))
    }

    /// Offers features to the start until all that a path of cost `cost` may touch were.
    ///
    /// # Errors
    /// The budget ended.
    fn offer(&mut self, cost: f64, budget: &Budget) -> Result<(), Interrupt> {
        let mut found = std::mem::take(&mut self.room.found);
        found.clear();
        let by_cones = match &mut self.cones {
            Some(cones) => cones.grow(&mut self.room.cones, cost, &mut found, budget)?,
            None => None,
        };
        self.offered = by_cones.unwrap_or_else(|| {
            // From here on by the ellipse, which offers some once more.
            self.cones = None;
            self.growth.grow(&self.terrain.layer, cost, &mut found)
        });
        if self.cones.is_none()
            && self.horizon.is_none()
            && self.offered_count + found.len() > OFFERED_WITHOUT_HORIZON
        {
            self.horizon = Some(horizon(self.terrain, self.start));
        }
        self.offered_count += found.len();
        for &feature in &found {
            if !self.terrain.is_there(feature) {
                continue;
            }
            let spot = self.terrain.spot(feature);
            let least = self.growth.least_cost(spot.center, spot.plan_radius);
            if least <= self.offered {
                self.guess(feature, least);
            } else {
                self.room.waiting.push((least, feature));
            }
        }
        found.clear();
        let offered = self.offered;
        self.room.waiting.retain(|&(least, feature)| {
            let due = least <= offered;
            if due {
                found.push(feature);
            }
            !due
        });
        for &feature in &found {
            let spot = self.terrain.spot(feature);
            self.guess(feature, self.growth.least_cost(spot.center, spot.plan_radius));
        }
        self.room.found = found;
        Ok(())
    }

    /// Offers the start the tangents to a feature, of which no more is known than what a path by it costs at least.
    fn guess(&mut self, feature: u32, least: f64) {
        let spot = self.terrain.spot(feature);
        let by = spot.center - self.start.point;
        if self.horizon.as_ref().is_some_and(|horizon| horizon.hides(by, spot.plan_radius)) {
            return;
        }
        for place in 0..self.start.places.len() {
            let ahead = Sector::all_round(self.start.places[place]);
            for side in ahead.may_reach(Side::Left, self.terrain.sector(feature)).into_iter().flatten() {
                self.open(least, Label::guess(feature, side, place as u32));
            }
        }
    }

    fn open(&mut self, estimate: f64, label: Label) {
        self.room.open.push((Reverse(estimate.to_bits()), self.room.labels.len() as u32));
        self.room.labels.push(label);
    }

    /// A tangent from the start, worked out and tested; none where there is none, where it is blocked or idle, or where
    /// it is not yet its turn: then it is opened again.
    fn tested(&mut self, index: u32, estimate: f64) -> Option<Label> {
        let mut label = self.room.labels[index as usize];
        if label.step == Step::Guess {
            label = self.worked_out(&label)?;
            self.room.labels[index as usize] = label;
            let exact = self.estimate(&label);
            if exact > estimate * (1.0 + GUESS_RATIO) {
                self.room.open.push((Reverse(exact.to_bits()), index));
                return None;
            }
        }
        let (feature, side) = (label.feature(), label.side());
        let circle = self.terrain.feature(feature);
        let is_whole = self.terrain.is_whole(feature);
        if is_whole && self.room.best.is_dearer(feature, circle.price_radius, label.offset, label.cost) {
            return None;
        }
        let from = self.start.places[label.from as usize];
        let planned = Tangent::between(from, 0.0, circle.center, circle.plan_radius * side.sign())?;
        if !self.terrain.is_free(planned.from, planned.to) {
            return None;
        }
        label.step = Step::FromStart;
        self.room.labels[index as usize] = label;
        if is_whole {
            // Where a place off the border stands for the start, the label's cost counts on its own side of the circle only:
            // there the way may have begun beyond the offset. Straight to it, it costs what it is worth on either side.
            let there = self.terrain.spot(feature).at(label.offset);
            let cost = label.cost.max((there - self.start.point).norm());
            self.room.best.improve(feature, side, circle.price_radius, label.offset, cost);
        }
        Some(label)
    }

    /// A tangent from the start, worked out.
    fn worked_out(&self, guess: &Label) -> Option<Label> {
        let circle = self.terrain.feature(guess.feature());
        let sign = guess.side().sign();
        let from = self.start.places[guess.from as usize];
        let planned = Tangent::between(from, 0.0, circle.center, circle.plan_radius * sign)?;
        let offset = circle.offset_of(-planned.normal * sign, planned.angle_error)?;
        let rho = circle.price_radius * sign;
        // Where the start is the corner itself, nothing lies between. What the arc is longer by because the answered way
        // arrives in a slightly different direction counts here.
        let price = Tangent::between(self.start.point, 0.0, circle.center, rho);
        let cost = price.map_or(0.0, |price| price.length - planned.angle_to(&price) * rho);
        Some(guess.worked_out(offset, cost))
    }

    /// What a path by a label at a feature costs at least.
    fn estimate(&self, label: &Label) -> f64 {
        let spot = self.terrain.spot(label.feature());
        label.cost + (self.target.point - spot.at(label.offset)).norm()
    }

    /// Looks into a label that is free. None where its arc is blocked, or where others serve.
    fn stand(&mut self, index: u32, label: Label) -> Option<Departure<'a>> {
        let (feature, side) = (label.feature(), label.side());
        let circle = self.terrain.feature(feature);
        let start = (label.step == Step::FromStart).then_some(self.start.point);
        if self.terrain.is_whole(feature) {
            let idle = self.room.best.is_dearer(feature, circle.price_radius, label.offset, label.cost);
            return (!idle).then_some(Departure { index, label, circle, free: (0.0, circle.sweep), start });
        }
        let stretches = self.terrain.stretches(feature);
        let stretch = stretches.at(label.offset, circle.offset_tolerance())?;
        let paid = self.room.paid.entry((feature, side)).or_default();
        let serves = |paid: &Paid| {
            let turn = (label.offset - paid.offset) * side.sign();
            paid.stretch == stretch
                && turn >= -TURN_TOLERANCE
                && paid.cost + circle.price_radius * turn <= label.cost + 1e-12
        };
        if paid.iter().any(serves) {
            return None;
        }
        paid.push(Paid { stretch, offset: label.offset, cost: label.cost });
        Some(Departure { index, label, circle, free: stretches.free[stretch], start })
    }

    /// Opens the target's labels from a departure; free ways are told when it is their turn.
    fn reach_for_target(&mut self, departure: &Departure<'_>) {
        let Departure { circle, label, .. } = departure;
        let side = label.side();
        for (place, &to) in self.target.places.iter().enumerate() {
            if !self.terrain.sector(label.feature()).may_lead_to(side, to, circle.plan_radius) {
                continue;
            }
            let Some(planned) = Tangent::between(circle.center, circle.plan_radius * side.sign(), to, 0.0)
            else {
                continue;
            };
            let Some(left_at) = departure.leaves_by(&planned) else { continue };
            let rho = circle.price_radius * side.sign();
            let Some(price) = Tangent::between(circle.center, rho, self.target.point, 0.0) else { continue };
            let along_arc = departure.cost_at(left_at) + price.length + planned.angle_to(&price) * rho;
            // A target that is priced from a place of its own may be left for before the arc begins: then straight.
            let cost = if rho == 0.0 {
                along_arc
            } else {
                along_arc.max(label.cost + (self.target.point - circle.price_point(label.offset)).norm())
            };
            self.open(cost, Label::target(place as u32, departure.index, left_at, cost));
        }
    }

    /// Whether nothing blocks the straight move to the target that ends a path.
    fn reaches_target(&self, last: &Label) -> bool {
        let before = &self.room.labels[last.from as usize];
        let circle = self.terrain.feature(before.feature());
        let to = self.target.places[last.place as usize];
        let planned = Tangent::between(circle.center, circle.plan_radius * before.side().sign(), to, 0.0);
        planned.is_some_and(|planned| self.terrain.is_free(planned.from, planned.to))
    }

    /// Along the links from a departure's feature.
    fn push_links(&mut self, departure: &Departure<'_>) {
        let Self { terrain, sights, room, target, .. } = self;
        let label = &departure.label;
        let Some(sight) = sights.sight(label.feature(), label.side()) else { return };
        let tolerance = departure.circle.offset_tolerance() * label.side().sign();
        sight.ahead(label.side(), label.offset - tolerance, |link| {
            let Some(left_at) = departure.leaves_along(link.left_at, link.angle_error()) else { return };
            let cost = departure.cost_at(left_at) + link.length;
            let feature = link.feature();
            let spot = terrain.spot(feature);
            if terrain.is_whole(feature)
                && !room.best.improve(feature, link.side(), spot.price_radius, link.offset, cost)
            {
                return;
            }
            let estimate = cost + (target.point - spot.at(link.offset)).norm();
            room.open.push((Reverse(estimate.to_bits()), room.labels.len() as u32));
            room.labels.push(Label::along(link, departure.index, left_at, cost));
        });
    }

    /// Onto what a departure's feature goes over into without a straight move: its neighbour on the border, or a feature
    /// on the same circle, at the first place from here on that both have.
    fn push_over(&mut self, departure: &Departure<'_>) {
        let Departure { circle, label, .. } = departure;
        let terrain = self.terrain;
        let (neighbour, end) = match label.side() {
            Side::Left => (circle.after, circle.sweep),
            Side::Right => (circle.before, 0.0),
        };
        let entry = |onto: u32| match label.side() {
            Side::Left => 0.0,
            Side::Right => terrain.feature(onto).sweep,
        };
        if let Some(onto) = neighbour {
            self.push_onto(departure, end, onto, entry(onto));
        }
        for other in terrain.on_same_circle(label.feature()).filter(|&other| Some(other) != neighbour) {
            let onto = terrain.feature(other);
            if let Some(here) = onto.offset_of(circle.direction_at(label.offset), 0.0) {
                self.push_onto(departure, label.offset, other, here);
            } else if let Some(left) = circle.offset_of(onto.direction_at(entry(other)), 0.0) {
                self.push_onto(departure, left, other, entry(other));
            }
        }
    }

    fn push_onto(&mut self, departure: &Departure<'_>, left_at: f64, other: u32, offset: f64) {
        if !departure.reaches(left_at) {
            return;
        }
        let cost = departure.cost_at(left_at);
        let label = Label::over(other, departure.label.side(), offset, departure.index, left_at, cost);
        self.open(self.estimate(&label), label);
    }
}
