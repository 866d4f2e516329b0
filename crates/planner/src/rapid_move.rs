//! The shortest rapid move, exactly: from a scene and two ends to a plan, or the proof that there is none.
//!
//! Cost: a search among the barriers that it meets; building the obstruction of the whole scene is n log n.

use crate::barriers::Barriers;
use crate::search::{End, Known, Route, Search};
use crate::separating::separating;
use crate::standing::stand;
use crate::supporting_lines::Scan;
use crate::trace::trace;
use crate::{Algorithm, Answer, NoPath, RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{Path, Scene};
use traverse_solve::{Budget, Interrupt, Observer};

/// Plans one rapid move in a valid scene.
///
/// # Errors
/// See [`Refusal`]; every end that lies inside a barrier is named, one refusal each.
pub fn plan_rapid_move(
    scene: &Scene,
    query: &RapidMove,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<(Answer, Stats), Vec<Refusal>> {
    let straight = (query.target - query.start).norm();
    let barriers = Barriers::new(scene, budget)
        .map_err(|interrupt| vec![Refusal::Interrupted { interrupt, lower_bound: straight }])?;
    plan_among(&barriers, query, budget, observer, &mut MeetingBarriers)
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
struct MeetingBarriers;

impl ShortestRoute for MeetingBarriers {
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        [start, target]: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64) {
        let mut search = Search::new(Known::new(barriers, &BTreeSet::new()), start, target);
        let found = search.run(budget, &mut stats.expanded_nodes, observer);
        stats.barrier_vertices = search.known.features.len() as u64;
        (found, search.lower_bound)
    }
}

/// Plans one rapid move among barriers that were taken apart.
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
    let scene = barriers.scene;
    let interrupted =
        |lower_bound: f64| move |interrupt: Interrupt| vec![Refusal::Interrupted { interrupt, lower_bound }];
    let straight = (query.target - query.start).norm();
    let scan = match query.algorithm {
        Algorithm::Exact => None,
        Algorithm::SupportingLines => {
            Some(Scan::of(scene, query.start, query.target).map_err(|refusal| vec![refusal])?)
        }
    };
    let start = stand(barriers, "start", query.start, budget).map_err(interrupted(straight))?;
    let target = stand(barriers, "target", query.target, budget).map_err(interrupted(straight))?;
    let (start, target) = both(start, target)?;
    let mut solver = Solver { barriers, budget, observer, stats: Stats::default(), lower_bound: straight };
    let solved = solver.solve(&start, &target, shortest).map_err(interrupted(solver.lower_bound))?;
    let stats = solver.stats;
    let (path, bending_obstacles) = match solved {
        Solved::Path(path, bending) => (path, bending),
        Solved::Parted(separating_obstacles) => {
            return Ok((Answer::NoPath(NoPath { separating_obstacles }), stats));
        }
    };
    let cost = path.length();
    let exact = RapidPlan {
        path,
        cost,
        lower_bound: cost,
        clearance_mm: scene.clearance_mm,
        bending_obstacles,
        alternatives: Vec::new(),
    };
    let Some(scan) = scan else { return Ok((Answer::Plan(exact), stats)) };
    let see_each_other = exact.path.steps.len() <= 1;
    let candidates = scan.candidates(see_each_other, budget).map_err(interrupted(cost))?;
    Ok((Answer::Plan(published(candidates, exact)?), stats))
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

fn both(
    start: Result<End, Vec<Refusal>>,
    target: Result<End, Vec<Refusal>>,
) -> Result<(End, End), Vec<Refusal>> {
    match (start, target) {
        (Ok(start), Ok(target)) => Ok((start, target)),
        (start, target) => Err([start.err(), target.err()].into_iter().flatten().flatten().collect()),
    }
}

/// What the search came to.
enum Solved {
    /// A path, and what bends it.
    Path(Path, Vec<String>),
    /// None, because of these.
    Parted(Vec<String>),
}

struct Solver<'a> {
    barriers: &'a Barriers<'a>,
    budget: &'a Budget,
    observer: &'a mut dyn Observer,
    stats: Stats,
    lower_bound: f64,
}

impl Solver<'_> {
    fn solve(
        &mut self,
        start: &End,
        target: &End,
        shortest: &mut dyn ShortestRoute,
    ) -> Result<Solved, Interrupt> {
        if start.point == target.point {
            return Ok(Solved::Path(Path::at(start.point), Vec::new()));
        }
        for end in [start, target] {
            if end.places.is_empty() {
                return Ok(Solved::Parted(self.named(end.shut_in_by.iter().copied())));
            }
        }
        let (found, lower_bound) =
            shortest.shortest(self.barriers, [start, target], &mut self.stats, self.budget, self.observer);
        if lower_bound > self.lower_bound {
            self.lower_bound = lower_bound;
            self.observer.better_bound(lower_bound);
        }
        let Some(route) = found? else {
            let parting = separating(self.barriers, start, target, self.budget, &mut self.stats)?;
            return Ok(Solved::Parted(self.named(parting)));
        };
        self.observer.better_cost(route.cost);
        let path = trace(&route, start.point, target.point);
        let mut bending: Vec<String> = route.stops.iter().map(|stop| self.id(stop.circle.owner)).collect();
        bending.dedup();
        Ok(Solved::Path(path, bending))
    }

    /// Ids of obstacles; the work area's border is taken for granted.
    fn named(&self, owners: impl IntoIterator<Item = usize>) -> Vec<String> {
        let is_obstacle = |owner: &usize| self.barriers.obstacle(*owner).is_some();
        owners.into_iter().filter(is_obstacle).map(|owner| self.id(owner)).collect()
    }

    fn id(&self, owner: usize) -> String {
        self.barriers.id(owner).to_owned()
    }
}
