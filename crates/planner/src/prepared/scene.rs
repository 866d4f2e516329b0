//! A scene that is kept for many rapid moves and may change between them.

use super::along_links::{AlongLinks, Room};
use super::horizon::Horizon;
use super::mesh::Mesh;
use super::mesh_kept::MeshKept;
use super::sights::{EditKind, LINKS_KEPT, Sights};
use super::terrain::Terrain;
use crate::barrier::Clearance;
use crate::barriers::Barriers;
use crate::rapid_move::{Asked, plan_among, with_feasible_clearance};
use crate::search::{End, Route};
use crate::shortest_route::{MeetingBarriers, ShortestRoute};
use crate::trace::trace;
use crate::{Algorithm, Answer, RapidMove, Refusal, Stats};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use traverse_geometry::{Obstacle, Scene};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

/// The start's horizon is made of what stands within so many cells.
const HORIZON_CELLS: i64 = 3;

/// Vertices of obstacles that are gone may always be kept up to this count; beyond, up to as many as are there. Of one obstacle
/// that is put again and again, all lie in the same place: a small scene is taken apart anew sooner than it looks through those.
const GONE_VERTICES: usize = 128;

/// So many corners may always lie outside of the grid, which was made for the scene as it was at first; beyond, up to half.
const OUTSIDE_FEATURES: usize = 512;

/// A scene that is kept for many rapid moves and may change between them.
///
/// Answers equal those of [`crate::plan_rapid_move`] in a fresh scene. Preparing costs about as much as one plan; what
/// can be seen from where is worked out as queries come by it and kept: later queries are faster. Memory grows with what
/// was seen, about 32 bytes for each pair of corners that see each other along a tangent; at a million of them (32 MB) all
/// are forgotten.
pub struct PreparedScene {
    /// Obstacles that are gone keep their place.
    pub(super) scene: Scene,
    /// Place of each obstacle that is there.
    pub(super) places: FxHashMap<String, usize>,
    pub(super) terrain: Terrain,
    pub(super) sights: Sights,
    room: Room,
    pub(super) mesh: MeshKept,
    /// Vertices of what is there, and of what is gone and still kept.
    vertex_count: usize,
    gone_vertex_count: usize,
}

/// Why an edit was refused. The scene is as it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EditRefusal {
    /// There is no obstacle of this id to remove.
    #[error("there is no obstacle {id:?} to remove")]
    UnknownObstacle {
        /// The id.
        id: String,
    },
    /// The budget ended.
    #[error("stopped before the edit was done")]
    Interrupted(Interrupt),
}

impl PreparedScene {
    /// Takes a valid scene apart. Cost: linear.
    ///
    /// # Errors
    /// The budget ended.
    pub fn new(scene: Scene, budget: &Budget) -> Result<Self, Interrupt> {
        Self::keeping(scene, LINKS_KEPT, budget)
    }

    /// The same, but of what was seen about `links_kept` tangents are kept.
    pub(crate) fn keeping(scene: Scene, links_kept: usize, budget: &Budget) -> Result<Self, Interrupt> {
        let terrain = Terrain::new(&scene, budget)?;
        let ids = scene.obstacles.iter().enumerate();
        let places = ids.map(|(place, obstacle)| (obstacle.id.clone(), place)).collect();
        let vertex_count = scene.vertex_count();
        let (sights, room, mesh) = (Sights::keeping(links_kept), Room::default(), MeshKept::default());
        Ok(Self { scene, places, terrain, sights, room, mesh, vertex_count, gone_vertex_count: 0 })
    }

    /// How many obstacles there are.
    #[must_use]
    pub fn obstacle_count(&self) -> usize {
        self.places.len()
    }

    /// How many vertices obstacles and work area have.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// How many vertices are kept, those of obstacles that are gone included: memory grows with them.
    #[must_use]
    pub fn kept_vertex_count(&self) -> usize {
        self.vertex_count + self.gone_vertex_count
    }

    /// The obstacle `id`, if it is there.
    #[must_use]
    pub fn obstacle(&self, id: &str) -> Option<&Obstacle> {
        self.scene.obstacles.get(*self.places.get(id)?)
    }

    /// How many tangents between corners are kept.
    #[must_use]
    pub fn link_count(&self) -> usize {
        self.sights.link_count()
    }

    /// Adds a valid obstacle, or replaces the one with the same id. Cost: about linear in its vertices.
    ///
    /// # Errors
    /// The budget ended; the scene is as it was.
    pub fn put_obstacle(&mut self, obstacle: Obstacle, budget: &Budget) -> Result<(), EditRefusal> {
        self.tidy(budget);
        self.put(obstacle, budget)
    }

