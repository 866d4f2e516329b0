//! The best place in the plane: two fans, one from the start and one from the target, grow until a place at which their
//! ways meet is known to be the best.
//!
//! Best first over everything that is open: labels of both fans by what a path through them costs at least; pairs of bends,
//! one of each fan, with a part of a border that both lead to; places on it; spots. A place whose turn it is, and whose two
//! last moves nothing blocks, is the answer: nothing open costs less.
//!
//! **What may be dropped.** A place between two bends that is blocked, although its sum is the lowest of the pair's on the
//! part: where the pair's ways are not blocked its sum still falls towards the blocked place, and past the last free place a
//! way round what blocks goes on with the same slope, so that some other pair is better there. A bound from what is known of
//! fewer barriers stays a bound when more are met.
//!
//! Cost: two searches, and the pairs whose bounds are below the cost of a place that is known beforehand.

use super::detour::{Detour, Part, to_edge};
use super::permitted::Permitted;
use super::way::{reached_parts, way};
use crate::Stats;
use crate::barriers::Barriers;
use crate::measure::Measure;
use crate::search::{Aim, Bend, End, Fan, Known};
use crate::standing::stand;
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use traverse_geometry::{Bounds, CONTACT_TOLERANCE_MM, Edge, Point};
use traverse_solve::{Budget, Interrupt};

/// Most things that are open at once: about 100 MB.
const OPEN_LIMIT: usize = 1_000_000;

/// More boxes than this are one: how far a place is from all of them must stay quick to tell.
const BOX_LIMIT: usize = 16;

/// Where several places are wanted, those that cost more than a known one by more than this share are not looked for.
const WORTH_A_LOOK: f64 = 1.1;

/// The budget is looked at once for so many parts and spots.
const PARTS_BETWEEN_CHECKS: usize = 256;

/// A place and what the ways to it and on cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Met {
    pub(crate) place: Point,
    /// Of both ways, by the measure, as far as they lie in the plane.
    pub(crate) cost: f64,
    /// No place costs less.
    pub(crate) lower_bound: f64,
}

/// A bend and the parts of one border part that its ways lead to.
struct Entry {
    stance: u32,
    bend: Bend,
    /// Its ways to the border part cost at least this.
    least: f64,
    reached: Vec<(f64, f64)>,
}

/// One end's fan.
struct Side<'a, M> {
    fan: Fan<'a, M>,
    end: &'a End,
    left_out: &'a BTreeSet<usize>,
    /// Bends in the order in which they were found.
    bends: Vec<(u32, Bend)>,
    /// For every border part the bends that lead to it.
    entries: Vec<Vec<Entry>>,
}

/// What waits for its turn.
#[derive(Clone, Copy, Debug)]
enum Open {
    /// Two entries of a border part.
    Pair { part: u32, entries: [u32; 2] },
    /// The same, between two fractions.
    Stretch { part: u32, entries: [u32; 2], from: f64, to: f64 },
    /// A place between two stances.
    Place { stances: [u32; 2], at: Point },
    /// The way by a stance of the start to a spot.
    Approach { stance: u32, spot: u32 },
    /// The way by a stance of the target to a spot that the start reaches.
    Departure { stance: u32, spot: u32 },
}

