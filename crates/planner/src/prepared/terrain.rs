//! What a prepared scene keeps of its barriers: everything that blocks a move, every feature, and where both lie.

use super::nearby::Nearby;
use crate::barrier::{Clearance, Feature, Grid, Obstruction, ObstructionParts, Outline};
use crate::barriers::{Marks, WORK_AREA, outlines};
use crate::search::{Circles, Ground, Sector, Stretches, is_same_circle};
use std::cell::{Cell, OnceCell};
use std::ops::{ControlFlow, Range};
use traverse_geometry::{Arc, Bounds, Point, Polygon, Scene, Segment, Vector, unit};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 4096;

/// A circle up to this share of a cell enters the grid by its box.
const SMALL_CIRCLE: f64 = 0.25;

/// Blockers and features of all owners, also of those that are gone.
pub(super) struct Terrain {
    /// What blocks a move; every blocker is kept.
    pub(super) obstruction: Obstruction<'static>,
    pub(super) features: Vec<Feature>,
    /// Features by the cells that their arcs lie in; the same cells as the obstruction's.
    pub(super) layer: Grid,
    sectors: Vec<Sector>,
    circles: Circles,
    /// Per feature its free stretches, worked out when first asked for.
    free: Vec<OnceCell<Box<Stretches>>>,
    pub(super) there: Marks,
    pub(super) nearby: Nearby,
    /// Per feature what a search looks at first.
    spots: Vec<Spot>,
    /// Per feature whether all of its range is free, as far as that is known.
    whole: Vec<Cell<Whole>>,
    /// Per feature whether a path passes from it to another without a straight move.
    joined: Vec<bool>,
    /// The radius that most features have, millimetres.
    pub(super) usual_radius: f64,
    /// Per owner, the work area's first, what it owns.
    owned: Vec<Owned>,
}

/// What a search looks at first of a feature.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) center: Point,
    pub(super) price_radius: f64,
    /// Radius on the planned path, millimetres.
    pub(super) plan_radius: f64,
    start_angle: f64,
}

impl Spot {
    /// The point at `offset` on the answered path.
    pub(super) fn at(&self, offset: f64) -> Point {
        if self.price_radius == 0.0 {
            return self.center;
        }
        self.center + unit(self.start_angle + offset) * self.price_radius
    }
}

/// Whether all of a feature's range is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Whole {
    Unknown,
    Yes,
    No,
}

/// What an owner's barrier consists of.
#[derive(Clone, Debug)]
pub(super) struct Owned {
    pub(super) features: Range<usize>,
    pub(super) blockers: Vec<Range<usize>>,
    /// What its barrier reaches.
    pub(super) bounds: Option<Bounds>,
}

impl Terrain {
    /// The terrain of a scene.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn new(scene: &Scene, budget: &Budget) -> Result<Self, Interrupt> {
        let mut parts = ObstructionParts::with_capacity(scene.vertex_count(), 0);
        let mut features = Vec::new();
        let mut owned = Vec::new();
        for owner in std::iter::once(WORK_AREA).chain(0..scene.obstacles.len()) {
            budget.check(0)?;
            let first = features.len();
            let mut chains = Vec::new();
            for outline in outlines(scene, owner) {
                outline.add_features(&mut features, budget)?;
                chains.push(parts.keep(&outline));
            }
            owned.push(Owned { features: first..features.len(), blockers: chains, bounds: None });
        }
        let obstruction = Obstruction::new(parts, budget)?;
        for owned in &mut owned {
            budget.check(0)?;
            owned.bounds = bounds_of(&obstruction, &owned.blockers);
        }
        let layer = obstruction.grid().same_cells();
        let there = Marks::of(owned.len() - 1, true);
        let count = features.len();
        let (sectors, circles, free) =
            (Vec::with_capacity(count), Circles::default(), Vec::with_capacity(count));
        let usual_radius = Clearance { asked: scene.clearance_mm, style: scene.corner_style }.planned();
        let mut nearby = Nearby::like(&layer);
        for (owner, owned) in owned.iter().enumerate().skip(1) {
            nearby.push(owner - 1, owned.bounds.as_ref());
        }
        if scene.work_area.is_some() {
            nearby.push(WORK_AREA, None);
        }
        let spots = Vec::with_capacity(count);
        let (whole, joined) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut terrain = Self {
            obstruction,
            features,
            layer,
            sectors,
            circles,
            free,
            there,
            nearby,
            spots,
            whole,
            joined,
            usual_radius,
            owned,
        };
        for feature in 0..terrain.features.len() {
            if feature.is_multiple_of(FEATURES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            terrain.place(feature);
        }
        Ok(terrain)
    }

