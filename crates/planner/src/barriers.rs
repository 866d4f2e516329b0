//! All barriers of a scene.

use crate::barrier::{Clearance, Obstruction, Outline};
use std::borrow::Cow;
use traverse_geometry::{Polygon, Ring, Scene, WORK_AREA_ID};
use traverse_solve::{Budget, Interrupt};

/// Every barrier of a scene, by owner: the index of the obstacle, or the count of obstacles for the work area.
pub(crate) struct Barriers<'a> {
    pub(crate) scene: &'a Scene,
    /// Per owner its rings with the material on the left.
    rings: Vec<Vec<Cow<'a, Ring>>>,
    /// What blocks a move in the whole scene.
    pub(crate) whole: Obstruction,
}

impl<'a> Barriers<'a> {
    /// Takes the scene's barriers apart. Cost: linear.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn new(scene: &'a Scene, budget: &Budget) -> Result<Self, Interrupt> {
        let obstacles = scene.obstacles.iter().map(|obstacle| material_left(&obstacle.shape, true));
        let border = scene.work_area.iter().map(|area| material_left(area, false));
        let rings = obstacles.chain(border).collect();
        let whole = Obstruction::new(Vec::new(), &[], budget)?;
        let mut barriers = Self { scene, rings, whole };
        let (mut blockers, mut ends) = (Vec::new(), Vec::new());
        for owner in 0..barriers.owner_count() {
            budget.check(0)?;
            for outline in barriers.outlines(owner) {
                outline.add_blockers(&mut blockers);
                ends.push(blockers.len());
            }
        }
        barriers.whole = Obstruction::new(blockers, &ends, budget)?;
        Ok(barriers)
    }

    /// Count of obstacles, and one for the work area if there is one.
    pub(crate) fn owner_count(&self) -> usize {
        self.rings.len()
    }

    /// The obstacle's id, or [`WORK_AREA_ID`].
    pub(crate) fn id(&self, owner: usize) -> &'a str {
        self.scene.obstacles.get(owner).map_or(WORK_AREA_ID, |obstacle| &obstacle.id)
    }

    /// The clearance kept from an owner.
    pub(crate) fn clearance(&self, owner: usize) -> Clearance {
        let asked = match self.scene.obstacles.get(owner) {
            Some(obstacle) => self.scene.clearance_of(obstacle),
            None => self.scene.border_clearance(),
        };
        Clearance { asked, style: self.scene.corner_style }
    }

    /// The owner's rings, each with its clearance.
    pub(crate) fn outlines(&self, owner: usize) -> impl Iterator<Item = Outline<'_>> {
        let clearance = self.clearance(owner);
        self.rings[owner].iter().map(move |ring| Outline { ring, clearance, owner })
    }
}

/// The polygon's rings with the material on the left: inside it, or outside.
fn material_left(polygon: &Polygon, inside: bool) -> Vec<Cow<'_, Ring>> {
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
