//! One rapid move at one clearance: ways out of the barriers, the best level, the best path there, and how the machine runs
//! it.

use crate::barriers::Barriers;
use crate::drive::{DogLegTime, Driver};
use crate::ends::{ClearEnds, clear_ends};
use crate::level::{Levels, best_level};
use crate::measure::{AxisTime, Length, Measure};
use crate::price::{at_rest, bound_of, in_plane, straight, travel_cost, vertical};
use crate::quickest::{Way, quickest};
use crate::rapid_move::least_cost;
use crate::search::{Between, End, Known, Route, Search, locally_shortest};
use crate::separating::separating;
use crate::shortest_route::ShortestRoute;
use crate::standing::stand;
use crate::told::Told;
use crate::trace::{is_same_way, trace};
use crate::{Algorithm, RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{Path, Scene, TravelCost};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

/// What a move comes to at one clearance.
pub(crate) enum Outcome {
    /// The best path.
    Plan(RapidPlan),
    /// None: these obstacles part start from target. Not worked out unless asked for.
    Parted(Vec<String>),
    /// An end lies inside a barrier.
    Refused(Vec<Refusal>),
    /// There is a path, and none with room for dog-legs was found.
    NoRoom,
}

/// A move in a scene, ready to be planned.
pub(crate) struct AtClearance<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) query: &'a RapidMove,
    pub(crate) budget: &'a Budget,
    pub(crate) barriers: &'a Barriers<'a>,
    shortest: &'a mut dyn ShortestRoute,
    levels: Levels,
    lower_bound: f64,
}

/// A shortest path in the plane, and what bends it.
pub(crate) struct Found {
    /// As the route has it, arcs as arcs.
    pub(crate) path: Path,
    /// None: there is nothing to run.
    pub(crate) route: Option<Route>,
}

/// A path as the machine runs it.
struct AsRun {
    level: usize,
    path: Path,
    /// What it was made of.
    found: Found,
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

    /// The best path. `names_what_parts`: if there is none, say which obstacles do it.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn solve(
        &mut self,
        names_what_parts: bool,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, Interrupt> {
        let ends = match clear_ends(self.barriers, self.query, self.budget)? {
            Ok(clear) => clear,
            Err(refusals) => return Ok(Outcome::Refused(refusals)),
        };
        let heights = self.query.rules.heights;
        let ends_meet = heights.is_none_or(|rule| rule.start_z_mm == rule.target_z_mm);
        if self.query.start == self.query.target && ends_meet {
            let stays =
                Path { start_z_mm: heights.map(|rule| rule.start_z_mm), ..Path::at(self.query.start) };
            return Ok(Outcome::Plan(self.plan(stays, 0.0, Vec::new())));
        }
        let Some((level, found)) = self.best(ends, stats, observer)? else {
            let highest = self.levels.count() - 1;
            let parting = if names_what_parts { self.parting(highest, ends, stats)? } else { Vec::new() };
            return Ok(Outcome::Parted(parting));
        };
        let told = self.lower_bound;
        let bound = self.bound(ends, level, &found);
        self.lower_bound = told.max(bound);
        let Some(mut run) = self.as_run(ends, level, found, stats)? else { return Ok(Outcome::NoRoom) };
        let mut others = Vec::new();
        if self.query.rules.alternative_count > 0 && self.query.algorithm == Algorithm::Exact {
            others = self.alternatives(ends, &run, stats);
        }
        let by_cost = |a: &AsRun, b: &AsRun| self.cost(&a.path).total_cmp(&self.cost(&b.path));
        // What costs the same but for rounding was found in any order.
        others.sort_by(by_cost);
        if let TravelCost::Kinematics(_) = self.query.rules.cost {
            // Which way is the quickest one is not known before it is priced.
            others.push(run);
            others.sort_by(by_cost);
            run = others.remove(0);
        }
        let bending = run.found.route.as_ref().map_or_else(Vec::new, |route| self.bending(route));
        let mut plan = self.plan(run.path, bound, bending);
        plan.alternatives = others.into_iter().map(|other| other.path).collect();
        plan.alternative_costs = plan.alternatives.iter().map(|path| self.cost(path)).collect();
        // Rounding must not set the proven cost and the bounds that were told apart.
        let proven = plan.lower_bound.max(told);
        if proven > told {
            observer.better_bound(proven);
        }
        observer.better_cost(plan.cost.max(proven));
        Ok(Outcome::Plan(plan))
    }

