//! All barriers of a scene.

use crate::barrier::{Blocker, Clearance, Feature, Obstruction, ObstructionParts, Outline};
use crate::prepared::{ClearPoint, Nearby};
use std::ops::ControlFlow;
use traverse_geometry::{Obstacle, Point, Polygon, Scene, Segment, WORK_AREA_ID};
use traverse_solve::{Budget, Interrupt};

/// The owner of the work area's border. An obstacle's barrier is owned by the obstacle's index.
pub(crate) const WORK_AREA: usize = usize::MAX;

/// Every barrier of a scene.
pub(crate) struct Barriers<'a> {
    pub(crate) scene: &'a Scene,
    /// What blocks a move in the whole scene.
    whole: Kept<'a>,
    /// Owners that are there, and where; none: all of them.
    there: Option<(&'a Marks, &'a Nearby)>,
}

/// An obstruction of one's own, or kept elsewhere.
enum Kept<'a> {
    Here(Box<Obstruction<'a>>),
    There(&'a Obstruction<'a>),
}

/// A yes or no for every owner.
#[derive(Clone, Debug)]
pub(crate) struct Marks {
    obstacles: Vec<bool>,
    work_area: bool,
}

impl Marks {
    /// The same for all.
    pub(crate) fn of(obstacle_count: usize, mark: bool) -> Self {
        Self { obstacles: vec![mark; obstacle_count], work_area: mark }
    }

    pub(crate) fn has(&self, owner: usize) -> bool {
        self.obstacles.get(owner).copied().unwrap_or(self.work_area)
    }

    /// Adds an obstacle.
    pub(crate) fn push(&mut self, mark: bool) {
        self.obstacles.push(mark);
    }

    pub(crate) fn set(&mut self, owner: usize, mark: bool) {
        *self.obstacles.get_mut(owner).unwrap_or(&mut self.work_area) = mark;
    }
}