    /// How many features lie outside of the grid, where each is looked at always.
    pub(super) fn outside_count(&self) -> usize {
        self.layer.outside().len()
    }

    /// Adds the next obstacle.
    ///
    /// # Errors
    /// The budget ended; nothing is added.
    pub(super) fn push(
        &mut self,
        shape: &Polygon,
        clearance: Clearance,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let first = self.features.len();
        // The work area's place is the first.
        let owner = self.owned.len() - 1;
        let outlines = || Outline::of(shape, true, clearance, owner);
        for outline in outlines() {
            if let Err(interrupt) = outline.add_features(&mut self.features, budget) {
                self.features.truncate(first);
                return Err(interrupt);
            }
        }
        let blockers: Vec<_> = outlines().map(|outline| self.obstruction.push(&outline)).collect();
        let bounds = bounds_of(&self.obstruction, &blockers);
        let owned = Owned { features: first..self.features.len(), blockers, bounds };
        for feature in owned.features.clone() {
            self.place(feature);
        }
        self.there.push(true);
        self.nearby.push(owner, owned.bounds.as_ref());
        if let Some(bounds) = owned.bounds {
            self.forget_within(&bounds);
        }
        self.owned.push(owned);
        Ok(())
    }

    /// Takes an owner away; its blockers and features stay where they are, for nothing.
    pub(super) fn remove(&mut self, owner: usize) {
        self.there.set(owner, false);
        if let Some(bounds) = self.owned(owner).bounds {
            self.forget_within(&bounds);
        }
    }

    /// Brings an owner back that was taken away.
    pub(super) fn restore(&mut self, owner: usize) {
        self.there.set(owner, true);
        if let Some(bounds) = self.owned(owner).bounds {
            self.forget_within(&bounds);
        }
    }

    pub(super) fn owned(&self, owner: usize) -> &Owned {
        // The work area's owner is the largest number, which wraps round to the first place.
        &self.owned[owner.wrapping_add(1)]
    }

    /// Whether a feature's owner is there.
    pub(super) fn is_there(&self, feature: u32) -> bool {
        self.there.has(self.features[feature as usize].owner)
    }

    /// What a search looks at first of a feature.
    pub(super) fn spot(&self, feature: u32) -> &Spot {
        &self.spots[feature as usize]
    }

    /// Whether all of a feature's range is free.
    pub(super) fn is_whole(&self, feature: u32) -> bool {
        match self.whole[feature as usize].get() {
            Whole::Yes => true,
            Whole::No => false,
            Whole::Unknown => {
                let stretches = self.work_out(feature);
                let is_whole = stretches.free == [(0.0, self.features[feature as usize].sweep)];
                self.whole[feature as usize].set(if is_whole { Whole::Yes } else { Whole::No });
                if !is_whole {
                    // Kept where they say more than this.
                    self.free[feature as usize].get_or_init(|| Box::new(stretches));
                }
                is_whole
            }
        }
    }

    /// Whether a path may pass from a feature to another without a straight move.
    pub(super) fn is_joined(&self, feature: u32) -> bool {
        self.joined[feature as usize]
    }

    /// Whether nothing blocks the straight move.
    pub(super) fn is_free(&self, from: Point, to: Point) -> bool {
        if from == to {
            return true;
        }
        let mut free = true;
        self.obstruction.blocking(&Segment::new(from, to), |blocker| {
            if !self.there.has(blocker.owner) {
                return ControlFlow::Continue(());
            }
            free = false;
            ControlFlow::Break(())
        });
        free
    }

