//! The shortest rapid move, exactly: look only at what blocks the line.
//!
//! Start with no barrier at all; find the shortest path among the active barriers; test it against the whole scene;
//! activate what it hits; repeat until it hits nothing. Every round is a relaxation of the scene, so its cost bounds
//! the optimum from below, and the first path that hits nothing is optimal. Exact because blocked means the same in
//! both tests. The idea is the published scan's (2008), made exact.
//!
//! Cost: a few rounds over a few barriers; building the obstruction of the whole scene is n log n.

use crate::barriers::Barriers;
use crate::search::{End, Relaxation, Route, shortest};
use crate::separating::separating;
use crate::standing::stand;
use crate::supporting_lines::Scan;
use crate::trace::trace;
use crate::{Algorithm, Answer, NoPath, RapidMove, RapidPlan, Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::{Edge, Path, Scene, Segment};
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

/// What the rounds came to.
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
        let mut relaxation = Relaxation::default();
        let mut active: BTreeSet<usize> = BTreeSet::new();
        loop {
            let found = shortest(&relaxation, start, target, self.budget, &mut self.stats.expanded_nodes)?;
            self.stats.barrier_vertices = relaxation.features.len() as u64;
            let Some(route) = found else {
                let parting = separating(self.barriers, active, start, target, self.budget, &mut self.stats)?;
                return Ok(Solved::Parted(self.named(parting)));
            };
            if route.cost > self.lower_bound {
                self.lower_bound = route.cost;
                self.observer.better_bound(route.cost);
            }
            let hit = self.hits(&route, &relaxation)?;
            if hit.is_empty() {
                self.observer.better_cost(route.cost);
                let path = trace(&route, &relaxation.features, start.point, target.point);
                return Ok(Solved::Path(path, self.bending(&route, &relaxation)));
            }
            assert!(hit.is_disjoint(&active), "invariant: a path hit a barrier that it was planned round");
            let (blockers, features) = self.barriers.parts(hit.iter().copied());
            relaxation.add(&blockers, &features, self.budget)?;
            active.extend(hit);
        }
    }

    /// Owners of the barriers of the whole scene that the planned path runs into.
    fn hits(&self, route: &Route, relaxation: &Relaxation) -> Result<BTreeSet<usize>, Interrupt> {
        let mut hit = BTreeSet::new();
        // Where nothing is moved nothing is hit: the search does not test that either.
        for &(from, to) in route.straights.iter().filter(|(from, to)| from != to) {
            self.budget.check(0)?;
            let piece = Edge::Segment(Segment::new(from, to));
            hit.extend(self.barriers.whole.blocking(&piece).map(|blocker| blocker.owner));
        }
        for stop in &route.stops {
            self.budget.check(0)?;
            let feature = &relaxation.features[stop.feature];
            if feature.plan_radius == 0.0 {
                continue;
            }
            // The free stretches of the search close within this tolerance at both ends.
            let margin = 2.0 * feature.offset_tolerance();
            let (low, high) = (stop.from.min(stop.to) + margin, stop.from.max(stop.to) - margin);
            let blocked = self.barriers.whole.blocked_offsets(feature);
            hit.extend(blocked.filter(|&(from, to, _)| from < high && low < to).map(|(_, _, owner)| owner));
        }
        Ok(hit)
    }

    /// Ids of obstacles; the work area's border is taken for granted.
    fn named(&self, owners: impl IntoIterator<Item = usize>) -> Vec<String> {
        let is_obstacle = |owner: &usize| *owner < self.barriers.scene.obstacles.len();
        owners.into_iter().filter(is_obstacle).map(|owner| self.id(owner)).collect()
    }

    fn bending(&self, route: &Route, relaxation: &Relaxation) -> Vec<String> {
        let mut ids: Vec<String> =
            route.stops.iter().map(|stop| self.id(relaxation.features[stop.feature].owner)).collect();
        ids.dedup();
        ids
    }

    fn id(&self, owner: usize) -> String {
        self.barriers.id(owner).to_owned()
    }
}