impl<'a> Barriers<'a> {
    /// Takes the scene's barriers apart. Cost: constant for each short ring, linear for long and mitred ones.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn new(scene: &'a Scene, budget: &Budget) -> Result<Self, Interrupt> {
        let mut parts = ObstructionParts::with_capacity(0, scene.obstacles.len() + 1);
        for owner in owners(scene) {
            budget.check(0)?;
            for outline in outlines(scene, owner) {
                parts.add(outline, budget)?;
            }
        }
        let whole = Obstruction::new(parts, budget)?;
        Ok(Self { scene, whole: Kept::Here(Box::new(whole)), there: None })
    }

    /// Barriers that were taken apart before; of the owners those that are `there`, or all.
    pub(crate) fn view(
        scene: &'a Scene,
        whole: &'a Obstruction<'a>,
        there: Option<(&'a Marks, &'a Nearby)>,
    ) -> Self {
        Self { scene, whole: Kept::There(whole), there }
    }

    fn whole(&self) -> &Obstruction<'a> {
        match &self.whole {
            Kept::Here(whole) => whole,
            Kept::There(whole) => whole,
        }
    }

    /// Shows `visit` every blocker that blocks the straight move, until it breaks off; as
    /// [`Obstruction::blocking`] does.
    pub(crate) fn blocking(&self, line: &Segment, mut visit: impl FnMut(&Blocker) -> ControlFlow<()>) {
        self.whole().blocking(line, |blocker| {
            if self.is_there(blocker.owner) { visit(blocker) } else { ControlFlow::Continue(()) }
        });
    }

    /// Every blocker that may block the straight move, and some that don't.
    pub(crate) fn near(&self, line: &Segment) -> impl Iterator<Item = Blocker> {
        self.whole().near(line).filter(|blocker| self.is_there(blocker.owner))
    }

    /// Shows `visit` every blocker that `point` lies nearer to than its limit and a `margin`, some of them more than once.
    pub(crate) fn round(&self, point: Point, margin: f64, mut visit: impl FnMut(&Blocker)) {
        self.whole().round(point, margin, |blocker| {
            if self.is_there(blocker.owner) {
                visit(blocker);
            }
        });
    }

    /// The offsets of `feature` at which the planned path would come too near to some blocker, each with its owner.
    pub(crate) fn blocked_offsets(&self, feature: &Feature) -> impl Iterator<Item = (f64, f64, usize)> {
        self.whole().blocked_offsets(feature).filter(|&(_, _, owner)| self.is_there(owner))
    }

    fn is_there(&self, owner: usize) -> bool {
        self.there.is_none_or(|(there, _)| there.has(owner))
    }

    /// Which owners are there.
    pub(crate) fn there(&self) -> Marks {
        self.there
            .map(|(there, _)| there.clone())
            .unwrap_or_else(|| Marks::of(self.scene.obstacles.len(), true))
    }

    /// Every owner: the obstacles, then the work area if there is one.
    pub(crate) fn owners(&self) -> impl Iterator<Item = usize> {
        let there = self.there;
        owners(self.scene).filter(move |&owner| there.is_none_or(|(there, _)| there.has(owner)))
    }

    /// Every owner that `point` may lie in or near, and others.
    pub(crate) fn owners_at(&self, point: Point) -> Vec<usize> {
        match self.there {
            None => {
                let mut owners = self.whole().owners_at(point);
                // Of the work area the material is what lies outside of it.
                if self.scene.work_area.is_some() && owners.last() != Some(&WORK_AREA) {
                    owners.push(WORK_AREA);
                }
                owners
            }
            Some((there, nearby)) => {
                let mut owners = nearby.owners_at(point);
                owners.retain(|&owner| there.has(owner));
                owners
            }
        }
    }

    /// Whether `point` is known, at constant cost, to lie clear of every barrier: nothing lies between it and the clear point of
    /// its cell. `is_clear` tells whether a middle is one, once for each.
    pub(crate) fn is_known_clear(&self, point: Point, is_clear: impl FnOnce(Point) -> Option<bool>) -> bool {
        let Some((_, nearby)) = self.there else { return false };
        if nearby.was_clear(point) {
            return true;
        }
        let Some((middle, known)) = nearby.cell_of(point) else { return false };
        if let ClearPoint::Unknown = known.get() {
            match is_clear(middle) {
                Some(true) => known.set(ClearPoint::At(middle)),
                Some(false) => known.set(ClearPoint::None),
                None => return false,
            }
        }
        let ClearPoint::At(clear) = known.get() else { return false };
        let mut is_free = true;
        self.blocking(&Segment::new(point, clear), |_| {
            is_free = false;
            ControlFlow::Break(())
        });
        if is_free {
            nearby.note_clear(point);
        }
        is_free
    }

    /// Takes note that nothing blocks `point` and that it lies in no barrier, so that others near it are known to be clear.
    pub(crate) fn note_clear(&self, point: Point) {
        if let Some((_, nearby)) = self.there {
            nearby.note_clear(point);
        }
    }

    /// The obstacle; none for the work area.
    pub(crate) fn obstacle(&self, owner: usize) -> Option<&'a Obstacle> {
        self.scene.obstacles.get(owner)
    }

    /// What the owner covers; for the work area, what it leaves free.
    pub(crate) fn shape(&self, owner: usize) -> Option<&'a Polygon> {
        self.obstacle(owner).map(|obstacle| &obstacle.shape).or(self.scene.work_area.as_ref())
    }

    /// The obstacle's id, or [`WORK_AREA_ID`].
    pub(crate) fn id(&self, owner: usize) -> &'a str {
        self.obstacle(owner).map_or(WORK_AREA_ID, |obstacle| &obstacle.id)
    }

    /// The clearance kept from an owner.
    pub(crate) fn clearance(&self, owner: usize) -> Clearance {
        clearance(self.scene, owner)
    }

    /// The owner's rings, each with its clearance.
    pub(crate) fn outlines(&self, owner: usize) -> impl Iterator<Item = Outline<'a>> {
        outlines(self.scene, owner)
    }
}

/// Every owner of a scene: the obstacles, then the work area if there is one.
fn owners(scene: &Scene) -> impl Iterator<Item = usize> {
    (0..scene.obstacles.len()).chain(scene.work_area.as_ref().map(|_| WORK_AREA))
}

fn clearance(scene: &Scene, owner: usize) -> Clearance {
    let asked = match scene.obstacles.get(owner) {
        Some(obstacle) => scene.clearance_of(obstacle),
        None => scene.border_clearance(),
    };
    Clearance { asked, style: scene.corner_style }
}

/// The rings of an owner in a scene, with the material on the left, each with its clearance.
pub(crate) fn outlines(scene: &Scene, owner: usize) -> impl Iterator<Item = Outline<'_>> {
    let clearance = clearance(scene, owner);
    let obstacle = scene.obstacles.get(owner).map(|obstacle| &obstacle.shape);
    let shape = obstacle.or(scene.work_area.as_ref()).into_iter();
    shape.flat_map(move |shape| Outline::of(shape, obstacle.is_some(), clearance, owner))
}