    /// Whether an owner's barrier blocks the straight move.
    pub(super) fn is_blocked_by(&self, owner: usize, from: Point, to: Point) -> bool {
        let line = traverse_geometry::Edge::Segment(Segment::new(from, to));
        let owned = self.owned(owner);
        owned.bounds.is_some_and(|bounds| bounds.meets(&Bounds::of([from, to])))
            && owned
                .blockers
                .iter()
                .any(|chain| self.obstruction.kept(chain.clone()).iter().any(|blocker| blocker.blocks(&line)))
    }

    /// Puts a feature where it can be found.
    fn place(&mut self, index: usize) {
        let feature = &self.features[index];
        let cell = self.layer.cell();
        let bounds = if feature.plan_radius < SMALL_CIRCLE * cell.x.min(cell.y) {
            Bounds::of([feature.center]).grown(feature.plan_radius)
        } else {
            Arc::from_angles(feature.center, feature.plan_radius, feature.start_angle, feature.sweep).bounds()
        };
        let Feature { center, price_radius, plan_radius, start_angle, .. } = *feature;
        self.spots.push(Spot { center, price_radius, plan_radius, start_angle });
        let mut is_joined = feature.before.is_some() || feature.after.is_some();
        for other in self.circles.near(feature) {
            if is_same_circle(feature, &self.features[other as usize]) {
                is_joined = true;
                self.joined[other as usize] = true;
            }
        }
        self.joined.push(is_joined);
        self.whole.push(Cell::new(Whole::Unknown));
        self.circles.push(feature);
        self.sectors.push(Sector::of(feature));
        self.layer.insert_box(index as u32, &bounds, 0.0);
        self.free.push(OnceCell::new());
    }

    fn work_out(&self, feature: u32) -> Stretches {
        let feature = &self.features[feature as usize];
        if feature.plan_radius == 0.0 {
            return Stretches::all(feature);
        }
        let blocked = self.obstruction.blocked_offsets(feature);
        Stretches::of(feature, blocked.filter(|&(_, _, owner)| self.there.has(owner)))
    }

    /// Forgets what was known of arcs and of points within `bounds`.
    fn forget_within(&mut self, bounds: &Bounds) {
        self.nearby.forget(bounds);
        let (free, whole) = (&mut self.free, &self.whole);
        let _ = self.layer.within(bounds, |feature| {
            free[feature as usize].take();
            whole[feature as usize].set(Whole::Unknown);
            ControlFlow::Continue(())
        });
    }
}

impl Ground for Terrain {
    fn feature(&self, feature: u32) -> &Feature {
        &self.features[feature as usize]
    }

    fn sector(&self, feature: u32) -> &Sector {
        &self.sectors[feature as usize]
    }

    fn stretches(&self, feature: u32) -> &Stretches {
        self.free[feature as usize].get_or_init(|| Box::new(self.work_out(feature)))
    }

    fn knows_stretches(&self, _feature: u32) -> bool {
        true
    }

    fn on_same_circle(&self, feature: u32) -> impl Iterator<Item = u32> {
        let near = self.circles.near(self.feature(feature));
        near.filter(move |&other| {
            other != feature && self.is_there(other) && self.is_same_circle(feature, other)
        })
    }
}

/// What the blockers of some chains reach.
fn bounds_of(obstruction: &Obstruction<'_>, chains: &[Range<usize>]) -> Option<Bounds> {
    let blockers = chains.iter().flat_map(|chain| obstruction.kept(chain.clone()));
    let bounds = blockers
        .fold(Bounds::EMPTY, |bounds, blocker| bounds.union(blocker.edge.bounds().grown(blocker.limit)));
    (!bounds.is_empty()).then_some(bounds)
}

/// The middle of a box and how far its corners lie from there.
pub(super) fn middle_and_reach(bounds: &Bounds) -> (Point, f64) {
    let half: Vector = bounds.size() / 2.0;
    (bounds.center(), half.norm())
}
