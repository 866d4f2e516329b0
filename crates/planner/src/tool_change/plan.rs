//! The best place for a tool change, exactly: from a scene, two ends, regions and points to a place and two moves.
//!
//! Clearances are tried in turn. At each the ends' ways out of the barriers are found, then where the change is permitted,
//! then the best pair of levels; at each pair that matters two fans meet in the best place of the plane. The moves there and
//! on are planned as any rapid moves.
//!
//! With limits of acceleration no place is proven best: what corners cost is not known before the moves are planned. Several
//! places, the best by length, are priced exactly; the bound is that of length at top speed, with what beginning and ending
//! at rest adds to both moves. The same places are looked at where dog-legs have no room at the best one.

use super::levels::best_pair;
use super::meeting::{Meeting, Met};
use super::parted::parted;
use super::permitted::{Permitted, Places};
use super::question::{ToolChange, ToolChangeAnswer, ToolChangePlan};
use crate::barriers::Barriers;
use crate::ends::clear_ends;
use crate::feasible::most_feasible;
use crate::level::{Levels, passed_over};
use crate::lowered::with_clearance;
use crate::measure::{AxisTime, Length, Measure};
use crate::prepared::LinksAtLast;
use crate::price::{at_rest, bound_of, of_search, straight, vertical};
use crate::rapid_move::{Asked, plan_among};
use crate::search::{End, Known, Search};
use crate::standing::stand;
use crate::{Answer, FeasibleClearance, NoPath, RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{Point, Scene, TravelCost};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

/// Sums of the same lengths differ by less than this share of them: rounding.
const ROUNDING_RATIO: f64 = 1e-12;

/// So many places are looked at where corners or dog-legs may cost more than is known of a place.
const PLACES: usize = 8;

/// So many spots are tried for a first place, nearest first.
const FIRST_SPOTS: usize = 3;

/// Places one tool change in a valid scene; `question` and its rules have no findings.
///
/// # Errors
/// As [`crate::plan_rapid_move`].
pub fn plan_tool_change(
    scene: &Scene,
    question: &ToolChange,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<(ToolChangeAnswer, Stats), Vec<Refusal>> {
    let mut stats = Stats::default();
    let Some((&smallest, larger)) = question.rules.clearances_mm.split_last() else {
        let answer = plan_in(scene, question, true, budget, &mut stats, observer)?;
        return Ok((answer, stats));
    };
    for &clearance in larger {
        let scene = with_clearance(scene, clearance);
        match plan_in(&scene, question, false, budget, &mut stats, observer) {
            Ok(ToolChangeAnswer::NoPath(_)) => {}
            Err(refusals) if refusals.iter().all(Refusal::is_about_room) => {}
            Ok(answer) => return Ok((answer, stats)),
            Err(refusals) => return Err(refusals),
        }
    }
    let scene = with_clearance(scene, smallest);
    let answer = plan_in(&scene, question, true, budget, &mut stats, observer)?;
    Ok((answer, stats))
}

/// Plans at the scene's own clearance. `is_last`: no smaller one is tried after it.
fn plan_in(
    scene: &Scene,
    question: &ToolChange,
    is_last: bool,
    budget: &Budget,
    stats: &mut Stats,
    observer: &mut dyn Observer,
) -> Result<ToolChangeAnswer, Vec<Refusal>> {
    let least = least_cost(question);
    let interrupted =
        |lower_bound: f64| move |interrupt| vec![Refusal::Interrupted { interrupt, lower_bound }];
    let barriers = Barriers::new(scene, budget).map_err(interrupted(least))?;
    let mut placing = Placing::new(&barriers, question, budget).map_err(interrupted(least))??;
    let found = placing.best(stats, observer);
    // A smaller clearance may have a cheaper place.
    let bound = if is_last { placing.lower_bound.max(least) } else { least };
    match found.map_err(interrupted(bound))? {
        Some(found) => {
            let plan = placing.plan(&found, stats, observer)?;
            Ok(ToolChangeAnswer::Plan(Box::new(plan)))
        }
        None if !is_last => Ok(ToolChangeAnswer::NoPath(NoPath {
            separating_obstacles: Vec::new(),
            feasible_clearance: FeasibleClearance::Unknown,
        })),
        None => {
            let separating_obstacles = placing.parting(stats).map_err(interrupted(bound))?;
            let mut is_feasible = |scene: &Scene| has_place(scene, question, budget, stats);
            let feasible_clearance =
                most_feasible(scene, &mut is_feasible).unwrap_or(FeasibleClearance::Unknown);
            Ok(ToolChangeAnswer::NoPath(NoPath { separating_obstacles, feasible_clearance }))
        }
    }
}

/// Whether there is any place at all.
fn has_place(
    scene: &Scene,
    question: &ToolChange,
    budget: &Budget,
    stats: &mut Stats,
) -> Result<bool, Interrupt> {
    let barriers = Barriers::new(scene, budget)?;
    let Ok(mut placing) = Placing::new(&barriers, question, budget)? else { return Ok(false) };
    let highest = placing.highest();
    Ok(!placing.meet(highest, stats)?.is_empty())
}

/// No tool change costs less, whatever is in the way.
fn least_cost(question: &ToolChange) -> f64 {
    let rise = question.rules.heights.zip(question.change_z_mm());
    let up = rise.map_or(0.0, |(rule, z)| (z - rule.start_z_mm).abs() + (z - rule.target_z_mm).abs());
    let (by, cost) = (question.target - question.start, &question.rules.cost);
    straight(by, cost) + vertical(up, cost) + at_rest(by.norm(), up, cost)
}

/// A tool change in a scene, ready to be placed.
struct Placing<'a> {
    barriers: &'a Barriers<'a>,
    question: &'a ToolChange,
    budget: &'a Budget,
    /// Where start and target are clear of barriers.
    clear: [Point; 2],
    /// Of the move to the place and of the move on.
    levels: [Levels; 2],
    /// What the place may lie above.
    left_out: BTreeSet<usize>,
    permitted: Permitted,
    lower_bound: f64,
}

/// The best places in the plane, best first, at the best levels of the moves there and on.
#[derive(Clone, Debug)]
struct Found {
    places: Vec<Met>,
    /// What both cost beside their ways in the plane.
    aside: f64,
    /// What beginning and ending at rest adds at any place.
    rest: f64,
}

impl<'a> Placing<'a> {
    /// Finds where the change is permitted.
    fn new(
        barriers: &'a Barriers<'a>,
        question: &'a ToolChange,
        budget: &'a Budget,
    ) -> Result<Result<Self, Vec<Refusal>>, Interrupt> {
        let heights = question.rules.heights;
        let clear = match clear_ends(barriers, &question.whole(), budget)? {
            Ok(clear) => clear,
            Err(refusals) => return Ok(Err(refusals)),
        };
        let levels = [question.approach_rules(), question.departure_rules()]
            .map(|rules| Levels::of(barriers, rules.heights));
        let left_out = passed_over(barriers, heights, question.change_z_mm().unwrap_or(0.0));
        let highest = levels.each_ref().map(|levels| levels.passed_over(barriers, levels.count() - 1));
        let passed_later = highest[0].union(&highest[1]).filter(|owner| !left_out.contains(owner));
        let passed_later: BTreeSet<usize> = passed_later.copied().collect();
        let places = Places {
            barriers,
            regions: &question.regions,
            points: &question.points,
            ends: clear,
            left_out: &left_out,
            passed_later: &passed_later,
        };
        let permitted = places.permitted(budget)?;
        Ok(Ok(Self { barriers, question, budget, clear, levels, left_out, permitted, lower_bound: 0.0 }))
    }

    fn highest(&self) -> [usize; 2] {
        self.levels.each_ref().map(|levels| levels.count() - 1)
    }

    /// The best place at the best levels.
    fn best(&mut self, stats: &mut Stats, observer: &mut dyn Observer) -> Result<Option<Found>, Interrupt> {
        if self.permitted.spots.is_empty() && self.permitted.parts.is_empty() {
            return Ok(None);
        }
        let [start, target] = self.clear;
        let cost = self.question.rules.cost;
        let lead_mm = [(start - self.question.start).norm(), (target - self.question.target).norm()];
        let leads =
            straight(start - self.question.start, &cost) + straight(target - self.question.target, &cost);
        let vertical = self.levels.each_ref().map(|levels| {
            (0..levels.count()).map(|level| vertical(levels.vertical(level), &cost)).collect::<Vec<f64>>()
        });
        let straight_mm = (target - start).norm();
        let rest = self.least_rest(straight_mm, lead_mm);
        let mut bound = self.lower_bound;
        let tell = |found: f64| {
            if found + leads + rest > bound {
                bound = found + leads + rest;
                observer.better_bound(bound);
            }
        };
        let solve = |pair| {
            let places = self.meet(pair, stats)?;
            Ok(places.first().map(|met| met.lower_bound).map(|least| (of_search(least, &cost), places)))
        };
        let found = best_pair([&vertical[0], &vertical[1]], straight(target - start, &cost), solve, tell);
        self.lower_bound = bound.max(self.lower_bound);
        Ok(found?.map(|(pair, places)| {
            let aside = leads + vertical[0][pair[0]] + vertical[1][pair[1]];
            let is_only_pair = self.highest() == [0, 0];
            let plane_mm = places.first().map_or(0.0, |met| met.lower_bound);
            let rest = if is_only_pair { self.least_rest(plane_mm, lead_mm) } else { rest };
            Found { places, aside, rest }
        }))
    }

    /// What beginning and ending at rest adds to both moves at least, where both are `plane_mm` long in the plane beside
    /// ways out and in: what a move of some length takes grows less and less with the length, so that both together take
    /// least where one is as short as it can be.
    fn least_rest(&self, plane_mm: f64, lead_mm: [f64; 2]) -> f64 {
        let TravelCost::Kinematics(_) = self.question.rules.cost else { return 0.0 };
        let nearest = self.clear.map(|end| {
            let parts = self.permitted.parts.iter().map(|part| part.distance_to_point(end));
            let spots = self.permitted.spots.iter().map(|spot| (spot - end).norm());
            parts.chain(spots).fold(f64::INFINITY, f64::min)
        });
        let rest = |side: usize, mm: f64| {
            at_rest(mm + lead_mm[side], self.levels[side].vertical(0), &self.question.rules.cost)
        };
        let [near_start, near_target] = nearest;
        let by_start = rest(0, near_start) + rest(1, near_target.max(plane_mm - near_start));
        let by_target = rest(0, near_start.max(plane_mm - near_target)) + rest(1, near_target);
        by_start.min(by_target)
    }

    /// How many places are looked at: more than the best one where a place's moves may cost more than is known of it.
    fn place_count(&self) -> usize {
        let rules = &self.question.rules;
        let is_known = !matches!(rules.cost, TravelCost::Kinematics(_)) && rules.dog_leg().is_none();
        if is_known { 1 } else { PLACES }
    }

    /// The best places where both moves travel at these levels, best first.
    fn meet(&mut self, pair: [usize; 2], stats: &mut Stats) -> Result<Vec<Met>, Interrupt> {
        match &self.question.rules.cost {
            TravelCost::AxisSpeeds(speeds) => self.meet_by(AxisTime::new(speeds), pair, stats),
            TravelCost::Length | TravelCost::Kinematics(_) => self.meet_by(Length, pair, stats),
        }
    }

    fn meet_by(
        &mut self,
        measure: impl Measure,
        pair: [usize; 2],
        stats: &mut Stats,
    ) -> Result<Vec<Met>, Interrupt> {
        let left_out = [0, 1].map(|side| self.levels[side].passed_over(self.barriers, pair[side]));
        let start = stand(self.barriers, &left_out[0], self.clear[0], self.budget)?;
        let target = stand(self.barriers, &left_out[1], self.clear[1], self.budget)?;
        if start.places.is_empty() || target.places.is_empty() {
            return Ok(Vec::new());
        }
        let ends = [&start, &target];
        let left_out = [&left_out[0], &left_out[1]];
        let known = self.first_place(measure, ends, left_out, stats)?;
        let Self { barriers, permitted, .. } = &*self;
        let meeting = Meeting { measure, barriers, permitted, ends, left_out, known };
        let mut plane = 0.0;
        let places = meeting.best(self.place_count(), stats, self.budget, &mut plane);
        if self.highest() == [0, 0] {
            let aside: f64 = (0..2).map(|side| self.levels[side].vertical(0)).sum();
            let cost = &self.question.rules.cost;
            self.lower_bound = self.lower_bound.max(of_search(plane, cost) + vertical(aside, cost));
        }
        places
    }

    /// A place that both ends reach, if one of the nearest spots is one: what costs more need not be looked at.
    fn first_place(
        &self,
        measure: impl Measure,
        ends: [&End; 2],
        left_out: [&BTreeSet<usize>; 2],
        stats: &mut Stats,
    ) -> Result<Option<(Point, f64)>, Interrupt> {
        let around = |p: &Point| measure.along(p - ends[0].point) + measure.along(ends[1].point - p);
        let mut spots: Vec<Point> = self.permitted.spots.clone();
        spots.sort_by(|a, b| around(a).total_cmp(&around(b)));
        for at in spots.into_iter().take(FIRST_SPOTS) {
            let mut cost = 0.0;
            let mut is_reached = true;
            for side in 0..2 {
                let spot = stand(self.barriers, left_out[side], at, self.budget)?;
                if ends[side].point == at {
                    continue;
                }
                let known = Known::new(self.barriers, left_out[side]);
                let mut search = Search::by(measure, known, ends[side], &spot);
                match search.run(self.budget, &mut stats.expanded_nodes, &mut Silent)? {
                    Some(route) => cost += route.cost,
                    None => is_reached = false,
                }
            }
            if is_reached {
                return Ok(Some((at, cost)));
            }
        }
        Ok(None)
    }

    /// The best of the places, and both moves.
    fn plan(
        &self,
        found: &Found,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<ToolChangePlan, Vec<Refusal>> {
        let mut best: Option<ToolChangePlan> = None;
        let mut refused = Vec::new();
        for met in &found.places {
            let of_place = of_search(met.cost, &self.question.rules.cost) + found.aside + found.rest;
            if best.as_ref().is_some_and(|best| best.cost <= of_place * (1.0 + ROUNDING_RATIO)) {
                break;
            }
            match self.plan_at(met, found, stats) {
                Ok(plan) if best.as_ref().is_none_or(|best| plan.cost < best.cost) => best = Some(plan),
                Ok(_) => {}
                // At another place there may be room.
                Err(refusals) if refusals == [Refusal::NoRoomForDogLegs] => refused = refusals,
                // The best so far stands.
                Err(_) if best.is_some() => break,
                Err(refusals) => return Err(refusals),
            }
        }
        let Some(plan) = best else { return Err(refused) };
        observer.better_bound(plan.lower_bound);
        observer.better_cost(plan.cost);
        Ok(plan)
    }

    /// Both moves to and from one of the places.
    fn plan_at(&self, met: &Met, found: &Found, stats: &mut Stats) -> Result<ToolChangePlan, Vec<Refusal>> {
        let rules = &self.question.rules;
        let place = met.place;
        let bound = of_search(met.lower_bound, &rules.cost) + found.aside + found.rest;
        let approach = self.planned(&self.question.approach(place), bound, stats)?;
        let departure = self.planned(&self.question.departure(place), bound, stats)?;
        // Chords outside of arcs cost more than these.
        let cost = approach.cost + departure.cost;
        let lower_bound = if matches!(rules.cost, TravelCost::Kinematics(_)) {
            bound_of(cost, bound)
        } else {
            let by_arcs = approach.lower_bound + departure.lower_bound;
            debug_assert!(
                (by_arcs - met.cost - found.aside).abs() <= 1e-9 * by_arcs.max(1.0),
                "{by_arcs} {found:?}"
            );
            // Rounding must not set what is proven and its bound apart.
            let is_proven = met.cost - met.lower_bound <= ROUNDING_RATIO * met.cost;
            if is_proven { by_arcs } else { bound.min(by_arcs) }
        };
        Ok(ToolChangePlan { place, approach, departure, cost, lower_bound })
    }

    fn planned(&self, query: &RapidMove, bound: f64, stats: &mut Stats) -> Result<RapidPlan, Vec<Refusal>> {
        let asked = Asked { barriers: self.barriers, query, is_last: true, budget: self.budget };
        match plan_among(asked, &mut LinksAtLast, stats, &mut Silent) {
            Ok(Answer::Plan(plan)) => Ok(plan),
            Ok(Answer::NoPath(_)) => {
                debug_assert!(false, "a place that was reached is reached: {query:?}");
                Err(vec![Refusal::Interrupted { interrupt: Interrupt::Memory, lower_bound: bound }])
            }
            Err(refusals) => Err(refusals
                .into_iter()
                .map(|refusal| match refusal {
                    Refusal::Interrupted { interrupt, .. } => {
                        Refusal::Interrupted { interrupt, lower_bound: bound }
                    }
                    other => other,
                })
                .collect()),
        }
    }

    /// Ids of the obstacles that keep start or target from every place.
    fn parting(&self, stats: &mut Stats) -> Result<Vec<String>, Interrupt> {
        let owners = if self.permitted.spots.is_empty() {
            let places = Places {
                barriers: self.barriers,
                regions: &self.question.regions,
                points: &self.question.points,
                ends: self.clear,
                left_out: &self.left_out,
                passed_later: &BTreeSet::new(),
            };
            places.covering(self.budget)?
        } else {
            let left_out =
                [0, 1].map(|side| self.levels[side].passed_over(self.barriers, self.highest()[side]));
            parted(self.barriers, &left_out, self.clear, &self.permitted.spots, self.budget, stats)?
        };
        let is_obstacle = |owner: &usize| self.barriers.obstacle(*owner).is_some();
        Ok(owners.into_iter().filter(is_obstacle).map(|owner| self.barriers.id(owner).to_owned()).collect())
    }
}
