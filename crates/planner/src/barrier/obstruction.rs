//! A set of blockers that answers quickly which of them block a move.

use super::blocked_offsets::blocked_by;
use super::quick_test::{QUICK_TEST_MARGIN_MM, QuickTest};
use super::run::{Run, pieces};
use super::{Blocker, Feature, Grid, ObstructionParts, Outline};
use std::ops::{ControlFlow, Range};
use traverse_geometry::{Arc, Bounds, Edge, Point, Segment};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many runs.
const RUNS_BETWEEN_CHECKS: usize = 2048;

/// A run whose box would enter more cells than this enters the grid blocker by blocker.
const RUN_CELLS: f64 = 16.0;

/// Blockers in a bucket grid. A query looks at what lies along it.
#[derive(Debug)]
pub(crate) struct Obstruction<'a> {
    /// Blockers that are kept.
    blockers: Vec<Blocker>,
    /// Outlines whose blockers are their own edges: made where a query comes near.
    outlines: Vec<Outline<'a>>,
    runs: Vec<Run>,
    grid: Grid,
    /// Owners whose inside is not within the box of a run of one of their outlines.
    wide: Vec<usize>,
}

impl<'a> Obstruction<'a> {
    /// Puts `parts` in a grid. Cost: linear in their runs.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn new(parts: ObstructionParts<'a>, budget: &Budget) -> Result<Self, Interrupt> {
        let ObstructionParts { blockers, outlines, runs, wide, load } = parts;
        let room = Vec::with_capacity(runs.len());
        let mut obstruction = Self { blockers, outlines, runs: room, grid: Grid::new(&load), wide };
        for (i, run) in runs.into_iter().enumerate() {
            if i.is_multiple_of(RUNS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            obstruction.insert(run);
        }
        Ok(obstruction)
    }

    /// Adds an outline's chain of blockers, which are kept; answers their numbers.
    pub(crate) fn push(&mut self, outline: &Outline<'_>) -> Range<usize> {
        let first = self.blockers.len();
        outline.add_blockers(&mut self.blockers);
        let end = self.blockers.len();
        for run in Run::of_kept(&self.blockers, first..end).collect::<Vec<_>>() {
            self.insert(run);
        }
        first..end
    }

    /// The grid that it stands in.
    pub(crate) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Blockers that are kept, by number.
    pub(crate) fn kept(&self, numbers: Range<usize>) -> &[Blocker] {
        &self.blockers[numbers]
    }

    /// The owner of a run of blockers that are kept.
    pub(crate) fn owner_of_run(&self, run: u32) -> usize {
        self.blockers[self.runs[run as usize].first as usize].owner
    }

    /// The edges of a run of blockers that are kept and the one that follows, so that neighbouring runs overlap.
    pub(crate) fn chain_of_run(&self, run: u32) -> impl Iterator<Item = &Edge> {
        let run = &self.runs[run as usize];
        let numbers = (run.first..run.end).chain([run.following]);
        numbers.map(|number| &self.blockers[number as usize].edge)
    }

    fn insert(&mut self, run: Run) {
        let reach = self.blocker(&run, run.first).limit;
        if self.grid.cells_of(&run.bounds, reach) <= RUN_CELLS {
            self.grid.insert_box(self.runs.len() as u32, &run.bounds, reach);
            self.runs.push(Run { bounds: run.bounds.grown(reach), ..run });
            return;
        }
        if let Some(outline) = self.outline(&run) {
            self.wide.push(outline.owner);
        }
        for first in run.first..run.end {
            let blocker = self.blocker(&run, first);
            let (item, grid) = (self.runs.len() as u32, &mut self.grid);
            pieces(&blocker, |from, to, reach| grid.insert(item, from, to, reach));
            let bounds = blocker.edge.bounds().grown(reach);
            let following = if first + 1 == run.end { run.following } else { first + 1 };
            self.runs.push(Run { first, end: first + 1, following, bounds, ..run });
        }
    }

