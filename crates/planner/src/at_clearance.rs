//! One rapid move at one clearance: ways out of the barriers, the best level, the shortest path there.

use crate::barriers::Barriers;
use crate::clear_end::{EndPlace, clear_end};
use crate::level::{Levels, best_level};
use crate::rapid_move::least_cost;
use crate::search::{End, Route};
use crate::separating::separating;
use crate::shortest_route::ShortestRoute;
use crate::standing::stand;
use crate::trace::trace;
use crate::{RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{EndRule, Path, Point, Scene};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

/// What a move comes to at one clearance.
pub(crate) enum Outcome {
    /// The shortest path.
    Plan(RapidPlan),
    /// None: these obstacles part start from target. Not worked out unless asked for.
    Parted(Vec<String>),
    /// An end lies inside a barrier.
    Refused(Vec<Refusal>),
}

/// A move in a scene, ready to be planned.
pub(crate) struct AtClearance<'a> {
    scene: &'a Scene,
    query: &'a RapidMove,
    budget: &'a Budget,
    barriers: &'a Barriers<'a>,
    shortest: &'a mut dyn ShortestRoute,
    levels: Levels,
    lower_bound: f64,
}

/// A shortest path in the plane, and what bends it.
struct Found {
    path: Path,
    bending: Vec<String>,
}

impl<'a> AtClearance<'a> {
    /// A move among barriers that were taken apart.
    pub(crate) fn new(
        barriers: &'a Barriers<'a>,
        query: &'a RapidMove,
        budget: &'a Budget,
        shortest: &'a mut dyn ShortestRoute,
    ) -> Self {
        let levels = Levels::of(barriers, query.rules.heights);
        let lower_bound = least_cost(query);
        Self { scene: barriers.scene, query, budget, barriers, shortest, levels, lower_bound }
    }

    /// No path costs less, as far as is known.
    pub(crate) fn lower_bound(&self) -> f64 {
        self.lower_bound
    }

    /// The shortest path. `names_what_parts`: if there is none, say which obstacles do it.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn solve(
        &mut self,
        names_what_parts: bool,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, Interrupt> {
        let [start, target] = match self.clear_ends()? {
            Ok(clear) => clear,
            Err(refusals) => return Ok(Outcome::Refused(refusals)),
        };
        let heights = self.query.rules.heights;
        let ends_meet = heights.is_none_or(|rule| rule.start_z_mm == rule.target_z_mm);
        if self.query.start == self.query.target && ends_meet {
            let stays =
                Path { start_z_mm: heights.map(|rule| rule.start_z_mm), ..Path::at(self.query.start) };
            return Ok(Outcome::Plan(self.plan(stays, Vec::new())));
        }
        let leads = (start - self.query.start).norm() + (target - self.query.target).norm();
        let vertical: Vec<f64> = (0..self.levels.count()).map(|i| self.levels.vertical(i)).collect();
        let straight = (target - start).norm();
        let found = if let [vertical] = vertical[..] {
            let mut told = Told { observer, by: leads + vertical, most: self.lower_bound };
            let found = self.search(0, start, target, stats, &mut told);
            self.lower_bound = told.most;
            found?.map(|(_, found)| (0, found))
        } else {
            let mut bound = self.lower_bound;
            let solve = |level| self.search(level, start, target, stats, &mut Silent);
            let tell = |found: f64| {
                if found + leads > bound {
                    bound = found + leads;
                    observer.better_bound(bound);
                }
            };
            let found = best_level(&vertical, straight, solve, tell);
            self.lower_bound = bound;
            found?
        };
        let Some((level, Found { path, bending })) = found else {
            let highest = self.levels.count() - 1;
            let parting =
                if names_what_parts { self.parting(highest, start, target, stats)? } else { Vec::new() };
            return Ok(Outcome::Parted(parting));
        };
        let plan = self.plan(self.whole(level, &path), bending);
        // Rounding must not set the proven cost and the bounds that were told apart.
        let proven = plan.cost.max(self.lower_bound);
        if proven > self.lower_bound {
            observer.better_bound(proven);
        }
        observer.better_cost(proven);
        Ok(Outcome::Plan(plan))
    }