    fn cost(&self, path: &Path) -> f64 {
        travel_cost(path, &self.query.rules.cost)
    }

    /// Other locally shortest ways than `plan`, at its level, as the machine runs them; those without room for dog-legs are
    /// left out. The budget's end leaves those that were found.
    fn alternatives(&self, ends: ClearEnds, plan: &AsRun, stats: &mut Stats) -> Vec<AsRun> {
        let count = self.query.rules.alternative_count;
        let level = plan.level;
        let left_out = self.levels.passed_over(self.barriers, level);
        if ends[0] == ends[1] {
            return Vec::new();
        }
        let Ok([start, target]) = self.stands(&left_out, ends) else { return Vec::new() };
        let (barriers, stands) = (self.barriers, [&start, &target]);
        let driver = self.driver(&left_out);
        // One among them is the plan.
        let routes = match &self.query.rules.cost {
            TravelCost::AxisSpeeds(speeds) => {
                let measure = AxisTime::new(speeds);
                let dog_legs = self.query.rules.dog_leg();
                let by_dog_legs =
                    dog_legs.as_ref().map(|speeds| DogLegTime { time: measure, speeds, driver: &driver });
                let has_room = |from, to| by_dog_legs.is_none_or(|by| by.cramped_by(from, to).is_none());
                let has_room = &has_room;
                let asked = Between { measure, barriers, left_out: &left_out, ends: stands, has_room };
                locally_shortest(&asked, count + 1, stats, self.budget)
            }
            TravelCost::Length | TravelCost::Kinematics(_) => {
                let (measure, has_room) = (Length, &|_, _| true);
                let asked = Between { measure, barriers, left_out: &left_out, ends: stands, has_room };
                locally_shortest(&asked, count + 1, stats, self.budget)
            }
        };
        let mut ways: Vec<Found> = Vec::new();
        for route in routes {
            let way = found_along(route, ends);
            let is_same = |known: &Path| is_same_way(known, &way.path);
            if !is_same(&plan.found.path) && !ways.iter().any(|known| is_same(&known.path)) {
                ways.push(way);
            }
        }
        let run = |found: Found| {
            Some(self.driven(ends, level, &found).ok()?.map(|path| AsRun { level, path, found }))
        };
        ways.into_iter().take(count).map_while(run).flatten().collect()
    }

