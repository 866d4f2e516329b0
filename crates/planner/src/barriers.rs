//! All barriers of a scene.

use crate::barrier::{Clearance, Obstruction, Outline};
use std::borrow::Cow;
use traverse_geometry::{Obstacle, Polygon, Ring, Scene, WORK_AREA_ID};
use traverse_solve::{Budget, Interrupt};

/// The owner of the work area's border. An obstacle's barrier is owned by the obstacle's index.
pub(crate) const WORK_AREA: usize = usize::MAX;

/// The rings of one owner, with the material on the left.
pub(crate) type Rings<'a> = Vec<Cow<'a, Ring>>;

/// Every barrier of a scene.
pub(crate) struct Barriers<'a> {
    pub(crate) scene: &'a Scene,
    /// Per obstacle, and of the work area.
    obstacles: Vec<Rings<'a>>,
    work_area: Rings<'a>,
    /// What blocks a move in the whole scene.
    pub(crate) whole: Obstruction,
}

impl<'a> Barriers<'a> {
    /// Takes the scene's barriers apart. Cost: linear.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn new(scene: &'a Scene, budget: &Budget) -> Result<Self, Interrupt> {
        let obstacles = scene.obstacles.iter().map(|obstacle| material_left(&obstacle.shape, true)).collect();
        let work_area = scene.work_area.iter().flat_map(|area| material_left(area, false)).collect();
        let mut barriers = Self { scene, obstacles, work_area, whole: Obstruction::default() };
        let (mut blockers, mut ends) = (Vec::new(), Vec::new());
        for owner in barriers.owners() {
            budget.check(0)?;
            for outline in barriers.outlines(owner) {
                outline.add_blockers(&mut blockers);
                ends.push(blockers.len());
            }
        }
        barriers.whole = Obstruction::new(blockers, &ends, budget)?;
        Ok(barriers)
    }

    /// Every owner: the obstacles, then the work area if there is one.
    pub(crate) fn owners(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.obstacles.len()).chain((!self.work_area.is_empty()).then_some(WORK_AREA))
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
        let rings = self.obstacles.get(owner).unwrap_or(&self.work_area);
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
