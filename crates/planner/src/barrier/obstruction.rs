//! A set of blockers that answers quickly which of them block a move.

use super::{Blocker, Feature, Grid, Load};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use traverse_geometry::{Arc, Bounds, Edge, Point, Segment, Vector, left_of, positive_angle};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many runs.
const RUNS_BETWEEN_CHECKS: usize = 2048;

/// Widest piece of an arc that enters the grid by its chord, radians.
const ARC_PIECE_RAD: f64 = std::f64::consts::FRAC_PI_8;

/// What lies further than this beyond a blocker's limit is passed over by a quick test, millimetres: above its rounding.
const QUICK_TEST_MARGIN_MM: f64 = 1e-8;

/// Most blockers in a run.
const RUN_LENGTH: usize = 8;

/// A run whose box would enter more cells than this enters the grid blocker by blocker.
const RUN_CELLS: f64 = 16.0;

/// Blockers in a bucket grid. Building is linear; a query looks at what lies along it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Obstruction {
    blockers: Vec<Blocker>,
    runs: Vec<Run>,
    grid: Grid,
}

/// Neighbouring blockers: what the grid holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    first: u32,
    end: u32,
    /// The blocker that follows on the same chain.
    following: u32,
    /// What they can reach.
    bounds: Bounds,
}

impl Obstruction {
    /// All of `blockers`; `ends` says where each closed chain of neighbours ends.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn new(blockers: Vec<Blocker>, ends: &[usize], budget: &Budget) -> Result<Self, Interrupt> {
        let mut load = Load::NONE;
        let mut runs: Vec<(Run, f64)> = Vec::with_capacity(ends.len() + blockers.len() / RUN_LENGTH);
        let mut first = 0;
        for &end in ends {
            for (run, reach) in runs_of(&blockers, first, end) {
                if runs.len().is_multiple_of(RUNS_BETWEEN_CHECKS) {
                    budget.check(0)?;
                }
                load.add(&run.bounds, reach);
                runs.push((run, reach));
            }
            first = end;
        }
        let grid = Grid::new(&load);
        let mut obstruction = Self { blockers, runs: Vec::with_capacity(runs.len()), grid };
        for (i, (run, reach)) in runs.into_iter().enumerate() {
            if i.is_multiple_of(RUNS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            obstruction.insert(run, reach);
        }
        Ok(obstruction)
    }

    /// Adds a closed chain of blockers; answers their numbers.
    pub(crate) fn push_chain(&mut self, chain: &[Blocker]) -> std::ops::Range<usize> {
        let first = self.blockers.len();
        self.blockers.extend_from_slice(chain);
        let end = self.blockers.len();
        for (run, reach) in runs_of(&self.blockers, first, end).collect::<Vec<_>>() {
            self.insert(run, reach);
        }
        first..end
    }

    /// The grid that it stands in.
    pub(crate) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Blockers by number.
    pub(crate) fn blockers(&self, numbers: std::ops::Range<usize>) -> &[Blocker] {
        &self.blockers[numbers]
    }

    /// The owner of a run of the grid.
    pub(crate) fn owner_of_run(&self, run: u32) -> usize {
        self.blockers[self.runs[run as usize].first as usize].owner
    }

    /// The edges of a run of the grid and the one that follows, so that neighbouring runs overlap.
    pub(crate) fn chain_of_run(&self, run: u32) -> impl Iterator<Item = &Edge> {
        let run = &self.runs[run as usize];
        let numbers = (run.first..run.end).chain([run.following]);
        numbers.map(|number| &self.blockers[number as usize].edge)
    }

    fn insert(&mut self, run: Run, reach: f64) {
        if self.grid.cells_of(&run.bounds, reach) <= RUN_CELLS {
            self.grid.insert_box(self.runs.len() as u32, &run.bounds, reach);
            self.runs.push(Run { bounds: run.bounds.grown(reach), ..run });
            return;
        }
        for first in run.first..run.end {
            let blocker = &self.blockers[first as usize];
            let (item, grid) = (self.runs.len() as u32, &mut self.grid);
            pieces(blocker, |from, to, reach| grid.insert(item, from, to, reach));
            let bounds = blocker.edge.bounds().grown(blocker.limit);
            let following = if first + 1 == run.end { run.following } else { first + 1 };
            self.runs.push(Run { first, end: first + 1, following, bounds });
        }
    }