    pub(super) fn put(&mut self, obstacle: Obstacle, budget: &Budget) -> Result<(), EditRefusal> {
        budget.check(0).map_err(EditRefusal::Interrupted)?;
        let replaced = self.places.get(&obstacle.id).copied();
        let place = self.scene.obstacles.len();
        let asked = self.scene.clearance_of(&obstacle);
        let clearance = Clearance { asked, style: self.scene.corner_style };
        let added = self.terrain.push(&obstacle.shape, clearance, budget);
        added.map_err(EditRefusal::Interrupted)?;
        self.places.insert(obstacle.id.clone(), place);
        self.vertex_count += obstacle.shape.vertex_count();
        self.scene.obstacles.push(obstacle);
        self.mesh.note_added(self.terrain.owned(place).features.clone());
        self.sights.note(&self.terrain, place, EditKind::Added);
        if let Some(place) = replaced {
            self.take_away(place);
        }
        Ok(())
    }

    /// Removes the obstacle `id`. Cost: about constant.
    ///
    /// # Errors
    /// There is none of this id; the scene is as it was.
    pub fn remove_obstacle(&mut self, id: &str) -> Result<(), EditRefusal> {
        let Some(place) = self.places.remove(id) else {
            return Err(EditRefusal::UnknownObstacle { id: id.to_owned() });
        };
        self.take_away(place);
        Ok(())
    }

    pub(super) fn take_away(&mut self, place: usize) {
        let vertices = self.scene.obstacles[place].shape.vertex_count();
        self.vertex_count -= vertices;
        self.gone_vertex_count += vertices;
        self.terrain.remove(place);
        self.mesh.note_edit();
        self.sights.note(&self.terrain, place, EditKind::Removed);
    }

    /// Triangulates the scene now, which otherwise happens when many queries were asked without an edit between: later
    /// queries are faster, their answers the same. Of no effect where there are arcs or mitred barriers. Cost: about n log n.
    ///
    /// # Errors
    /// The budget ended; the scene is as it was.
    pub fn triangulate(&mut self, budget: &Budget) -> Result<(), Interrupt> {
        self.tidy(budget);
        let Self { scene, terrain, mesh, .. } = self;
        let barriers = Barriers::view(scene, &terrain.obstruction, Some((&terrain.there, &terrain.nearby)));
        mesh.make(terrain, &barriers, budget)
    }

    /// Plans one rapid move; as [`crate::plan_rapid_move`] would in the scene as it is now.
    ///
    /// # Errors
    /// As there.
    pub fn plan(
        &mut self,
        query: &RapidMove,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        if !query.rules.clearances_mm.is_empty() || query.algorithm == Algorithm::SupportingLines {
            // What is kept is of no use at another clearance.
            return crate::plan_rapid_move(&self.scene_now(), query, budget, observer);
        }
        let (answer, mut stats) = self.plan_at_its_clearance(query, budget, observer)?;
        if let Answer::Plan(_) = answer {
            return Ok((answer, stats));
        }
        let answer = with_feasible_clearance(answer, &self.scene_now(), query, true, budget, &mut stats);
        Ok((answer, stats))
    }

    /// Plans one rapid move that may have no other clearance than the scene's, by the exact algorithm; where there is no path,
    /// says nothing of other clearances.
    ///
    /// # Errors
    /// As [`crate::plan_rapid_move`].
    pub(crate) fn plan_at_its_clearance(
        &mut self,
        query: &RapidMove,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        self.tidy(budget);
        let Self { scene, terrain, sights, room, mesh, .. } = self;
        let barriers = Barriers::view(scene, &terrain.obstruction, Some((&terrain.there, &terrain.nearby)));
        mesh.note_query(terrain, &barriers, budget);
        let mut along = AlongSights { terrain, mesh: mesh.get(), sights, room };
        let mut stats = Stats::default();
        let asked = Asked { barriers: &barriers, query, is_last: true, budget };
        let answer = plan_among(asked, &mut along, &mut stats, observer)?;
        Ok((answer, stats))
    }

    /// The shortest route between two ends, and a cost that no route is below.
    pub(super) fn route_between(
        &mut self,
        ends: [&End; 2],
        budget: &Budget,
        stats: &mut Stats,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64) {
        let Self { scene, terrain, sights, room, mesh, .. } = self;
        let barriers = Barriers::view(scene, &terrain.obstruction, Some((&terrain.there, &terrain.nearby)));
        mesh.note_query(terrain, &barriers, budget);
        let mut along = AlongSights { terrain, mesh: mesh.get(), sights, room };
        along.shortest(&barriers, &BTreeSet::new(), ends, stats, budget, observer)
    }