/// What is to be met, between which ends.
pub(crate) struct Meeting<'a, M> {
    pub(crate) measure: M,
    pub(crate) barriers: &'a Barriers<'a>,
    pub(crate) permitted: &'a Permitted,
    /// Start and target.
    pub(crate) ends: [&'a End; 2],
    /// What the moves to the place and on pass over.
    pub(crate) left_out: [&'a BTreeSet<usize>; 2],
    /// A place that is known, and its cost.
    pub(crate) known: Option<(Point, f64)>,
}

impl<M: Measure> Meeting<'_, M> {
    /// The best places, best first, at most `count`; none when no permitted place is reached from both ends. `lower_bound`
    /// rises as more is known; nothing costs less than that of the first place.
    ///
    /// # Errors
    /// The budget ended before the first was known.
    pub(crate) fn best(
        &self,
        count: usize,
        stats: &mut Stats,
        budget: &Budget,
        lower_bound: &mut f64,
    ) -> Result<Vec<Met>, Interrupt> {
        let beyond =
            self.ends.map(|end| End { point: end.point, places: Vec::new(), shut_in_by: Vec::new() });
        let boxes = boxes(self.permitted);
        let [start, target] = [0, 1].map(|side| Side {
            fan: Fan::new(
                self.measure,
                Known::new(self.barriers, self.left_out[side]),
                self.ends[side],
                &beyond[1 - side],
                Aim::new(self.measure, boxes.iter().copied(), beyond[1 - side].point),
            ),
            end: self.ends[side],
            left_out: self.left_out[side],
            bends: Vec::new(),
            entries: self.permitted.parts.iter().map(|_| Vec::new()).collect(),
        });
        let mut search = Search {
            measure: self.measure,
            barriers: self.barriers,
            permitted: self.permitted,
            sides: [start, target],
            reached: vec![None; self.permitted.spots.len()],
            most: self.known.map_or(f64::INFINITY, |known| known.1)
                * if count > 1 { WORTH_A_LOOK } else { 1.0 },
            open: BinaryHeap::new(),
            waiting: Vec::new(),
        };
        let mut places = Vec::new();
        let found = search.places(count, budget, &mut stats.expanded_nodes, lower_bound, &mut places);
        let features: usize = search.sides.iter().map(|side| side.fan.feature_count()).sum();
        stats.barrier_vertices = stats.barrier_vertices.max(features as u64);
        match found {
            Err(interrupt) if places.is_empty() => return Err(interrupt),
            _ => {}
        }
        if let Some((place, cost)) = self.known
            && places.iter().all(|found| !is_same_place(found.place, place))
        {
            places.push(Met { place, cost, lower_bound: cost });
        }
        let least = places.iter().map(|found| found.lower_bound).fold(f64::INFINITY, f64::min);
        places.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        places.truncate(count);
        places.iter_mut().for_each(|found| found.lower_bound = least);
        Ok(places)
    }
}

fn is_same_place(one: Point, other: Point) -> bool {
    (one - other).norm() <= CONTACT_TOLERANCE_MM
}

/// Boxes that hold all that is permitted.
fn boxes(permitted: &Permitted) -> Vec<Bounds> {
    let parts = permitted.parts.iter().map(Edge::bounds);
    let all: Vec<Bounds> = parts.chain(permitted.spots.iter().map(|&p| Bounds::of([p]))).collect();
    if all.len() <= BOX_LIMIT { all } else { vec![all.into_iter().fold(Bounds::EMPTY, Bounds::union)] }
}

struct Search<'a, M> {
    measure: M,
    barriers: &'a Barriers<'a>,
    permitted: &'a Permitted,
    sides: [Side<'a, M>; 2],
    /// For every spot what the way there costs, once that is known.
    reached: Vec<Option<f64>>,
    /// What costs more is of no use.
    most: f64,
    open: BinaryHeap<(Reverse<u64>, Reverse<u32>)>,
    waiting: Vec<Open>,
}