    /// Shows `visit` every blocker that blocks the straight move, roughly in order, some of them more than once, until
    /// it breaks off.
    pub(crate) fn blocking<'a>(
        &'a self,
        line: &Segment,
        mut visit: impl FnMut(&'a Blocker) -> ControlFlow<()>,
    ) {
        let quick = QuickTest::new(line);
        let piece = Edge::Segment(*line);
        let mut last = u32::MAX;
        let _ = self.grid.along(line.start, line.end, |item| {
            let run = &self.runs[item as usize];
            if item == last || quick.passes_box(&run.bounds) {
                return ControlFlow::Continue(());
            }
            last = item;
            for blocker in &self.blockers[run.first as usize..run.end as usize] {
                if !quick.passes_over(blocker) && blocker.blocks(&piece) {
                    visit(blocker)?;
                }
            }
            ControlFlow::Continue(())
        });
    }

    /// Every blocker that may block the straight move, each once, and some that don't.
    pub(crate) fn near(&self, line: &Segment) -> impl Iterator<Item = &Blocker> {
        let mut found = Vec::new();
        let _ = self.grid.along(line.start, line.end, |item| {
            found.push(item);
            ControlFlow::Continue(())
        });
        self.each(found)
    }

    /// Shows `visit` every blocker that `point` lies nearer to than its limit and a `margin`, some of them more than once.
    pub(crate) fn round<'a>(&'a self, point: Point, margin: f64, mut visit: impl FnMut(&'a Blocker)) {
        let _ = self.grid.within(&Bounds::of([point]).grown(margin), |item| {
            let run = &self.runs[item as usize];
            if run.bounds.grown(margin).contains(point) {
                let near =
                    |blocker: &&Blocker| blocker.edge.distance_to_point(point) < blocker.limit + margin;
                self.blockers[run.first as usize..run.end as usize].iter().filter(near).for_each(&mut visit);
            }
            ControlFlow::Continue(())
        });
    }

    /// The offsets of `feature` at which the planned path would come too near to some blocker: disjoint or not,
    /// each with the blocker's owner.
    pub(crate) fn blocked_offsets(&self, feature: &Feature) -> impl Iterator<Item = (f64, f64, usize)> {
        let circle =
            Arc::from_angles(feature.center, feature.plan_radius, feature.start_angle, feature.sweep);
        let mut found = Vec::new();
        let _ = self.grid.within(&circle.bounds(), |item| {
            found.push(item);
            ControlFlow::Continue(())
        });
        let far = feature.plan_radius + QUICK_TEST_MARGIN_MM;
        let may_block =
            move |blocker: &&Blocker| blocker.edge.distance_to_point(feature.center) <= far + blocker.limit;
        self.each(found).filter(may_block).flat_map(|blocker| {
            blocked_by(feature, blocker).into_iter().map(|(from, to)| (from, to, blocker.owner))
        })
    }

    fn each(&self, mut items: Vec<u32>) -> impl Iterator<Item = &Blocker> {
        items.sort_unstable();
        items.dedup();
        let blockers = |run: &Run| &self.blockers[run.first as usize..run.end as usize];
        items.into_iter().flat_map(move |item| blockers(&self.runs[item as usize]))
    }
}

/// The runs of the closed chain of blockers from `first` to `end`, each with the reach of its blockers.
fn runs_of(blockers: &[Blocker], first: usize, end: usize) -> impl Iterator<Item = (Run, f64)> {
    (first..end).step_by(RUN_LENGTH).map(move |run| {
        let run_end = end.min(run + RUN_LENGTH);
        let part = &blockers[run..run_end];
        let bounds = part.iter().fold(Bounds::EMPTY, |bounds, blocker| bounds.union(blocker.edge.bounds()));
        let reach = part.iter().fold(0.0_f64, |reach, blocker| reach.max(blocker.limit));
        let following = if run_end == end { first } else { run_end } as u32;
        (Run { first: run as u32, end: run_end as u32, following, bounds }, reach)
    })
}

/// The thick segments that hold all that a blocker forbids.
fn pieces(blocker: &Blocker, mut add: impl FnMut(Point, Point, f64)) {
    match &blocker.edge {
        Edge::Segment(segment) => add(segment.start, segment.end, blocker.limit),
        Edge::Arc(arc) => {
            let count = (arc.sweep.abs() / ARC_PIECE_RAD).ceil().max(1.0);
            let sagitta = arc.radius * (1.0 - (arc.sweep.abs() / count / 2.0).cos());
            let mut from = arc.start;
            for piece in 1..=count as usize {
                let to = arc.point_at(piece as f64 / count);
                add(from, to, blocker.limit + sagitta);
                from = to;
            }
        }
    }
}