    /// Whether there is a path at all: what is clear at any level is clear at the highest.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn has_path(&mut self, stats: &mut Stats) -> Result<bool, Interrupt> {
        let Ok(ends) = clear_ends(self.barriers, self.query, self.budget)? else { return Ok(false) };
        let highest = self.levels.count() - 1;
        Ok(self.search(highest, ends, stats, &mut Silent)?.is_some())
    }

    /// The level at which the way costs least but for what corners and axes add, and that way.
    fn best(
        &mut self,
        ends: ClearEnds,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<Option<(usize, Found)>, Interrupt> {
        let cost = self.query.rules.cost;
        let leads = self.leads(ends);
        let rest = self.least_rest();
        let verticals: Vec<f64> =
            (0..self.levels.count()).map(|level| vertical(self.levels.vertical(level), &cost)).collect();
        if let [vertical] = verticals[..] {
            let mut told = Told { observer, cost, by: leads + vertical + rest, most: self.lower_bound };
            let found = self.search(0, ends, stats, &mut told);
            self.lower_bound = told.most;
            return Ok(found?.map(|found| (0, found)));
        }
        let mut bound = self.lower_bound;
        let solve = |level| {
            let found = self.search(level, ends, stats, &mut Silent)?;
            Ok(found.map(|found| (in_plane(&found.path, &cost), found)))
        };
        let tell = |found: f64| {
            if found + leads + rest > bound {
                bound = found + leads + rest;
                observer.better_bound(bound);
            }
        };
        let found = best_level(&verticals, straight(ends[1] - ends[0], &cost), solve, tell);
        self.lower_bound = bound;
        found
    }

    /// What ways out and in cost.
    fn leads(&self, [start, target]: ClearEnds) -> f64 {
        let cost = &self.query.rules.cost;
        straight(start - self.query.start, cost) + straight(target - self.query.target, cost)
    }

    /// What beginning and ending at rest adds at any level.
    fn least_rest(&self) -> f64 {
        let lowest = self.levels.vertical(0);
        at_rest((self.query.target - self.query.start).norm(), lowest, &self.query.rules.cost)
    }

    /// No path costs less, where `found` is the way that costs least at the best level but for what corners and axes
    /// add.
    fn bound(&self, ends: ClearEnds, level: usize, found: &Found) -> f64 {
        let cost = &self.query.rules.cost;
        let path = self.whole(level, ends, &found.path);
        match cost {
            TravelCost::Length | TravelCost::AxisSpeeds(_) => travel_cost(&path, cost),
            TravelCost::Kinematics(_) => {
                let rise = self.levels.vertical(level);
                let rest = if self.levels.count() == 1 {
                    at_rest(path.length() - rise, rise, cost)
                } else {
                    self.least_rest()
                };
                in_plane(&path, cost) + vertical(rise, cost) + rest
            }
        }
    }

    /// The path as the machine runs it; by limits of speed and acceleration the best of several. None: no room for
    /// dog-legs.
    fn as_run(
        &self,
        ends: ClearEnds,
        level: usize,
        found: Found,
        stats: &mut Stats,
    ) -> Result<Option<AsRun>, Interrupt> {
        let Some(path) = self.driven(ends, level, &found)? else { return self.with_room(ends, stats) };
        let TravelCost::Kinematics(_) = self.query.rules.cost else {
            return Ok(Some(AsRun { level, path, found }));
        };
        let first = Way::new(self, level, Vec::new(), path, found);
        let Way { level, path, found, .. } = quickest(self, ends, self.levels.count(), first, stats);
        Ok(Some(AsRun { level, path, found }))
    }

    /// The whole path as the machine runs it. None: no room for dog-legs.
    pub(crate) fn driven(
        &self,
        ends: ClearEnds,
        level: usize,
        found: &Found,
    ) -> Result<Option<Path>, Interrupt> {
        let left_out = self.levels.passed_over(self.barriers, level);
        let driver = self.driver(&left_out);
        let Some(route) = found.route.as_ref().filter(|_| !driver.is_plain()) else {
            return Ok(Some(self.whole(level, ends, &found.path)));
        };
        let along = driver.drive(route, ends[0], ends[1])?;
        Ok(along.map(|along| self.whole(level, ends, &along)))
    }

    fn driver<'b>(&'b self, left_out: &'b BTreeSet<usize>) -> Driver<'b> {
        let rules = &self.query.rules;
        let axes = match &rules.cost {
            TravelCost::AxisSpeeds(speeds) => Some(AxisTime::new(speeds)),
            _ => None,
        };
        let (arcs, dog_leg) = (rules.arcs, rules.dog_leg());
        Driver { barriers: self.barriers, left_out, arcs, dog_leg, axes, budget: self.budget }
    }

    /// The best path among those whose straight moves all have room for dog-legs.
    fn with_room(&self, ends: ClearEnds, stats: &mut Stats) -> Result<Option<AsRun>, Interrupt> {
        let Some(speeds) = self.query.rules.dog_leg() else { return Ok(None) };
        let cost = self.query.rules.cost;
        let verticals: Vec<f64> =
            (0..self.levels.count()).map(|level| vertical(self.levels.vertical(level), &cost)).collect();
        let solve = |level| {
            let left_out = self.levels.passed_over(self.barriers, level);
            let driver = self.driver(&left_out);
            let measure = DogLegTime { time: AxisTime::new(&speeds), speeds: &speeds, driver: &driver };
            let found = self.search_by(measure, level, ends, stats)?;
            let Some(path) =
                found.as_ref().map(|found| self.driven(ends, level, found)).transpose()?.flatten()
            else {
                return Ok(None);
            };
            Ok(found.map(|found| (in_plane(&found.path, &cost), (path, found))))
        };
        let found = best_level(&verticals, straight(ends[1] - ends[0], &cost), solve, |_| {})?;
        Ok(found.map(|(level, (path, found))| AsRun { level, path, found }))
    }

    fn plan(&self, path: Path, bound: f64, bending_obstacles: Vec<String>) -> RapidPlan {
        let rules = &self.query.rules;
        let cost = travel_cost(&path, &rules.cost);
        RapidPlan {
            path,
            cost,
            cost_unit: rules.cost.unit(),
            lower_bound: bound_of(cost, bound),
            clearance_mm: self.scene.clearance_mm,
            bending_obstacles,
            alternatives: Vec::new(),
            alternative_costs: Vec::new(),
        }
    }

    /// The way in the plane at a level that costs least but for what corners and axes add.
    fn search(
        &mut self,
        level: usize,
        ends: ClearEnds,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<Option<Found>, Interrupt> {
        match &self.query.rules.cost {
            TravelCost::Length => {}
            TravelCost::AxisSpeeds(speeds) => {
                return self.search_by_told(AxisTime::new(speeds), level, ends, stats, observer);
            }
            TravelCost::Kinematics(_) => return self.search_by_told(Length, level, ends, stats, observer),
        }
        let [start, target] = ends;
        if start == target {
            return Ok(Some(Found { path: Path::at(start), route: None }));
        }
        let left_out = self.levels.passed_over(self.barriers, level);
        let [start, target] = self.stands(&left_out, ends)?;
        if start.places.is_empty() || target.places.is_empty() {
            return Ok(None);
        }
        let stands = [&start, &target];
        let (found, lower_bound) =
            self.shortest.shortest(self.barriers, &left_out, stands, stats, self.budget, observer);
        observer.better_bound(lower_bound);
        Ok(found?.map(|route| {
            let cost = route.cost;
            let found = found_along(route, ends);
            debug_assert!((found.path.length() - cost).abs() <= 1e-6 * cost.max(1.0));
            found
        }))
    }

    /// The way in the plane at a level that costs least by another measure.
    pub(crate) fn search_by(
        &self,
        measure: impl Measure,
        level: usize,
        ends: ClearEnds,
        stats: &mut Stats,
    ) -> Result<Option<Found>, Interrupt> {
        self.search_by_told(measure, level, ends, stats, &mut Silent)
    }

    fn search_by_told(
        &self,
        measure: impl Measure,
        level: usize,
        ends: ClearEnds,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> Result<Option<Found>, Interrupt> {
        let [start, target] = ends;
        if start == target {
            return Ok(Some(Found { path: Path::at(start), route: None }));
        }
        let left_out = self.levels.passed_over(self.barriers, level);
        let [start, target] = self.stands(&left_out, ends)?;
        if start.places.is_empty() || target.places.is_empty() {
            return Ok(None);
        }
        let known = Known::new(self.barriers, &left_out);
        let mut search = Search::by(measure, known, &start, &target);
        let found = search.run(self.budget, &mut stats.expanded_nodes, observer);
        stats.barrier_vertices = stats.barrier_vertices.max(search.known.features.len() as u64);
        observer.better_bound(search.lower_bound);
        Ok(found?.map(|route| found_along(route, ends)))
    }

    fn stands(&self, left_out: &BTreeSet<usize>, [start, target]: ClearEnds) -> Result<[End; 2], Interrupt> {
        Ok([
            stand(self.barriers, left_out, start, self.budget)?,
            stand(self.barriers, left_out, target, self.budget)?,
        ])
    }

    /// Ids of the obstacles that part start from target at a level without a path.
    fn parting(&self, level: usize, ends: ClearEnds, stats: &mut Stats) -> Result<Vec<String>, Interrupt> {
        let left_out = self.levels.passed_over(self.barriers, level);
        let [start, target] = self.stands(&left_out, ends)?;
        for end in [&start, &target] {
            if end.places.is_empty() {
                return Ok(self.named(end.shut_in_by.iter().copied()));
            }
        }
        let parting = separating(self.barriers, &left_out, &start, &target, self.budget, stats)?;
        Ok(self.named(parting))
    }

    /// The whole path: out, up, along, down, in.
    fn whole(&self, level: usize, [clear_start, _]: ClearEnds, along: &Path) -> Path {
        debug_assert_eq!(along.start, clear_start, "a way begins where it is clear");
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

fn found_along(route: Route, [start, target]: ClearEnds) -> Found {
    Found { path: trace(&route, start, target), route: Some(route) }
}