    /// Whether there is a path at all: what is clear at any level is clear at the highest.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn has_path(&mut self, stats: &mut Stats) -> Result<bool, Interrupt> {
        let Ok([start, target]) = self.clear_ends()? else { return Ok(false) };
        let highest = self.levels.count() - 1;
        Ok(self.search(highest, start, target, stats, &mut Silent)?.is_some())
    }

    fn plan(&self, path: Path, bending_obstacles: Vec<String>) -> RapidPlan {
        let cost = path.length();
        RapidPlan {
            path,
            cost,
            lower_bound: cost,
            clearance_mm: self.scene.clearance_mm,
            bending_obstacles,
            alternatives: Vec::new(),
        }
    }

    /// Where start and target are clear of every barrier at their own heights: themselves, or where their ways out
    /// end.
    fn clear_ends(&self) -> Result<Result<[Point; 2], Vec<Refusal>>, Interrupt> {
        let RapidMove { start, target, rules, .. } = self.query;
        let heights = rules.heights;
        let start_z = heights.map_or(0.0, |rule| rule.start_z_mm);
        let target_z = heights.map_or(0.0, |rule| rule.target_z_mm);
        let start = self.clear_end("start", *start, start_z, &rules.leave)?;
        let target = self.clear_end("target", *target, target_z, &rules.enter)?;
        Ok(match (start, target) {
            (Ok(start), Ok(target)) => Ok([start, target]),
            (start, target) => Err([start.err(), target.err()].into_iter().flatten().flatten().collect()),
        })
    }

    fn clear_end(
        &self,
        field: &'static str,
        point: Point,
        z_mm: f64,
        rule: &EndRule,
    ) -> Result<Result<Point, Vec<Refusal>>, Interrupt> {
        let end = EndPlace { field, point, z_mm };
        clear_end(self.barriers, self.query.rules.heights, end, rule, self.budget)
    }

    /// The shortest path in the plane at a level: its length, and it.
    fn search(
        &mut self,
        level: usize,
        start: Point,
        target: Point,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<Option<(f64, Found)>, Interrupt> {
        if start == target {
            return Ok(Some((0.0, Found { path: Path::at(start), bending: Vec::new() })));
        }
        let left_out = self.levels.passed_over(self.barriers, level);
        let [start, target] = self.stands(&left_out, start, target)?;
        if start.places.is_empty() || target.places.is_empty() {
            return Ok(None);
        }
        let ends = [&start, &target];
        let (found, lower_bound) =
            self.shortest.shortest(self.barriers, &left_out, ends, stats, self.budget, observer);
        observer.better_bound(lower_bound);
        Ok(found?.map(|route| {
            let path = trace(&route, start.point, target.point);
            debug_assert!((path.length() - route.cost).abs() <= 1e-6 * route.cost.max(1.0));
            (path.length(), Found { path, bending: self.bending(&route) })
        }))
    }

    fn stands(&self, left_out: &BTreeSet<usize>, start: Point, target: Point) -> Result<[End; 2], Interrupt> {
        Ok([
            stand(self.barriers, left_out, start, self.budget)?,
            stand(self.barriers, left_out, target, self.budget)?,
        ])
    }

    /// Ids of the obstacles that part start from target at a level without a path.
    fn parting(
        &self,
        level: usize,
        start: Point,
        target: Point,
        stats: &mut Stats,
    ) -> Result<Vec<String>, Interrupt> {
        let left_out = self.levels.passed_over(self.barriers, level);
        let [start, target] = self.stands(&left_out, start, target)?;
        for end in [&start, &target] {
            if end.places.is_empty() {
                return Ok(self.named(end.shut_in_by.iter().copied()));
            }
        }
        let parting = separating(self.barriers, &left_out, &start, &target, self.budget, stats)?;
        Ok(self.named(parting))
    }

    /// The whole path: out, up, along, down, in.
    fn whole(&self, level: usize, along: &Path) -> Path {
        let RapidMove { start, target, rules, .. } = self.query;
        let mut path = match rules.heights {
            Some(rule) => Path::at_height(*start, rule.start_z_mm),
            None => Path::at(*start),
        };
        path.line_to(along.start);
        match self.levels.z_mm(level) {
            Some(z) => {
                path.height_to(z);
                path.append(&along.clone().at_level(z));
            }
            None => path.append(along),
        }
        if let Some(rule) = rules.heights {
            path.height_to(rule.target_z_mm);
        }
        path.line_to(*target);
        path
    }

    /// Ids of obstacles; the work area's border is taken for granted.
    fn named(&self, owners: impl IntoIterator<Item = usize>) -> Vec<String> {
        let is_obstacle = |owner: &usize| self.barriers.obstacle(*owner).is_some();
        owners.into_iter().filter(is_obstacle).map(|owner| self.barriers.id(owner).to_owned()).collect()
    }

    fn bending(&self, route: &Route) -> Vec<String> {
        let mut ids: Vec<String> =
            route.stops.iter().map(|stop| self.barriers.id(stop.circle.owner).to_owned()).collect();
        ids.dedup();
        ids
    }
}

/// Hears a search's bounds and passes them on as the whole move's.
struct Told<'a> {
    observer: &'a mut dyn Observer,
    /// What the whole costs beside the search's part.
    by: f64,
    /// The best bound so far.
    most: f64,
}

impl Observer for Told<'_> {
    fn better_cost(&mut self, _cost: f64) {}

    fn better_bound(&mut self, lower_bound: f64) {
        let bound = lower_bound + self.by;
        if bound > self.most {
            self.most = bound;
            self.observer.better_bound(bound);
        }
    }
}
