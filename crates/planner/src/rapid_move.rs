//! The shortest rapid move, exactly: from a scene, two ends and rules to a plan, or the proof that there is none.
//!
//! Clearances are tried in turn; at each the ends' ways out of the barriers are found, then the best level, and at each
//! level that matters the shortest path in the plane.
//!
//! Cost: a search among the barriers that it meets for each clearance and level; building the obstruction of the whole
//! scene is n log n, once for each clearance.

use crate::at_clearance::{AtClearance, Outcome};
use crate::barriers::Barriers;
use crate::feasible::feasible_clearance;
use crate::lowered::{present, with_clearance};
use crate::search::{End, Known, Route, Search};
use crate::supporting_lines::Scan;
use crate::{Algorithm, Answer, FeasibleClearance, NoPath, RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{EndRule, Path, Scene};
use traverse_solve::{Budget, Interrupt, Observer};

/// Plans one rapid move in a valid scene, by rules without findings.
///
/// # Errors
/// See [`Refusal`]; every end that lies inside a barrier is named, one refusal each. With several clearances the ends are
/// those of the smallest.
pub fn plan_rapid_move(
    scene: &Scene,
    query: &RapidMove,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<(Answer, Stats), Vec<Refusal>> {
    let Some((&smallest, larger)) = query.rules.clearances_mm.split_last() else {
        let barriers = apart(scene, query, budget)?;
        return plan_among(&barriers, query, budget, observer, &mut MeetingBarriers::default());
    };
    let mut stats = Stats::default();
    for &clearance in larger {
        let scene = with_clearance(scene, clearance);
        let barriers = apart(&scene, query, budget)?;
        let asked = Asked { query, is_last: false, budget };
        match asked.plan(&barriers, &mut stats, observer, &mut MeetingBarriers::default()) {
            Ok(Answer::NoPath(_)) => {}
            Err(refusals) if refusals.iter().all(Refusal::is_about_an_end) => {}
            result => return result.map(|answer| (answer, stats)),
        }
    }
    let scene = with_clearance(scene, smallest);
    let barriers = apart(&scene, query, budget)?;
    let asked = Asked { query, is_last: true, budget };
    let answer = asked.plan(&barriers, &mut stats, observer, &mut MeetingBarriers::default())?;
    Ok((answer, stats))
}

/// How the shortest route between two ends is found.
pub(crate) trait ShortestRoute {
    /// The shortest route, if there is any, and a cost that no route is below.
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        ends: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64);
}

/// By a search that meets barriers as it goes.
#[derive(Default)]
pub(crate) struct MeetingBarriers {
    /// Owners of barriers that are not in the way.
    pub(crate) passed_over: BTreeSet<usize>,
}

impl ShortestRoute for MeetingBarriers {
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        [start, target]: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64) {
        let mut search = Search::new(Known::new(barriers, &self.passed_over), start, target);
        let found = search.run(budget, &mut stats.expanded_nodes, observer);
        stats.barrier_vertices = stats.barrier_vertices.max(search.known.features.len() as u64);
        (found, search.lower_bound)
    }
}

/// Plans one rapid move among barriers that were taken apart. `shortest` finds ways among all of them; a list of
/// clearances is planned with afresh.
///
/// # Errors
/// As [`plan_rapid_move`].
pub(crate) fn plan_among(
    barriers: &Barriers<'_>,
    query: &RapidMove,
    budget: &Budget,
    observer: &mut dyn Observer,
    shortest: &mut dyn ShortestRoute,
) -> Result<(Answer, Stats), Vec<Refusal>> {
    if !query.rules.clearances_mm.is_empty() {
        return plan_rapid_move(&present(barriers), query, budget, observer);
    }
    let mut stats = Stats::default();
    let answer = Asked { query, is_last: true, budget }.plan(barriers, &mut stats, observer, shortest)?;
    Ok((answer, stats))
}

fn apart<'a>(scene: &'a Scene, query: &RapidMove, budget: &Budget) -> Result<Barriers<'a>, Vec<Refusal>> {
    let lower_bound = least_cost(query);
    Barriers::new(scene, budget).map_err(|interrupt| vec![Refusal::Interrupted { interrupt, lower_bound }])
}

/// A move at one clearance.
#[derive(Clone, Copy)]
struct Asked<'a> {
    query: &'a RapidMove,
    /// No smaller clearance is tried after it.
    is_last: bool,
    budget: &'a Budget,
}

impl Asked<'_> {
    fn plan(
        &self,
        barriers: &Barriers<'_>,
        stats: &mut Stats,
        observer: &mut dyn Observer,
        shortest: &mut dyn ShortestRoute,
    ) -> Result<Answer, Vec<Refusal>> {
        let Self { query, is_last, budget } = *self;
        let interrupted = |bound: f64| {
            // A smaller clearance may have a shorter path.
            let lower_bound = if is_last { bound } else { least_cost(query) };
            move |interrupt: Interrupt| vec![Refusal::Interrupted { interrupt, lower_bound }]
        };
        let scan = match query.algorithm {
            Algorithm::Exact => None,
            Algorithm::SupportingLines => {
                Some(published_scan(barriers.scene, query).map_err(|refusal| vec![refusal])?)
            }
        };
        let mut solver = AtClearance::new(barriers, query, budget);
        let outcome = solver.solve(is_last, shortest, stats, observer);
        let bound = solver.lower_bound();
        let exact = match outcome.map_err(interrupted(bound))? {
            Outcome::Plan(plan) => plan,
            Outcome::Refused(refusals) => return Err(refusals),
            Outcome::Parted(separating_obstacles) => {
                let feasible_clearance = if is_last {
                    feasible_clearance(&present(barriers), query, budget, stats)
                } else {
                    FeasibleClearance::Unknown
                };
                return Ok(Answer::NoPath(NoPath { separating_obstacles, feasible_clearance }));
            }
        };
        let Some(scan) = scan else { return Ok(Answer::Plan(exact)) };
        let see_each_other = exact.path.steps.len() <= 1;
        let candidates = scan.candidates(see_each_other, budget).map_err(interrupted(exact.cost))?;
        Ok(Answer::Plan(published(candidates, exact)?))
    }
}

/// No path costs less, whatever is in the way.
pub(crate) fn least_cost(query: &RapidMove) -> f64 {
    let rise = query.rules.heights.map_or(0.0, |rule| (rule.target_z_mm - rule.start_z_mm).abs());
    (query.target - query.start).norm() + rise
}

fn published_scan(scene: &Scene, query: &RapidMove) -> Result<Scan, Refusal> {
    let not_applicable = |why| Err(Refusal::PublishedMethodNotApplicable { why });
    if query.rules.heights.is_some() {
        return not_applicable("it knows no heights");
    }
    if query.rules.leave != EndRule::Refuse || query.rules.enter != EndRule::Refuse {
        return not_applicable("it knows no rule for ends inside a barrier");
    }
    Scan::of(scene, query.start, query.target)
}

/// The published plan: its best candidate, bounded by the exact optimum.
fn published(candidates: Vec<Path>, exact: RapidPlan) -> Result<RapidPlan, Vec<Refusal>> {
    let Some(path) = candidates.first().cloned() else {
        let why = "the barrier has no supporting line through start or target";
        return Err(vec![Refusal::PublishedMethodNotApplicable { why }]);
    };
    let cost = path.length();
    // Both are sums of the same lengths when the scan finds the optimum; rounding must not set them apart.
    let lower_bound = if cost <= exact.cost * (1.0 + 1e-12) { cost } else { exact.cost };
    Ok(RapidPlan { path, cost, lower_bound, alternatives: candidates, ..exact })
}