impl<M: Measure> Search<'_, M> {
    /// Adds the best places, each once, until there are `count` or anything costs more than what is known.
    fn places(
        &mut self,
        count: usize,
        budget: &Budget,
        steps: &mut u64,
        lower_bound: &mut f64,
        places: &mut Vec<Met>,
    ) -> Result<(), Interrupt> {
        // What costs more than the first place tells nothing of the best one.
        let mut bound = *lower_bound;
        while places.len() < count {
            let found = self.next(budget, steps, &mut bound);
            if places.is_empty() {
                *lower_bound = bound;
            }
            let Some(met) = found? else { return Ok(()) };
            if places.iter().all(|known| !is_same_place(known.place, met.place)) {
                places.push(met);
            }
        }
        Ok(())
    }

    /// The best place that was not found before, before anything costs more than what is known.
    fn next(
        &mut self,
        budget: &Budget,
        steps: &mut u64,
        lower_bound: &mut f64,
    ) -> Result<Option<Met>, Interrupt> {
        loop {
            budget.check(*steps)?;
            let lowest = [0, 1].map(|side| self.sides[side].fan.lowest().unwrap_or(f64::INFINITY));
            let next = self.open.peek().map_or(f64::INFINITY, |(Reverse(bits), _)| f64::from_bits(*bits));
            let least = lowest[0].min(lowest[1]).min(next);
            if least == f64::INFINITY || least >= self.most || self.is_hopeless(lowest, next) {
                return Ok(None);
            }
            *lower_bound = lower_bound.max(least);
            if next > least {
                let side = usize::from(lowest[1] < lowest[0]);
                if let Some(stance) = self.sides[side].fan.grow(budget, steps)? {
                    self.add_bend(side, stance, budget)?;
                }
                continue;
            }
            let Some((_, Reverse(index))) = self.open.pop() else { return Ok(None) };
            if let Some(met) = self.take(self.waiting[index as usize], next, budget)? {
                return Ok(Some(met));
            }
        }
    }

    /// Whether an end reaches nothing that is permitted and never will.
    fn is_hopeless(&self, lowest: [f64; 2], next: f64) -> bool {
        next == f64::INFINITY
            && (0..2).any(|side| {
                let none = self.sides[side].entries.iter().all(Vec::is_empty);
                let no_spot =
                    self.permitted.spots.is_empty() || side == 0 && self.reached.iter().all(Option::is_none);
                lowest[side] == f64::INFINITY && none && no_spot
            })
    }

    /// Takes what has its turn, which costs at least `least`; the answer, if it is one.
    fn take(&mut self, open: Open, least: f64, budget: &Budget) -> Result<Option<Met>, Interrupt> {
        match open {
            Open::Pair { part, entries } => {
                let [one, other] = [0, 1].map(|side| &self.entry(side, part, entries).reached);
                let mut shared = Vec::new();
                for a in one {
                    for b in other {
                        let (from, to) = (a.0.max(b.0), a.1.min(b.1));
                        if from < to {
                            shared.push((from, to));
                        }
                    }
                }
                for (from, to) in shared {
                    self.look_into(part, entries, from, to)?;
                }
            }
            Open::Stretch { part, entries, from, to } => {
                let middle = f64::midpoint(from, to);
                self.look_into(part, entries, from, middle)?;
                self.look_into(part, entries, middle, to)?;
            }
            Open::Place { stances, at } => {
                let [Some(before), Some(after)] =
                    [self.way_to(0, stances[0], at, budget)?, self.way_to(1, stances[1], at, budget)?]
                else {
                    return Ok(None);
                };
                return Ok(Some(Met { place: at, cost: before + after, lower_bound: least }));
            }
            Open::Approach { stance, spot } => {
                let at = self.permitted.spots[spot as usize];
                if self.reached[spot as usize].is_none()
                    && let Some(cost) = self.way_to(0, stance, at, budget)?
                {
                    self.reached[spot as usize] = Some(cost);
                    for i in 0..self.sides[1].bends.len() {
                        self.leave_spot(i, spot)?;
                    }
                }
            }
            Open::Departure { stance, spot } => {
                let at = self.permitted.spots[spot as usize];
                let Some(before) = self.reached[spot as usize] else { return Ok(None) };
                if let Some(after) = self.way_to(1, stance, at, budget)? {
                    return Ok(Some(Met { place: at, cost: before + after, lower_bound: least }));
                }
            }
        }
        Ok(None)
    }

    fn entry(&self, side: usize, part: u32, entries: [u32; 2]) -> &Entry {
        &self.sides[side].entries[part as usize][entries[side] as usize]
    }

    /// What the way of an end by a stance to a place costs, if nothing blocks it.
    fn way_to(
        &mut self,
        side: usize,
        stance: u32,
        at: Point,
        budget: &Budget,
    ) -> Result<Option<f64>, Interrupt> {
        let side = &mut self.sides[side];
        if side.end.point == at && side.fan.bend(stance).turn.is_none() {
            return Ok(Some(0.0));
        }
        let end = stand(self.barriers, side.left_out, at, budget)?;
        side.fan.reaches(stance, &end, budget)
    }

    /// Takes in a bend of an end.
    fn add_bend(&mut self, side: usize, stance: u32, budget: &Budget) -> Result<(), Interrupt> {
        let bend = self.sides[side].fan.bend(stance);
        let end = self.sides[1 - side].end.point;
        let beyond = Bend { center: end, radius: 0.0, cost: 0.0, turn: None };
        for part in 0..self.permitted.parts.len() {
            if part.is_multiple_of(PARTS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            let edge = &self.permitted.parts[part];
            let least = bend.cost + to_edge(self.measure, &bend, edge);
            if least + to_edge(self.measure, &beyond, edge) >= self.most {
                continue;
            }
            let mut reached = Vec::new();
            reached_parts(&bend, edge, &mut reached);
            if reached.is_empty() {
                continue;
            }
            let own = self.sides[side].entries[part].len() as u32;
            for other in 0..self.sides[1 - side].entries[part].len() as u32 {
                let partner = &self.sides[1 - side].entries[part][other as usize];
                if least + partner.least >= self.most {
                    continue;
                }
                let bound =
                    Detour { measure: self.measure, before: &bend, after: &partner.bend, edge }.bound();
                let entries = if side == 0 { [own, other] } else { [other, own] };
                self.push(Open::Pair { part: part as u32, entries }, bound)?;
            }
            self.sides[side].entries[part].push(Entry { stance, bend, least, reached });
        }
        let index = self.sides[side].bends.len();
        self.sides[side].bends.push((stance, bend));
        for spot in 0..self.permitted.spots.len() {
            if spot.is_multiple_of(PARTS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            if side == 1 {
                self.leave_spot(index, spot as u32)?;
            } else if self.reached[spot].is_none() {
                let at = self.permitted.spots[spot];
                if let Some(way) = way(self.measure, &bend, at) {
                    let bound = way.cost + self.measure.along(end - at);
                    self.push(Open::Approach { stance, spot: spot as u32 }, bound)?;
                }
            }
        }
        Ok(())
    }

    /// Offers a bend of the target a spot that the start reaches.
    fn leave_spot(&mut self, bend: usize, spot: u32) -> Result<(), Interrupt> {
        let Some(before) = self.reached[spot as usize] else { return Ok(()) };
        let (stance, bend) = self.sides[1].bends[bend];
        let Some(way) = way(self.measure, &bend, self.permitted.spots[spot as usize]) else { return Ok(()) };
        self.push(Open::Departure { stance, spot }, before + way.cost)
    }

    /// Finds what is to be done with a stretch of a part that both entries lead to.
    fn look_into(&mut self, part: u32, entries: [u32; 2], from: f64, to: f64) -> Result<(), Interrupt> {
        let [one, other] = [0, 1].map(|side| self.entry(side, part, entries));
        let edge = &self.permitted.parts[part as usize];
        let stances = [one.stance, other.stance];
        let detour = Detour { measure: self.measure, before: &one.bend, after: &other.bend, edge };
        for known in detour.part(from, to) {
            let (open, bound) = match known {
                Part::Lowest(at, cost) => (Open::Place { stances, at }, cost),
                Part::Near(at, bound) => (Open::Place { stances, at }, bound),
                Part::Open(bound) => (Open::Stretch { part, entries, from, to }, bound),
            };
            self.push(open, bound)?;
        }
        Ok(())
    }

    fn push(&mut self, open: Open, bound: f64) -> Result<(), Interrupt> {
        if bound >= self.most {
            return Ok(());
        }
        if self.waiting.len() >= OPEN_LIMIT {
            return Err(Interrupt::Memory);
        }
        self.open.push((Reverse(bound.max(0.0).to_bits()), Reverse(self.waiting.len() as u32)));
        self.waiting.push(open);
        Ok(())
    }
}
