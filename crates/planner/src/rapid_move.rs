//! The shortest rapid move, exactly: from a scene, two ends and rules to a plan, or the proof that there is none.
//!
//! Clearances are tried in turn; at each the ends' ways out of the barriers are found, then the best level, and at each
//! level that matters the shortest path in the plane.
//!
//! Cost: a search among the barriers that it meets for each clearance and level; the obstruction of the whole scene, once
//! for each clearance, is linear in rings as long as these are short, in edges otherwise.

use crate::at_clearance::{AtClearance, Outcome};
use crate::barriers::Barriers;
use crate::feasible::feasible_clearance;
use crate::lowered::with_clearance;
use crate::prepared::LinksAtLast;
use crate::price::{at_rest, straight, vertical};
use crate::shortest_route::ShortestRoute;
use crate::supporting_lines::Scan;
use crate::{Algorithm, Answer, FeasibleClearance, NoPath, RapidMove, RapidPlan, Refusal, Stats};
use traverse_geometry::{EndRule, Path, Scene, TravelCost};
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
    let mut stats = Stats::default();
    let Some((&smallest, larger)) = query.rules.clearances_mm.split_last() else {
        let answer = plan_in(scene, query, true, budget, &mut stats, observer)?;
        return Ok((answer, stats));
    };
    for &clearance in larger {
        let scene = with_clearance(scene, clearance);
        match plan_in(&scene, query, false, budget, &mut stats, observer) {
            Ok(Answer::NoPath(_)) => {}
            Err(refusals) if refusals.iter().all(Refusal::is_about_room) => {}
            Ok(answer) => return Ok((answer, stats)),
            Err(refusals) => return Err(refusals),
        }
    }
    let scene = with_clearance(scene, smallest);
    let answer = plan_in(&scene, query, true, budget, &mut stats, observer)?;
    Ok((answer, stats))
}

/// Plans at the scene's own clearance. `is_last`: no smaller one is tried after it.
fn plan_in(
    scene: &Scene,
    query: &RapidMove,
    is_last: bool,
    budget: &Budget,
    stats: &mut Stats,
    observer: &mut dyn Observer,
) -> Result<Answer, Vec<Refusal>> {
    let barriers = Barriers::new(scene, budget)
        .map_err(|interrupt| vec![Refusal::Interrupted { interrupt, lower_bound: least_cost(query) }])?;
    let asked = Asked { barriers: &barriers, query, is_last, budget };
    let answer = plan_among(asked, &mut LinksAtLast, stats, observer)?;
    Ok(with_feasible_clearance(answer, scene, query, is_last, budget, stats))
}

/// What is to be planned among barriers that were taken apart.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) barriers: &'a Barriers<'a>,
    pub(crate) query: &'a RapidMove,
    /// No smaller clearance is tried after this one.
    pub(crate) is_last: bool,
    pub(crate) budget: &'a Budget,
}

/// Plans at the scene's own clearance; says nothing of other clearances.
///
/// # Errors
/// As [`plan_rapid_move`].
pub(crate) fn plan_among(
    Asked { barriers, query, is_last, budget }: Asked<'_>,
    shortest: &mut dyn ShortestRoute,
    stats: &mut Stats,
    observer: &mut dyn Observer,
) -> Result<Answer, Vec<Refusal>> {
    let least = least_cost(query);
    let interrupted = |bound: f64| {
        // A smaller clearance may have a shorter path.
        let lower_bound = if is_last { bound } else { least };
        move |interrupt: Interrupt| vec![Refusal::Interrupted { interrupt, lower_bound }]
    };
    let scan = match query.algorithm {
        Algorithm::Exact => None,
        Algorithm::SupportingLines => {
            Some(published_scan(barriers.scene, query).map_err(|refusal| vec![refusal])?)
        }
    };
    let mut solver = AtClearance::new(barriers, query, budget, shortest);
    let outcome = solver.solve(is_last, stats, observer);
    let bound = solver.lower_bound();
    let exact = match outcome.map_err(interrupted(bound))? {
        Outcome::Plan(plan) => plan,
        Outcome::Refused(refusals) => return Err(refusals),
        Outcome::NoRoom => return Err(vec![Refusal::NoRoomForDogLegs]),
        Outcome::Parted(separating_obstacles) => {
            let feasible_clearance = FeasibleClearance::Unknown;
            return Ok(Answer::NoPath(NoPath { separating_obstacles, feasible_clearance }));
        }
    };
    let Some(scan) = scan else { return Ok(Answer::Plan(exact)) };
    let see_each_other = exact.path.steps.len() <= 1;
    let candidates = scan.candidates(see_each_other, budget).map_err(interrupted(exact.cost))?;
    Ok(Answer::Plan(published(candidates, exact)?))
}

/// The answer; where there is no path, with the clearance at which there is one.
pub(crate) fn with_feasible_clearance(
    answer: Answer,
    scene: &Scene,
    query: &RapidMove,
    is_last: bool,
    budget: &Budget,
    stats: &mut Stats,
) -> Answer {
    match answer {
        Answer::NoPath(no_path) if is_last => {
            let feasible_clearance = feasible_clearance(scene, query, budget, stats);
            Answer::NoPath(NoPath { feasible_clearance, ..no_path })
        }
        answer => answer,
    }
}

/// No path costs less, whatever is in the way.
pub(crate) fn least_cost(query: &RapidMove) -> f64 {
    let rise = query.rules.heights.map_or(0.0, |rule| (rule.target_z_mm - rule.start_z_mm).abs());
    let (by, cost) = (query.target - query.start, &query.rules.cost);
    straight(by, cost) + vertical(rise, cost) + at_rest(by.norm(), rise, cost)
}

fn published_scan(scene: &Scene, query: &RapidMove) -> Result<Scan, Refusal> {
    let not_applicable = |why| Err(Refusal::PublishedMethodNotApplicable { why });
    if query.rules.heights.is_some() {
        return not_applicable("it knows no heights");
    }
    if query.rules.cost != TravelCost::Length {
        return not_applicable("it knows no cost but length");
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
    let alternative_costs = candidates.iter().map(Path::length).collect();
    Ok(RapidPlan { path, cost, lower_bound, alternatives: candidates, alternative_costs, ..exact })
}
