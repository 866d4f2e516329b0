//! The best place for a tool change, exactly: from a scene, two ends, regions and points to a place and two moves.
//!
//! Clearances are tried in turn. At each the ends' ways out of the barriers are found, then where the change is permitted,
//! then the best pair of levels; at each pair that matters two fans meet in the best place of the plane. The moves there and
//! on are planned as any rapid moves.

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
use crate::rapid_move::{Asked, plan_among};
use crate::search::End;
use crate::shortest_route::{MeetingBarriers, ShortestRoute};
use crate::standing::stand;
use crate::{Answer, FeasibleClearance, NoPath, RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{Point, Scene};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

/// Sums of the same lengths differ by less than this share of them: rounding.
const ROUNDING_RATIO: f64 = 1e-12;

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
        Some(met) => {
            let plan = placing.plan(met, stats, observer)?;
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
    Ok(placing.meet(highest, stats)?.is_some())
}

/// No tool change costs less, whatever is in the way.
fn least_cost(question: &ToolChange) -> f64 {
    let rise = question.rules.heights.zip(question.change_z_mm());
    let vertical = rise.map_or(0.0, |(rule, z)| (z - rule.start_z_mm).abs() + (z - rule.target_z_mm).abs());
    (question.target - question.start).norm() + vertical
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

/// A place, and the levels at which the moves there and on travel.
#[derive(Clone, Copy, Debug)]
struct Found {
    met: Met,
    /// What both cost beside their ways in the plane.
    aside: f64,
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
        let leads = (start - self.question.start).norm() + (target - self.question.target).norm();
        let vertical = self
            .levels
            .each_ref()
            .map(|levels| (0..levels.count()).map(|level| levels.vertical(level)).collect::<Vec<f64>>());
        let straight = (target - start).norm();
        let mut bound = self.lower_bound;
        let tell = |found: f64| {
            if found + leads > bound {
                bound = found + leads;
                observer.better_bound(bound);
            }
        };
        let solve = |pair| Ok(self.meet(pair, stats)?.map(|met| (met.lower_bound, met)));
        let found = best_pair([&vertical[0], &vertical[1]], straight, solve, tell);
        self.lower_bound = bound;
        Ok(found?.map(|(pair, met)| {
            let aside = leads + vertical[0][pair[0]] + vertical[1][pair[1]];
            Found { met, aside }
        }))
    }

    /// The best place where both moves travel at these levels.
    fn meet(&mut self, pair: [usize; 2], stats: &mut Stats) -> Result<Option<Met>, Interrupt> {
        let left_out = [0, 1].map(|side| self.levels[side].passed_over(self.barriers, pair[side]));
        let start = stand(self.barriers, &left_out[0], self.clear[0], self.budget)?;
        let target = stand(self.barriers, &left_out[1], self.clear[1], self.budget)?;
        if start.places.is_empty() || target.places.is_empty() {
            return Ok(None);
        }
        let ends = [&start, &target];
        let left_out = [&left_out[0], &left_out[1]];
        let known = self.first_place(ends, left_out, stats)?;
        let meeting = Meeting { barriers: self.barriers, permitted: &self.permitted, ends, left_out, known };
        let mut plane = 0.0;
        let met = meeting.best(stats, self.budget, &mut plane);
        if self.highest() == [0, 0] {
            let aside: f64 = (0..2).map(|side| self.levels[side].vertical(0)).sum();
            self.lower_bound = self.lower_bound.max(plane + aside);
        }
        met
    }

    /// A place that both ends reach, if one of the nearest spots is one: what costs more need not be looked at.
    fn first_place(
        &self,
        ends: [&End; 2],
        left_out: [&BTreeSet<usize>; 2],
        stats: &mut Stats,
    ) -> Result<Option<(Point, f64)>, Interrupt> {
        let around = |p: &Point| (p - ends[0].point).norm() + (ends[1].point - p).norm();
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
                let (found, _) = MeetingBarriers.shortest(
                    self.barriers,
                    left_out[side],
                    [ends[side], &spot],
                    stats,
                    self.budget,
                    &mut Silent,
                );
                match found? {
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

    /// Both moves.
    fn plan(
        &self,
        found: Found,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<ToolChangePlan, Vec<Refusal>> {
        let place = found.met.place;
        let bound = found.met.lower_bound + found.aside;
        let approach = self.planned(&self.question.approach(place), bound, stats)?;
        let departure = self.planned(&self.question.departure(place), bound, stats)?;
        // Chords outside of arcs cost more than these.
        let cost = approach.cost + departure.cost;
        let by_arcs = approach.lower_bound + departure.lower_bound;
        debug_assert!(
            (by_arcs - found.met.cost - found.aside).abs() <= 1e-9 * by_arcs.max(1.0),
            "{by_arcs} {found:?}"
        );
        // Rounding must not set what is proven and its bound apart.
        let is_proven = found.met.cost - found.met.lower_bound <= ROUNDING_RATIO * found.met.cost;
        let lower_bound = if is_proven { by_arcs } else { bound.min(by_arcs) };
        observer.better_bound(lower_bound);
        observer.better_cost(cost);
        Ok(ToolChangePlan { place, approach, departure, cost, lower_bound })
    }

    fn planned(&self, query: &RapidMove, bound: f64, stats: &mut Stats) -> Result<RapidPlan, Vec<Refusal>> {
        let asked = Asked { barriers: self.barriers, query, is_last: true, budget: self.budget };
        match plan_among(asked, &mut MeetingBarriers, stats, &mut Silent) {
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