/// Passes over straight blockers that lie clear of a line: beside it, before it or behind it.
struct QuickTest {
    start: Point,
    along: Vector,
    across: Vector,
    length: f64,
}

impl QuickTest {
    fn new(line: &Segment) -> Self {
        let length = line.length();
        let along = line.vector().try_normalize(0.0).unwrap_or_default();
        Self { start: line.start, along, across: left_of(along), length }
    }

    fn passes_box(&self, bounds: &Bounds) -> bool {
        let center = bounds.center() - self.start;
        let half = bounds.size() / 2.0;
        let reach = half.x * self.across.x.abs() + half.y * self.across.y.abs();
        center.dot(&self.across).abs() > reach + QUICK_TEST_MARGIN_MM
    }

    fn passes_over(&self, blocker: &Blocker) -> bool {
        let Edge::Segment(edge) = &blocker.edge else { return false };
        let margin = blocker.limit + QUICK_TEST_MARGIN_MM;
        let (a, b) = (edge.start - self.start, edge.end - self.start);
        let (a_across, b_across) = (a.dot(&self.across), b.dot(&self.across));
        let (a_along, b_along) = (a.dot(&self.along), b.dot(&self.along));
        a_across.min(b_across) > margin
            || a_across.max(b_across) < -margin
            || a_along.min(b_along) > self.length + margin
            || a_along.max(b_along) < -margin
    }
}

/// The offsets of `feature` nearer to the blocker's edge than its limit. Boundaries are where the circle meets the
/// edge's parallels and end circles; between two of them one point decides.
fn blocked_by(feature: &Feature, blocker: &Blocker) -> Vec<(f64, f64)> {
    let mut cuts = vec![0.0, feature.sweep];
    let mut cut = |center: Point, radius: f64| circle_offsets(feature, center, radius, &mut cuts);
    cut(blocker.edge.start(), blocker.limit);
    cut(blocker.edge.end(), blocker.limit);
    match blocker.edge {
        Edge::Arc(arc) => {
            cut(arc.center, arc.radius + blocker.limit);
            cut(arc.center, arc.radius - blocker.limit);
        }
        Edge::Segment(segment) => {
            if let Some(along) = segment.vector().try_normalize(0.0) {
                for side in [blocker.limit, -blocker.limit] {
                    line_offsets(feature, segment.start, along, side, &mut cuts);
                }
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut blocked: Vec<(f64, f64)> = Vec::new();
    for pair in cuts.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let middle = feature.plan_point((from + to) / 2.0);
        if to > from && blocker.edge.distance_to_point(middle) < blocker.limit {
            match blocked.last_mut() {
                Some(last) if last.1 == from => last.1 = to,
                _ => blocked.push((from, to)),
            }
        }
    }
    blocked
}

/// Adds the offsets at which the feature's circle meets another circle.
fn circle_offsets(feature: &Feature, center: Point, radius: f64, cuts: &mut Vec<f64>) {
    let axis = center - feature.center;
    let distance = axis.norm();
    let own = feature.plan_radius;
    if distance == 0.0 || radius <= 0.0 || own == 0.0 {
        return;
    }
    let cosine = (distance * distance + own * own - radius * radius) / (2.0 * distance * own);
    push_pair(feature, axis.y.atan2(axis.x), cosine, cuts);
}

/// Adds the offsets at which the feature's circle meets the line `side` to the left of one through `start`.
fn line_offsets(feature: &Feature, start: Point, along: Vector, side: f64, cuts: &mut Vec<f64>) {
    if feature.plan_radius == 0.0 {
        return;
    }
    let normal = left_of(along);
    let height = normal.dot(&(feature.center - start));
    push_pair(feature, normal.y.atan2(normal.x), (side - height) / feature.plan_radius, cuts);
}

fn push_pair(feature: &Feature, middle: f64, cosine: f64, cuts: &mut Vec<f64>) {
    if cosine.abs() > 1.0 {
        return;
    }
    let half = cosine.acos();
    for angle in [middle - half, middle + half] {
        let offset = positive_angle(angle - feature.start_angle);
        if offset < feature.sweep.min(TAU) {
            cuts.push(offset);
        }
    }
}
