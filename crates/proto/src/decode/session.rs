//! Steps of PlanRapidMoves.

use super::reader::Reader;
use super::shape::wire_vertices;
use crate::limits::ID_BYTES;
use crate::text::shortened;
use crate::{Limits, Refused, v1};
use prost::Message;
use std::collections::HashMap;
use std::time::Duration;
use traverse_geometry::{Finding, Polygon, Reason, Scene};
use traverse_planner::{PreparedScene, RapidMove, SceneEdit};
use traverse_solve::Budget;

/// A query of a session, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct StepQuestion {
    /// From where to where, and how.
    pub query: RapidMove,
    /// Stop after this many expanded nodes. Absent: no limit.
    pub iteration_limit: Option<u64>,
    /// Stop after this long. Absent: the server's default.
    pub time_limit: Option<Duration>,
}

impl StepQuestion {
    /// Reads and validates a query.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(query: v1::RapidQuery, limits: &Limits, budget: &Budget) -> Result<Self, Refused> {
        let time_limit = super::rules_time_limit(query.rules.as_ref());
        let mut reader = Reader::new(limits, budget);
        let read = reader.rapid_move("query.", query.start, query.target, query.rules);
        let read = read.map(|(query, iteration_limit)| Self { query, iteration_limit, time_limit });
        reader.finish(read)
    }
}

/// Reads and validates a session's scene.
///
/// # Errors
/// Every finding at once; or that the budget ended.
pub fn scene_from_wire(scene: v1::Scene, limits: &Limits, budget: &Budget) -> Result<Scene, Refused> {
    let mut reader = Reader::new(limits, budget);
    reader.scene_fits("scene", &scene);
    reader.so_far()?;
    let scene = reader.scene("scene", Some(scene));
    reader.finish(scene)
}

/// Reads an edit and validates it against the scene that it changes.
///
/// # Errors
/// Every finding at once; or that the budget ended.
pub fn edit_from_wire(
    edit: v1::EditScene,
    scene: &PreparedScene,
    limits: &Limits,
    budget: &Budget,
) -> Result<SceneEdit, Refused> {
    let mut reader = Reader::new(limits, budget);
    let v1::EditScene { put_obstacles, remove_obstacle_ids } = edit;
    reader.at_most("edit.put_obstacles", "obstacles", put_obstacles.len(), limits.obstacle_count);
    reader.at_most("edit.remove_obstacle_ids", "ids", remove_obstacle_ids.len(), limits.obstacle_count);
    let shapes = put_obstacles.iter().filter_map(|obstacle| obstacle.shape.as_ref());
    let vertices: usize = shapes.map(wire_vertices).sum();
    reader.at_most("edit.put_obstacles", "vertices", vertices, limits.vertex_count);
    reader.so_far()?;
    let put_first: HashMap<String, usize> =
        put_obstacles.iter().enumerate().rev().map(|(at, obstacle)| (obstacle.id.clone(), at)).collect();
    let size = Size { obstacles: scene.obstacle_count(), vertices: scene.vertex_count() };
    let size = size.put(scene, put_first.keys()).removed(scene, &remove_obstacle_ids, &put_first);
    let put = reader.obstacles("edit.put_obstacles", put_obstacles);
    reader.removed_ids("edit.remove_obstacle_ids", &remove_obstacle_ids, &put_first, scene);
    let field = "edit.put_obstacles";
    reader.at_most(field, "obstacles in the whole scene", size.obstacles, limits.obstacle_count);
    reader.at_most(field, "vertices in the whole scene", size.vertices + vertices, limits.vertex_count);
    reader.finish(put.map(|put| SceneEdit { put, remove: remove_obstacle_ids }))
}

/// How large a scene is; of obstacles that are put only their number.
struct Size {
    obstacles: usize,
    vertices: usize,
}

impl Size {
    fn without(self, scene: &PreparedScene, id: &str) -> Self {
        let Some(obstacle) = scene.obstacle(id) else { return self };
        let vertices = Polygon::vertex_count(&obstacle.shape);
        Self { obstacles: self.obstacles - 1, vertices: self.vertices - vertices }
    }

    fn put<'a>(self, scene: &PreparedScene, ids: impl Iterator<Item = &'a String>) -> Self {
        ids.fold(self, |size, id| {
            let size = size.without(scene, id);
            Self { obstacles: size.obstacles + 1, ..size }
        })
    }

    fn removed(self, scene: &PreparedScene, ids: &[String], put: &HashMap<String, usize>) -> Self {
        let mut seen = std::collections::HashSet::new();
        let removed = ids.iter().filter(|id| !put.contains_key(*id) && seen.insert(id.as_str()));
        removed.fold(self, |size, id| size.without(scene, id))
    }
}

impl Reader<'_> {
    /// Ids to remove: each is there, once, and is not put in the same edit.
    fn removed_ids(
        &mut self,
        list: &str,
        ids: &[String],
        put_first: &HashMap<String, usize>,
        scene: &PreparedScene,
    ) {
        let mut first_with: HashMap<&str, usize> = HashMap::new();
        for (index, id) in ids.iter().enumerate() {
            let field = || format!("{list}[{index}]");
            if id.is_empty() {
                self.missing(&field(), "the id of an obstacle that is there");
            } else if let Some(put) = put_first.get(id) {
                let message = format!(
                    "{} is put by put_obstacles[{put}] of the same edit; send it once",
                    shortened(id, 100)
                );
                self.report(Finding::new(field(), Reason::DuplicateId, shortened(id, ID_BYTES), message));
            } else if let Some(first) = first_with.get(id.as_str()) {
                let message = format!(
                    "{} is removed by remove_obstacle_ids[{first}] already; send each id once",
                    shortened(id, 100)
                );
                self.report(Finding::new(field(), Reason::DuplicateId, shortened(id, ID_BYTES), message));
            } else if scene.obstacle(id).is_none() {
                let message = format!(
                    "there is no obstacle {} in the scene; send the id of one that is there",
                    shortened(id, 100)
                );
                self.report(Finding::new(field(), Reason::UnknownId, shortened(id, ID_BYTES), message));
            }
            first_with.entry(id).or_insert(index);
        }
    }
}

/// What a step's name is read from when the step itself can't be: every field but the name is passed over.
#[derive(Clone, PartialEq, prost::Message)]
struct Named {
    #[prost(string, tag = "1")]
    step_id: String,
}

/// The name of an encoded step, as far as it can be read; empty otherwise. Cut to the length that a name may have.
#[must_use]
pub fn step_id_of(step: &[u8]) -> String {
    Named::decode(step).map_or_else(|_| String::new(), |named| shortened(&named.step_id, ID_BYTES))
}
