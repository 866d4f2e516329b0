//! Many changes of a prepared scene at once: all of them or none.

use super::{EditRefusal, PreparedScene};
use rustc_hash::FxHashMap;
use traverse_geometry::{Obstacle, Scene};
use traverse_solve::Budget;

/// An edit that puts more obstacles than this, and more than one for so many that are there, takes the scene apart anew: that
/// costs less than putting each, and the grid fits what is there.
const FEW_PUT: usize = 256;
const MANY_PUT: usize = 8;

/// The same for their vertices: what is put into a scene in place can't be interrupted.
const FEW_VERTICES: usize = 16_384;

/// Changes of a scene that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneEdit {
    /// Valid obstacles to add, or to put in the place of those with the same ids.
    pub put: Vec<Obstacle>,
    /// Ids of obstacles to remove after that; each is there.
    pub remove: Vec<String>,
}

/// A change that was made, as far as it takes to undo it.
enum Done {
    Put { id: String, replaced: Option<usize> },
    Removed { id: String, place: usize },
}

impl PreparedScene {
    /// Makes all changes. Cost: about linear in the vertices that are put; now and then the scene is taken apart anew.
    ///
    /// # Errors
    /// There is no obstacle of an id to remove, or the budget ended; the scene is as it was.
    pub fn edit(&mut self, edit: SceneEdit, budget: &Budget) -> Result<(), EditRefusal> {
        let vertices: usize = edit.put.iter().map(|obstacle| obstacle.shape.vertex_count()).sum();
        if edit.put.len() > FEW_PUT.max(self.obstacle_count() / MANY_PUT)
            || vertices > FEW_VERTICES.max(self.vertex_count() / MANY_PUT)
        {
            return self.edit_anew(edit, budget);
        }
        let mut done = Vec::with_capacity(edit.put.len() + edit.remove.len());
        for obstacle in edit.put {
            let id = obstacle.id.clone();
            let replaced = self.places.get(&id).copied();
            if let Err(refusal) = self.put(obstacle, budget) {
                self.undo(done);
                return Err(refusal);
            }
            done.push(Done::Put { id, replaced });
        }
        for id in edit.remove {
            let place = self.places.get(&id).copied();
            if let Err(refusal) = self.remove_obstacle(&id) {
                self.undo(done);
                return Err(refusal);
            }
            done.extend(place.map(|place| Done::Removed { id, place }));
        }
        self.tidy(budget);
        Ok(())
    }

    /// Takes the changed scene apart as a whole.
    fn edit_anew(&mut self, edit: SceneEdit, budget: &Budget) -> Result<(), EditRefusal> {
        let scene = self.scene_now();
        let mut obstacles: Vec<Option<Obstacle>> = scene.obstacles.into_iter().map(Some).collect();
        let ids = obstacles.iter().flatten().map(|obstacle| obstacle.id.clone());
        let mut places: FxHashMap<String, usize> = ids.zip(0..).collect();
        for obstacle in edit.put {
            if let Some(replaced) = places.insert(obstacle.id.clone(), obstacles.len()) {
                obstacles[replaced] = None;
            }
            obstacles.push(Some(obstacle));
        }
        for id in edit.remove {
            let Some(place) = places.remove(&id) else { return Err(EditRefusal::UnknownObstacle { id }) };
            obstacles[place] = None;
        }
        let scene = Scene { obstacles: obstacles.into_iter().flatten().collect(), ..scene };
        *self = Self::keeping(scene, self.sights.links_kept(), budget).map_err(EditRefusal::Interrupted)?;
        Ok(())
    }

    /// Undoes changes, the last one first.
    fn undo(&mut self, done: Vec<Done>) {
        for change in done.into_iter().rev() {
            match change {
                Done::Put { id, replaced } => {
                    if let Some(place) = self.places.remove(&id) {
                        self.take_away(place);
                    }
                    if let Some(place) = replaced {
                        self.bring_back(place);
                        self.places.insert(id, place);
                    }
                }
                Done::Removed { id, place } => {
                    self.bring_back(place);
                    self.places.insert(id, place);
                }
            }
        }
    }
}
