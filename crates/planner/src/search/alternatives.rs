//! Other locally shortest ways, cheapest first.
//!
//! Free space with its border has no curvature that could let two locally shortest ways be moved into one another: each way
//! of going round the barriers (each homotopy class) has exactly one. So other kinds of ways are found as other taut paths: every
//! sequence of tangents and arcs that never turns back is one. They are looked for best first without dropping a label for
//! another one that is cheaper. Left out are paths that cross or touch themselves, such as one more turn round an obstacle.
//!
//! Every norm of the plane has the same ways: pulling a path tight makes it longer by none ([`crate::measure`]), and stays
//! among the paths that it can be moved into; so no path of a class costs less than its taut one. Only their order differs.
//!
//! What a label's path costs at least is known nearly exactly: a fan from the target grows ahead of the search and says what
//! the way on from a feature costs when it never turns back. Barriers that no path of the present estimate can touch are not
//! met yet.
//!
//! Cost: about as many expanded labels as the paths that are found have bends, and those that lead to nothing else.

use super::fan::{Aim, Fan};
use super::label::{Label, Place, Route, Step};
use super::route::route;
use super::shortest::{LABEL_LIMIT, Search};
use super::stance::From;
use super::trail::Trail;
use super::{End, Known, Way};
use crate::Stats;
use crate::barrier::{Feature, Side};
use crate::barriers::Barriers;
use crate::measure::Measure;
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use traverse_geometry::{Bounds, Point};
use traverse_solve::{Budget, Interrupt};

/// A path that bends by less than this goes straight on, radians: then the bend is no part of it.
const STRAIGHT_RAD: f64 = 1e-9;

/// Estimates that differ in so many of their last bits alone are equal: by a share of 1e-12.
const EQUAL_BITS: u32 = 12;

/// Estimates that rise by less than this share when they are looked at again are what they were: rounding.
const ESTIMATE_RATIO: f64 = 1e-11;

/// The fan grows ahead of the search by this share of the estimate. Were it level with it, a label of which the fan says nothing yet
/// would be looked into as soon as it costs no more than what is open there; with a little more, hardly any label is looked at again.
const FAN_AHEAD_RATIO: f64 = 0.01;

/// Whether the machine can run a straight move that nothing blocks, from point to point.
pub(crate) type HasRoom<'a> = &'a dyn Fn(Point, Point) -> bool;

/// What is asked for: locally shortest ways between two ends.
pub(crate) struct Between<'a, M> {
    pub(crate) measure: M,
    pub(crate) barriers: &'a Barriers<'a>,
    /// Owners of barriers that are taken for not there.
    pub(crate) left_out: &'a BTreeSet<usize>,
    pub(crate) ends: [&'a End; 2],
    /// Ways with a straight move that has no room are left out.
    pub(crate) has_room: HasRoom<'a>,
}

/// Locally shortest ways, the cheapest among them, cheapest first, at most `count`; fewer when the budget ends.
pub(crate) fn locally_shortest(
    asked: &Between<'_, impl Measure>,
    count: usize,
    stats: &mut Stats,
    budget: &Budget,
) -> Vec<Route> {
    let Between { measure, barriers, left_out, ends, has_room } = *asked;
    let beyond = End { point: ends[0].point, places: Vec::new(), shut_in_by: Vec::new() };
    let aim = Aim::new(measure, [Bounds::of([beyond.point])], beyond.point);
    let mut ways = Ways {
        barriers,
        forth: Search::by(measure, Known::new(barriers, left_out), ends[0], ends[1]),
        back: Fan::new(measure, Known::new(barriers, left_out), ends[1], &beyond, aim),
        has_room,
        numbers: Default::default(),
        to_meet: Vec::new(),
        labels: Vec::new(),
        open: BinaryHeap::new(),
        trails: Vec::new(),
        known: FxHashSet::default(),
        found: Vec::new(),
    };
    // What was found by then is of use all the same.
    let _ = ways.run(left_out, count, stats, budget);
    stats.barrier_vertices = stats.barrier_vertices.max(ways.forth.known.features.len() as u64);
    ways.found
}