    /// Shows `visit` every blocker that blocks the straight move, roughly in order, some of them more than once, until
    /// it breaks off.
    pub(crate) fn blocking(&self, line: &Segment, mut visit: impl FnMut(&Blocker) -> ControlFlow<()>) {
        let quick = QuickTest::new(line);
        let piece = Edge::Segment(*line);
        let mut last = u32::MAX;
        let _ = self.grid.along(line.start, line.end, |item| {
            let run = &self.runs[item as usize];
            if item == last || quick.passes_box(&run.bounds) {
                return ControlFlow::Continue(());
            }
            last = item;
            let mut visit = |blocker: &Blocker| {
                if blocker.blocks(&piece) { visit(blocker) } else { ControlFlow::Continue(()) }
            };
            let Some(outline) = self.outline(run) else {
                let blockers = self.kept(run.first as usize..run.end as usize).iter();
                return blockers.filter(|blocker| !quick.passes_over(blocker)).try_for_each(visit);
            };
            let limit = outline.clearance.limit();
            for number in run.first..run.end {
                let (from, to, aside) = outline.ring.strip(number as usize);
                if !quick.passes_strip(from, to, limit + aside) {
                    visit(&outline.blocker(number as usize))?;
                }
            }
            ControlFlow::Continue(())
        });
    }

    /// Every blocker that may block the straight move, each once, and some that don't.
    pub(crate) fn near(&self, line: &Segment) -> impl Iterator<Item = Blocker> {
        let mut found = Vec::new();
        let _ = self.grid.along(line.start, line.end, |item| {
            found.push(item);
            ControlFlow::Continue(())
        });
        self.each(found)
    }

    /// Shows `visit` every blocker that `point` lies nearer to than its limit and a `margin`, some of them more than once.
    pub(crate) fn round(&self, point: Point, margin: f64, mut visit: impl FnMut(&Blocker)) {
        let _ = self.grid.within(&Bounds::of([point]).grown(margin), |item| {
            let run = &self.runs[item as usize];
            if run.bounds.grown(margin).contains(point) {
                let blockers = (run.first..run.end).map(|number| self.blocker(run, number));
                let is_near =
                    |blocker: &Blocker| blocker.edge.distance_to_point(point) < blocker.limit + margin;
                blockers.filter(is_near).for_each(|blocker| visit(&blocker));
            }
            ControlFlow::Continue(())
        });
    }

    /// The offsets of `feature` at which the planned path would come too near to some blocker: disjoint or not,
    /// each with the blocker's owner.
    pub(crate) fn blocked_offsets(&self, feature: &Feature) -> impl Iterator<Item = (f64, f64, usize)> {
        let circle =
            Arc::from_angles(feature.center, feature.plan_radius, feature.start_angle, feature.sweep);
        let bounds = circle.bounds().grown(QUICK_TEST_MARGIN_MM);
        let mut found = Vec::new();
        let _ = self.grid.within(&bounds, |item| {
            if self.runs[item as usize].bounds.meets(&bounds) {
                found.push(item);
            }
            ControlFlow::Continue(())
        });
        let (middle, reach) = feature.disc();
        let far = reach + QUICK_TEST_MARGIN_MM;
        let may_block =
            move |blocker: &Blocker| blocker.edge.distance_to_point(middle) <= far + blocker.limit;
        self.each(found).filter(may_block).flat_map(|blocker| {
            blocked_by(feature, &blocker).into_iter().map(move |(from, to)| (from, to, blocker.owner))
        })
    }

    /// Owners whose outlines' boxes hold `point`, and others, each once, ascending.
    pub(crate) fn owners_at(&self, point: Point) -> Vec<usize> {
        let mut owners = self.wide.clone();
        let _ = self.grid.within(&Bounds::of([point]), |item| {
            owners.extend(self.outline(&self.runs[item as usize]).map(|outline| outline.owner));
            ControlFlow::Continue(())
        });
        owners.sort_unstable();
        owners.dedup();
        owners
    }

    fn each(&self, mut items: Vec<u32>) -> impl Iterator<Item = Blocker> {
        items.sort_unstable();
        items.dedup();
        items.into_iter().flat_map(|item| {
            let run = &self.runs[item as usize];
            (run.first..run.end).map(|number| self.blocker(run, number))
        })
    }

