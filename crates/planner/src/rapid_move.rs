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
    let interrupted =
        |lower_bound: f64| move |interrupt: Interrupt| vec![Refusal::Interrupted { interrupt, lower_bound }];
    let straight = (query.target - query.start).norm();
    let scan = match query.algorithm {
        Algorithm::Exact => None,
        Algorithm::SupportingLines => {
            Some(Scan::of(scene, query.start, query.target).map_err(|refusal| vec![refusal])?)
        }
    };
    let barriers = Barriers::new(scene, budget).map_err(interrupted(straight))?;
    let start = stand(&barriers, "start", query.start, budget).map_err(interrupted(straight))?;
    let target = stand(&barriers, "target", query.target, budget).map_err(interrupted(straight))?;
    let (start, target) = both(start, target)?;
    let mut solver =
        Solver { barriers: &barriers, budget, observer, stats: Stats::default(), lower_bound: straight };
    let solved = solver.solve(&start, &target).map_err(interrupted(solver.lower_bound))?;
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
    fn solve(&mut self, start: &End, target: &End) -> Result<Solved, Interrupt> {
        if start.point == target.point {
            return Ok(Solved::Path(Path::at(start.point), Vec::new()));
        }
        for end in [start, target] {
            if end.places.is_empty() {
                return Ok(Solved::Parted(self.named(end.shut_in_by.iter().copied())));
            }
        }
        let mut search = Search::new(Known::new(self.barriers, &BTreeSet::new()), start, target);
        let found = search.run(self.budget, &mut self.stats.expanded_nodes, self.observer);
        if search.lower_bound > self.lower_bound {
            self.lower_bound = search.lower_bound;
            self.observer.better_bound(self.lower_bound);
        }
        self.stats.barrier_vertices = search.known.features.len() as u64;
        let Some(route) = found? else {
            let parting = search.known.met().collect();
            let parting = separating(self.barriers, parting, start, target, self.budget, &mut self.stats)?;
            return Ok(Solved::Parted(self.named(parting)));
        };
        self.observer.better_cost(route.cost);
        let path = trace(&route, &search.known.features, start.point, target.point);
        Ok(Solved::Path(path, self.bending(&route, &search.known)))
    }

    /// Ids of obstacles; the work area's border is taken for granted.
    fn named(&self, owners: impl IntoIterator<Item = usize>) -> Vec<String> {
        let is_obstacle = |owner: &usize| self.barriers.obstacle(*owner).is_some();
        owners.into_iter().filter(is_obstacle).map(|owner| self.id(owner)).collect()
    }

    fn bending(&self, route: &Route, known: &Known<'_>) -> Vec<String> {
        let mut ids: Vec<String> =
            route.stops.iter().map(|stop| self.id(known.features[stop.feature].owner)).collect();
        ids.dedup();
        ids
    }

    fn id(&self, owner: usize) -> String {
        self.barriers.id(owner).to_owned()
    }
}
