//! Shortest ways from one end to many others in a prepared scene: what they cost.
//!
//! What each end sees of the corners and arcs is worked out once ([`Sighted`]); a search without a goal then runs along
//! the scene's links from one end until it has come by all others.

use super::link::Link;
use super::scene::{PreparedScene, horizon};
use super::sights::Sights;
use super::terrain::Terrain;
use crate::barrier::Side;
use crate::search::{Best, End, Goal, Ground, Moves, Room, Sector, Sighted, Spread, Tangent};
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 1024;

/// A prepared scene, seen from many ends.
pub(crate) struct Fan<'a> {
    scene: &'a mut PreparedScene,
    room: &'a mut FanRoom,
}

/// The memory of a fan, to be used again.
#[derive(Default)]
pub(crate) struct FanRoom {
    tree: Room,
    idle: Best,
}

impl<'a> Fan<'a> {
    pub(crate) fn new(scene: &'a mut PreparedScene, room: &'a mut FanRoom) -> Self {
        Self { scene, room }
    }

    /// Corners and arcs that a tangent from an end leads to with nothing in its way. Cost: about linear in the scene.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn sighted(&self, end: &End, budget: &Budget) -> Result<Vec<Sighted>, Interrupt> {
        let terrain = &self.scene.terrain;
        let horizon = horizon(terrain, end);
        let mut sighted = Vec::new();
        for feature in 0..terrain.features.len() as u32 {
            if (feature as usize).is_multiple_of(FEATURES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            let circle = terrain.feature(feature);
            if !terrain.is_there(feature) || horizon.hides(circle.center - end.point, circle.plan_radius) {
                continue;
            }
            for (place, &at) in end.places.iter().enumerate() {
                let sides = Sector::all_round(at).may_reach(Side::Left, terrain.sector(feature));
                for side in sides.into_iter().flatten() {
                    if is_seen(terrain, at, feature, side) {
                        sighted.push(Sighted { feature, side, place: place as u32 });
                    }
                }
            }
        }
        Ok(sighted)
    }

    /// The cost of the shortest way from `start`, which sees `sighted`, to each of the goals, millimetres; infinity where
    /// there is none. `steps` counts the labels that were looked into, over calls.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn costs(
        &mut self,
        start: &End,
        sighted: &[Sighted],
        goals: &[Goal<'_>],
        budget: &Budget,
        steps: &mut u64,
    ) -> Result<Vec<f64>, Interrupt> {
        let PreparedScene { terrain, sights, .. } = &mut *self.scene;
        let moves = AlongLinks { terrain, sights };
        let FanRoom { tree, idle } = &mut *self.room;
        idle.begin(moves.terrain.features.len());
        let mut spread = Spread::new(moves, start, sighted, goals, (std::mem::take(tree), idle));
        let costs = spread.run(budget, steps);
        *tree = spread.into_room();
        costs
    }
}

/// Whether nothing is in the way of the tangent from `at` to the feature.
fn is_seen(terrain: &Terrain, at: Point, feature: u32, side: Side) -> bool {
    let circle = terrain.feature(feature);
    Tangent::between(at, 0.0, circle.center, circle.plan_radius * side.sign()).is_some_and(|tangent| {
        circle.offset_of(-tangent.normal * side.sign(), tangent.angle_error).is_some()
            && terrain.is_free(tangent.from, tangent.to)
    })
}

/// Moves along links alone: what the ends see is known beforehand.
struct AlongLinks<'a> {
    terrain: &'a Terrain,
    sights: &'a mut Sights,
}

impl Moves for AlongLinks<'_> {
    type Ground = Terrain;

    fn ground(&self) -> &Terrain {
        self.terrain
    }

    fn see(&mut self, feature: u32, side: Side, budget: &Budget) -> Result<(), Interrupt> {
        self.sights.see(self.terrain, feature, side, budget)
    }

    fn links(&self, feature: u32, side: Side) -> &[Link] {
        self.sights.links(feature, side)
    }

    fn is_whole(&self, feature: u32) -> bool {
        self.terrain.is_whole(feature)
    }

    fn is_free(&self, from: Point, to: Point) -> bool {
        self.terrain.is_free(from, to)
    }
}
