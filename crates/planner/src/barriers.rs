//! All barriers of a scene.

use crate::barrier::{Blocker, Clearance, Feature, Obstruction, Outline};
use crate::prepared::Nearby;
use std::borrow::Cow;
use std::ops::ControlFlow;
use traverse_geometry::{Obstacle, Point, Polygon, Ring, Scene, Segment, WORK_AREA_ID};
use traverse_solve::{Budget, Interrupt};

/// The owner of the work area's border. An obstacle's barrier is owned by the obstacle's index.
pub(crate) const WORK_AREA: usize = usize::MAX;

/// The rings of one owner, with the material on the left.
pub(crate) type Rings<'a> = Vec<Cow<'a, Ring>>;

/// Every barrier of a scene.
pub(crate) struct Barriers<'a> {
    pub(crate) scene: &'a Scene,
    parts: Kept<'a>,
    /// Owners that are there, and where; none: all of them.
    there: Option<(&'a Marks, &'a Nearby)>,
}

/// What barriers are made of.
#[derive(Default)]
pub(crate) struct Parts<'a> {
    /// Per obstacle, and of the work area.
    pub(crate) obstacles: Vec<Rings<'a>>,
    pub(crate) work_area: Rings<'a>,
    /// What blocks a move in the whole scene.
    pub(crate) whole: Obstruction,
}

/// Parts of one's own, or kept elsewhere.
enum Kept<'a> {
    Here(Box<Parts<'a>>),
    There(&'a Parts<'a>),
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
    /// Takes the scene's barriers apart. Cost: linear.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn new(scene: &'a Scene, budget: &Budget) -> Result<Self, Interrupt> {
        let obstacles = scene.obstacles.iter().map(|obstacle| material_left(&obstacle.shape, true)).collect();
        let work_area = scene.work_area.iter().flat_map(|area| material_left(area, false)).collect();
        let mut parts = Parts { obstacles, work_area, whole: Obstruction::default() };
        let barriers = Barriers::view(scene, &parts, None);
        let (mut blockers, mut ends) = (Vec::with_capacity(scene.vertex_count()), Vec::new());
        for owner in barriers.owners() {
            budget.check(0)?;
            for outline in barriers.outlines(owner) {
                outline.add_blockers(&mut blockers);
                ends.push(blockers.len());
            }
        }
        parts.whole = Obstruction::new(blockers, &ends, budget)?;
        Ok(Self { scene, parts: Kept::Here(Box::new(parts)), there: None })
    }

    /// Barriers that were taken apart before; of the owners those that are `there`, or all.
    pub(crate) fn view(
        scene: &'a Scene,
        parts: &'a Parts<'a>,
        there: Option<(&'a Marks, &'a Nearby)>,
    ) -> Self {
        Self { scene, parts: Kept::There(parts), there }
    }

    fn parts(&self) -> &Parts<'a> {
        match &self.parts {
            Kept::Here(parts) => parts,
            Kept::There(parts) => parts,
        }
    }

    /// Shows `visit` every blocker that blocks the straight move, until it breaks off; as
    /// [`Obstruction::blocking`] does.
    pub(crate) fn blocking(&self, line: &Segment, mut visit: impl FnMut(&Blocker) -> ControlFlow<()>) {
        self.parts().whole.blocking(line, |blocker| {
            if self.is_there(blocker.owner) { visit(blocker) } else { ControlFlow::Continue(()) }
        });
    }

    /// Every blocker that may block the straight move, and some that don't.
    pub(crate) fn near(&self, line: &Segment) -> impl Iterator<Item = &Blocker> {
        self.parts().whole.near(line).filter(|blocker| self.is_there(blocker.owner))
    }

    /// Shows `visit` every blocker that `point` lies nearer to than its limit and a `margin`, some of them more than once.
    pub(crate) fn round(&self, point: Point, margin: f64, mut visit: impl FnMut(&Blocker)) {
        self.parts().whole.round(point, margin, |blocker| {
            if self.is_there(blocker.owner) {
                visit(blocker);
            }
        });
    }

    /// The offsets of `feature` at which the planned path would come too near to some blocker, each with its owner.
    pub(crate) fn blocked_offsets(&self, feature: &Feature) -> impl Iterator<Item = (f64, f64, usize)> {
        self.parts().whole.blocked_offsets(feature).filter(|&(_, _, owner)| self.is_there(owner))
    }

    fn is_there(&self, owner: usize) -> bool {
        self.there.is_none_or(|(there, _)| there.has(owner))
    }

    /// Which owners are there.
    pub(crate) fn there(&self) -> Marks {
        self.there
            .map(|(there, _)| there.clone())
            .unwrap_or_else(|| Marks::of(self.parts().obstacles.len(), true))
    }

    /// Every owner: the obstacles, then the work area if there is one.
    pub(crate) fn owners(&self) -> impl Iterator<Item = usize> {
        let there = self.there;
        let parts = self.parts();
        let all = (0..parts.obstacles.len()).chain((!parts.work_area.is_empty()).then_some(WORK_AREA));
        all.filter(move |&owner| there.is_none_or(|(there, _)| there.has(owner)))
    }

    /// Every owner that `point` may lie in or near, and others.
    pub(crate) fn owners_at(&self, point: Point) -> Vec<usize> {
        match self.there {
            None => self.owners().collect(),
            Some((there, nearby)) => {
                let mut owners = nearby.owners_at(point);
                owners.retain(|&owner| there.has(owner));
                owners
            }
        }
    }

    /// Whether `point` is known, at constant cost, to lie clear of every barrier: nothing lies between it and the middle of
    /// its cell, which does. `is_clear` tells whether a middle does, once for each.
    pub(crate) fn is_known_clear(&self, point: Point, is_clear: impl FnOnce(Point) -> Option<bool>) -> bool {
        let Some((_, nearby)) = self.there else { return false };
        if nearby.was_clear(point) {
            return true;
        }
        let Some((middle, known)) = nearby.middle_of(point) else { return false };
        if known.get().is_none() {
            known.set(is_clear(middle));
        }
        let mut is_free = known.get() == Some(true);
        if is_free {
            self.blocking(&Segment::new(point, middle), |_| {
                is_free = false;
                ControlFlow::Break(())
            });
        }
        if is_free {
            nearby.note_clear(point);
        }
        is_free
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
        let asked = match self.obstacle(owner) {
            Some(obstacle) => self.scene.clearance_of(obstacle),
            None => self.scene.border_clearance(),
        };
        Clearance { asked, style: self.scene.corner_style }
    }

    /// The owner's rings, each with its clearance.
    pub(crate) fn outlines(&self, owner: usize) -> impl Iterator<Item = Outline<'_>> {
        let clearance = self.clearance(owner);
        let parts = self.parts();
        let rings = parts.obstacles.get(owner).unwrap_or(&parts.work_area);
        rings.iter().map(move |ring| Outline { ring, clearance, owner })
    }
}

/// The polygon's rings with the material on the left: inside it, or outside.
pub(crate) fn material_left(polygon: &Polygon, inside: bool) -> Rings<'_> {
    polygon
        .rings()
        .enumerate()
        .map(|(index, ring)| {
            let counter_clockwise = (index == 0) == inside;
            if ring.is_counter_clockwise() == counter_clockwise {
                Cow::Borrowed(ring)
            } else {
                Cow::Owned(ring.reversed())
            }
        })
        .collect()
}