    /// What the shortest way between two ends costs, millimetres; infinity where there is none.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn cost_between(
        &mut self,
        ends: [&End; 2],
        budget: &Budget,
        stats: &mut Stats,
    ) -> Result<f64, Interrupt> {
        let route = self.route_between(ends, budget, stats, &mut Silent).0?;
        Ok(route.map_or(f64::INFINITY, |route| trace(&route, ends[0].point, ends[1].point).length()))
    }

    /// How many corners and arcs barriers have, those that are gone included.
    pub(crate) fn feature_count(&self) -> usize {
        self.terrain.features.len()
    }

    /// The scene as it is now.
    pub(super) fn scene_now(&self) -> Scene {
        let mut scene = self.scene.clone();
        let mut place = 0..;
        scene.obstacles.retain(|_| place.next().is_some_and(|place| self.terrain.there.has(place)));
        scene
    }

    /// Brings back an obstacle that was taken away.
    pub(super) fn bring_back(&mut self, place: usize) {
        let vertices = self.scene.obstacles[place].shape.vertex_count();
        self.vertex_count += vertices;
        self.gone_vertex_count -= vertices;
        self.terrain.restore(place);
        self.sights.note(&self.terrain, place, EditKind::Added);
    }

    /// Takes the scene apart anew when most of what is kept is gone, or lies outside of the grid. Cost: about constant per
    /// edit.
    pub(super) fn tidy(&mut self, budget: &Budget) {
        let is_outside = self.terrain.outside_count() > OUTSIDE_FEATURES.max(self.terrain.features.len() / 2);
        if self.gone_vertex_count <= self.vertex_count.max(GONE_VERTICES) && !is_outside {
            return;
        }
        // A scene that is not tidied answers the same, only slower.
        if let Ok(tidy) = Self::keeping(self.scene_now(), self.sights.links_kept(), budget) {
            *self = tidy;
        }
    }

    pub(crate) fn barriers(&self) -> Barriers<'_> {
        Barriers::view(
            &self.scene,
            &self.terrain.obstruction,
            Some((&self.terrain.there, &self.terrain.nearby)),
        )
    }
}

/// The shortest route along what can be seen.
struct AlongSights<'a> {
    terrain: &'a Terrain,
    mesh: Option<&'a Mesh>,
    sights: &'a mut Sights,
    room: &'a mut Room,
}

impl ShortestRoute for AlongSights<'_> {
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        left_out: &BTreeSet<usize>,
        [start, target]: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64) {
        if !left_out.is_empty() {
            // What is kept is of no use where less stands in the way.
            let ends = [start, target];
            return MeetingBarriers.shortest(barriers, left_out, ends, stats, budget, observer);
        }
        let mut search = AlongLinks::new(self.terrain, self.mesh, self.sights, [start, target], self.room);
        let found = search.run(budget, &mut stats.expanded_nodes, observer);
        if matches!(found, Err(Interrupt::Memory)) {
            // Among slivers, links lead to more labels than a search of the whole scene needs.
            return MeetingBarriers.shortest(barriers, left_out, [start, target], stats, budget, observer);
        }
        (found, search.lower_bound)
    }
}

/// The horizon round a point, from what stands nearest to it.
pub(super) fn horizon(terrain: &Terrain, end: &End) -> Horizon {
    let grid = terrain.obstruction.grid();
    let aside = end.places.iter().map(|place| (place - end.point).norm()).fold(0.0, f64::max);
    let mut horizon = Horizon::new(end.point, terrain.usual_radius + aside);
    let mut runs = Vec::new();
    let [column, row] = grid.cell_at(end.point);
    let [columns, rows] = grid.size().map(|count| count as i64);
    for row in (row - HORIZON_CELLS).max(0)..=(row + HORIZON_CELLS).min(rows - 1) {
        for column in (column - HORIZON_CELLS).max(0)..=(column + HORIZON_CELLS).min(columns - 1) {
            runs.extend(grid.items(column as usize, row as usize));
        }
    }
    runs.sort_unstable();
    runs.dedup();
    for run in runs {
        if terrain.there.has(terrain.obstruction.owner_of_run(run)) {
            horizon.add_chain(terrain.obstruction.chain_of_run(run));
        }
    }
    horizon
}