    /// The outline of a run, unless its blockers are kept.
    fn outline(&self, run: &Run) -> Option<&Outline<'a>> {
        self.outlines.get(run.outline as usize)
    }

    fn blocker(&self, run: &Run, number: u32) -> Blocker {
        match self.outline(run) {
            Some(outline) => outline.blocker(number as usize),
            None => self.blockers[number as usize],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::barrier::Clearance;
    use rand::RngExt;
    use std::collections::BTreeSet;
    use std::f64::consts::TAU;
    use traverse_geometry::{CornerStyle, Location, Polygon, Ring, unit};
    use traverse_solve::Seed;

    /// Stars of some size about a point, straight or with arcs, run either way.
    fn star(random: &mut impl RngExt, size: f64) -> Polygon {
        loop {
            let corners = random.random_range(3..40);
            let step = TAU / f64::from(corners);
            let middle = Point::new(random.random_range(0.0..90.0), random.random_range(0.0..90.0));
            let mut at = |i: i32| {
                let angle = step * (f64::from(i) + random.random_range(0.1..0.9));
                middle + unit(angle) * size * random.random_range(0.5..1.0)
            };
            let points: Vec<Point> = (0..corners).map(&mut at).collect();
            let mut bulge = || random.random_range(-0.4..0.4) * f64::from(random.random_range(0..2));
            let bulges = if corners % 2 == 0 { points.iter().map(|_| bulge()).collect() } else { Vec::new() };
            if let Ok(ring) = Ring::new(points, bulges) {
                let ring = if corners % 3 == 0 { ring.reversed() } else { ring };
                return Polygon::from_ring(ring);
            }
        }
    }

    /// Blockers made where a query comes near block the same moves and arcs as those that are kept, and an owner whose
    /// barrier holds a point is found there.
    #[test]
    fn outlines_answer_as_kept_blockers_do() {
        let (mut blocked, mut held) = (0, 0);
        for seed in 0..40 {
            let mut random = Seed(seed).stream();
            let shapes: Vec<Polygon> = (0..12).map(|i| star(&mut random, [4.0, 9.0, 40.0][i % 3])).collect();
            let unlimited = Budget::unlimited();
            let (mut made, mut kept) =
                (ObstructionParts::with_capacity(0, 0), ObstructionParts::with_capacity(0, 0));
            let mut features = Vec::new();
            let clearance =
                |owner: usize| Clearance { asked: [0.0, 2.0][owner % 2], style: CornerStyle::Round };
            for (owner, shape) in shapes.iter().enumerate() {
                for outline in Outline::of(shape, true, clearance(owner), owner) {
                    made.add(outline, &unlimited).expect("no limit");
                    kept.keep(&outline);
                    outline.add_features(&mut features, &unlimited).expect("no limit");
                }
            }
            let [made, kept] =
                [made, kept].map(|parts| Obstruction::new(parts, &unlimited).expect("no limit"));
            for _ in 0..100 {
                let mut at = || Point::new(random.random_range(-9.0..99.0), random.random_range(-9.0..99.0));
                let line = Segment::new(at(), at());
                let [by_made, by_kept] = [&made, &kept].map(|obstruction| {
                    let (mut blocking, mut near) = (BTreeSet::new(), BTreeSet::new());
                    let key = |blocker: &Blocker| {
                        let start = blocker.edge.start();
                        (blocker.owner, start.x.to_bits(), start.y.to_bits())
                    };
                    obstruction.blocking(&line, |blocker| {
                        blocking.insert(key(blocker));
                        ControlFlow::Continue(())
                    });
                    let blocks = |blocker: &Blocker| blocker.blocks(&Edge::Segment(line));
                    near.extend(obstruction.near(&line).filter(blocks).map(|blocker| key(&blocker)));
                    assert_eq!(blocking, near, "seed {seed}");
                    blocking
                });
                assert_eq!(by_made, by_kept, "seed {seed}");
                blocked += by_made.len();
                let owners = made.owners_at(line.start);
                for (owner, shape) in shapes.iter().enumerate() {
                    let is_held = shape.locate(line.start) == Location::Inside
                        || shape.distance_to_border(line.start) < clearance(owner).limit();
                    assert!(!is_held || owners.contains(&owner), "seed {seed}");
                    held += u32::from(is_held);
                }
            }
            for feature in &features {
                let [by_made, by_kept] = [&made, &kept].map(|obstruction| {
                    let mut offsets: Vec<_> = obstruction.blocked_offsets(feature).collect();
                    offsets.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)).then(a.1.total_cmp(&b.1)));
                    offsets
                });
                assert_eq!(by_made, by_kept, "seed {seed}");
            }
        }
        assert!(blocked > 10_000 && held > 1_000, "{blocked} {held}");
    }
}