struct Ways<'a, M> {
    barriers: &'a Barriers<'a>,
    forth: Search<'a, M>,
    /// From the target.
    back: Fan<'a, M>,
    has_room: HasRoom<'a>,
    /// In either search.
    numbers: [Numbers; 2],
    /// Owners not met yet, those that the dearest paths touch first, and what a path that touches them costs at least.
    to_meet: Vec<(f64, usize)>,
    /// With what a path through each costs at least.
    labels: Vec<(f64, Label)>,
    /// Lowest estimate first; the later label of equals, which is nearer to the target: by a norm that is not strict very many
    /// ways cost the same.
    open: BinaryHeap<(Reverse<u64>, u32)>,
    /// Of every stance of the search.
    trails: Vec<Trail>,
    /// Bends of the paths that were looked into.
    known: FxHashSet<u64>,
    found: Vec<Route>,
}

impl<M: Measure> Ways<'_, M> {
    fn run(
        &mut self,
        left_out: &BTreeSet<usize>,
        count: usize,
        stats: &mut Stats,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        self.list_owners(left_out, budget)?;
        while self.found.len() < count {
            budget.check(stats.expanded_nodes)?;
            let Some((estimate, label)) = self.pop() else {
                let Some(&(least, _)) = self.to_meet.last() else { return Ok(()) };
                self.meet_due(least, budget)?;
                continue;
            };
            if self.forth.tree.label_count() > LABEL_LIMIT {
                return Err(Interrupt::Memory);
            }
            if self.meet_due(estimate, budget)? {
                self.push(estimate, label);
                continue;
            }
            let ahead = estimate * (1.0 + FAN_AHEAD_RATIO);
            while self.back.lowest().is_some_and(|lowest| lowest <= ahead) {
                self.back.grow(budget, &mut stats.expanded_nodes)?;
            }
            let Some(now) = self.estimate(&label) else { continue };
            if now > estimate * (1.0 + ESTIMATE_RATIO) {
                self.push(now, label);
                continue;
            }
            if self.goes_straight(&label) || !self.is_free(&label, budget)? {
                continue;
            }
            let (tree, ground) = (&self.forth.tree, &self.forth.known);
            let trail = Trail::of(&label, tree, ground, &self.trails);
            let is_known = label.step != Step::Begin && !self.known.insert(trail.key);
            if is_known || trail.touches_itself(&label, tree, &self.trails) {
                continue;
            }
            if let Place::Target(_) = label.place {
                self.found.push(route(&self.forth.tree, &self.forth.known, &label));
                continue;
            }
            if let Place::Feature(feature, _) = label.place {
                self.forth.meet_beside(feature, budget)?;
            }
            let Some(stance) = self.forth.tree.stand_unsettled(&self.forth.known, &label) else { continue };
            stats.expanded_nodes += 1;
            self.trails.push(trail);
            self.forth.tree.reach_for_target(&self.forth.known, stance);
            let (features, bundles) = (0..self.forth.known.features.len(), 0..self.forth.known.bundles.len());
            self.forth.connect(stance, &features, bundles, budget)?;
        }
        Ok(())
    }

    /// Works out what a path that touches an owner's barrier costs at least.
    fn list_owners(&mut self, left_out: &BTreeSet<usize>, budget: &Budget) -> Result<(), Interrupt> {
        let (start, target) = (self.forth.tree.start.point, self.forth.tree.target.point);
        let measure = self.forth.tree.measure;
        let touched = |circle: &Feature| {
            let radius = circle.plan_radius;
            let ways = [circle.center - start, target - circle.center];
            ways.into_iter().map(|by| measure.near(by, radius)).sum::<f64>() * (1.0 - 1e-12)
        };
        let mut features = Vec::new();
        for owner in self.barriers.owners().filter(|owner| !left_out.contains(owner)) {
            features.clear();
            for outline in self.barriers.outlines(owner) {
                outline.add_features(&mut features, budget)?;
            }
            budget.check(0)?;
            let least = features.iter().map(touched).fold(f64::INFINITY, f64::min);
            if least.is_finite() {
                self.to_meet.push((least, owner));
            }
        }
        self.to_meet.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
        Ok(())
    }

    /// Meets the barriers that a path of cost `cost` may touch; whether there were any.
    fn meet_due(&mut self, cost: f64, budget: &Budget) -> Result<bool, Interrupt> {
        let mut any = false;
        while let Some((_, owner)) = self.to_meet.pop_if(|(least, _)| *least <= cost) {
            any |= self.meet(owner, budget)?;
        }
        Ok(any)
    }

    /// Meets a barrier in both searches; whether the way there did not know it.
    fn meet(&mut self, owner: usize, budget: &Budget) -> Result<bool, Interrupt> {
        let is_new = !self.forth.known.was_met(owner);
        if is_new {
            self.forth.meet(owner, budget)?;
        }
        if !self.back.search.known.was_met(owner) {
            self.back.search.meet(owner, budget)?;
        }
        Ok(is_new)
    }

    /// The open label of the lowest estimate, and that.
    fn pop(&mut self) -> Option<(f64, Label)> {
        loop {
            let best = self.open.peek().map(|(Reverse(rank), _)| highest_of(*rank));
            match self.forth.tree.lowest_estimate() {
                Some(estimate) if best.is_none_or(|best| estimate <= best) => {
                    let (estimate, label) = self.forth.tree.pop()?;
                    if let Some(better) = self.estimate(&label) {
                        self.push(estimate.max(better), label);
                    }
                }
                _ => {
                    let (_, index) = self.open.pop()?;
                    return Some(self.labels[index as usize]);
                }
            }
        }
    }

    fn push(&mut self, estimate: f64, label: Label) {
        self.open.push((Reverse(estimate.to_bits() >> EQUAL_BITS), self.labels.len() as u32));
        self.labels.push((estimate, label));
    }

    /// What a path through the label costs at least, as far as is known; none where no way leads on.
    fn estimate(&mut self, label: &Label) -> Option<f64> {
        let unknown = self.back.lowest();
        let measure = self.forth.tree.measure;
        let straight = |at: Point| label.cost + measure.along(self.forth.tree.target.point - at);
        match label.place {
            Place::Target(_) => Some(label.cost),
            Place::Start(_) => Some(straight(self.forth.tree.start.point)),
            Place::Feature(feature, side) => {
                let circle = self.forth.known.features[feature as usize];
                let owner = circle.owner;
                let nearest = label.cost
                    + measure.near(self.forth.tree.target.point - circle.center, circle.price_radius);
                let first = self.numbers[0].first_of(&self.forth.known.features, owner)?;
                let own = self.numbers[1].first_of(&self.back.search.known.features, owner);
                let least = own.and_then(|own| {
                    let there = own + (feature - first);
                    let arc = |from| measure.between(&circle, from, label.offset);
                    self.back.search.tree.settled.least(there, flipped(side), label.offset, arc)
                });
                match (least, unknown) {
                    (Some(least), None) => Some(label.cost + least),
                    // What is not settled yet costs at least what is open.
                    (Some(least), Some(lowest)) => Some((label.cost + least).min(lowest.max(nearest))),
                    (None, Some(lowest)) => Some(lowest.max(nearest)),
                    (None, None) => (own.is_none()).then_some(nearest),
                }
            }
        }
    }

    /// Whether the label's path leaves the feature before without having bent there: another label does without it.
    fn goes_straight(&self, label: &Label) -> bool {
        if label.step != Step::Tangent {
            return false;
        }
        let parent = &self.forth.tree.stances[label.parent as usize];
        let From::Feature(departure) = &parent.from else { return false };
        parent.label.step == Step::Tangent
            && (label.left_at - departure.offset).abs() <= STRAIGHT_RAD
            && self.forth.tree.leg(&self.forth.known, label).is_some_and(|leg| {
                departure.turned(label.left_at, parent.from.spoke_along(&leg)) <= STRAIGHT_RAD
            })
    }

    /// Whether nothing is in the way of the straight move that leads to the label, and it has room. Meets what is.
    fn is_free(&mut self, label: &Label, budget: &Budget) -> Result<bool, Interrupt> {
        let Some(leg) = self.forth.tree.leg(&self.forth.known, label) else { return Ok(true) };
        match self.forth.known.way(leg.planned.from, leg.planned.to) {
            Way::Free => Ok((self.has_room)(leg.planned.from, leg.planned.to)),
            Way::Blocked => Ok(false),
            Way::Meets(owner) => self.meet(owner, budget).map(|_| false),
        }
    }
}

/// The highest estimate of a rank.
fn highest_of(rank: u64) -> f64 {
    f64::from_bits((rank << EQUAL_BITS) | ((1 << EQUAL_BITS) - 1))
}

fn flipped(side: Side) -> Side {
    match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
    }
}

/// For every owner that was met the number of its first feature.
#[derive(Default)]
struct Numbers {
    first: FxHashMap<usize, u32>,
    /// So many features were taken in.
    count: usize,
}

impl Numbers {
    /// The number of an owner's first feature; none if it was not met.
    fn first_of(&mut self, features: &[Feature], owner: usize) -> Option<u32> {
        for (at, feature) in features.iter().enumerate().skip(self.count) {
            self.first.entry(feature.owner).or_insert(at as u32);
        }
        self.count = features.len();
        self.first.get(&owner).copied()
    }
}
