//! The shortest path in a scene of which it is known what can be seen from where: best-first search (A*: P. Hart,
//! N. Nilsson, B. Raphael 1968) along links, tangents that nothing blocks.
//!
//! Only the ends are new to the scene. The target is offered to every stance. What can be seen from the start is not
//! worked out: its tangents are offered in the order in which they can matter, by an ellipse round start and target that
//! grows with the estimates, and each is tested when it is its turn.
//!
//! Exact: before a label of some estimate is looked into, every feature that a path of that cost can touch was offered
//! to the start.

use super::label::{Label, Place, Route, Step};
use super::route::route;
use super::shortest::LABEL_LIMIT;
use super::stance::From;
use super::tree::{Room, Tree};
use super::{End, Ground};
use crate::barrier::Side;
use crate::prepared::Link;
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt, Observer};

/// Where links and the tests of other moves come from.
pub(crate) trait Moves {
    type Ground: Ground;

    fn ground(&self) -> &Self::Ground;

    /// Works out what can be seen from a feature on one side, unless it is known.
    ///
    /// # Errors
    /// The budget ended.
    fn see(&mut self, feature: u32, side: Side, budget: &Budget) -> Result<(), Interrupt>;

    /// What can be seen from there, once that was worked out.
    fn links(&self, feature: u32, side: Side) -> &[Link];

    /// Whether nothing blocks a straight move.
    fn is_free(&self, from: Point, to: Point) -> bool;

    /// Adds to `found` features not added before, among them all that a path of cost `cost` may touch; answers the cost
    /// up to which that holds now.
    fn offer(&mut self, cost: f64, found: &mut Vec<u32>) -> f64;
}

/// A search under way.
pub(crate) struct SeenSearch<'a, M> {
    tree: Tree<'a>,
    moves: M,
    /// Stances at the start.
    starts: Vec<u32>,
    /// Every feature that a path of this cost may touch was offered to the start.
    offered: f64,
    /// No path costs less, millimetres.
    pub(crate) lower_bound: f64,
}

impl<'a, M: Moves> SeenSearch<'a, M> {
    pub(crate) fn new(moves: M, start: &'a End, target: &'a End, room: Room) -> Self {
        let tree = Tree::new(start, target, room);
        Self { tree, moves, starts: Vec::new(), offered: 0.0, lower_bound: 0.0 }
    }

    /// The search's memory, for the next one.
    pub(crate) fn into_room(self) -> Room {
        self.tree.into_room()
    }

    /// The shortest path, if there is one. `steps` counts the labels that were looked into.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn run(
        &mut self,
        budget: &Budget,
        steps: &mut u64,
        observer: &mut dyn Observer,
    ) -> Result<Option<Route>, Interrupt> {
        loop {
            budget.check(*steps)?;
            if self.tree.label_count() > LABEL_LIMIT {
                return Err(Interrupt::Memory);
            }
            let lowest = self.tree.lowest_estimate();
            let all_started = self.starts.len() == self.tree.start.places.len();
            if all_started && self.offered < lowest.unwrap_or(f64::INFINITY) {
                self.offer(lowest.unwrap_or(f64::INFINITY));
                continue;
            }
            let Some((estimate, label)) = self.tree.pop() else { return Ok(None) };
            if estimate > self.lower_bound {
                self.lower_bound = estimate;
            }
            if self.tree.is_served(self.moves.ground(), &label) || !self.is_free(&label) {
                continue;
            }
            if let Place::Target(_) = label.place {
                observer.better_bound(self.lower_bound);
                return Ok(Some(route(&self.tree, self.moves.ground(), &label)));
            }
            let Some(stance) = self.tree.stand(self.moves.ground(), &label) else { continue };
            *steps += 1;
            self.tree.reach_for_target(self.moves.ground(), stance);
            let Place::Feature(feature, side) = label.place else {
                self.starts.push(stance);
                continue;
            };
            self.tree.push_over(self.moves.ground(), stance, |_| true);
            self.moves.see(feature, side, budget)?;
            self.tree.push_links(self.moves.ground(), stance, self.moves.links(feature, side));
        }
    }

    /// Offers features to the start until all that a path of cost `cost` may touch were.
    fn offer(&mut self, cost: f64) {
        let mut found = Vec::new();
        self.offered = self.moves.offer(cost, &mut found);
        for other in found {
            for at in 0..self.starts.len() {
                self.tree.push_tangents_to(self.moves.ground(), self.starts[at], other);
            }
        }
    }

    fn is_free(&self, label: &Label) -> bool {
        if label.step != Step::Tangent {
            return true;
        }
        let leg = self.tree.leg(self.moves.ground(), label);
        leg.is_none_or(|leg| self.moves.is_free(leg.planned.from, leg.planned.to))
    }
}

impl Tree<'_> {
    /// Along the links from a stance's feature.
    fn push_links(&mut self, ground: &impl Ground, stance: u32, links: &[Link]) {
        let From::Feature(departure) = self.stances[stance as usize].from else { return };
        for link in links {
            let Some(left_at) = departure.leaves_along(link) else { continue };
            let planned_cost = departure.planned_cost(left_at);
            if self.settled.beats(departure.lane, departure.circle.price_radius, left_at, planned_cost) {
                continue;
            }
            let onto = ground.feature(link.feature());
            let at = if onto.price_radius == 0.0 {
                onto.center
            } else {
                onto.center + onto.direction_at(link.offset) * onto.price_radius
            };
            let label = Label {
                cost: planned_cost + link.length,
                left_at,
                offset: link.offset,
                place: Place::Feature(link.feature(), link.side()),
                parent: stance,
                step: Step::Link,
            };
            self.push(ground, label, at);
        }
    }

    /// Along the tangents from a stance to a feature.
    fn push_tangents_to(&mut self, ground: &impl Ground, stance: u32, other: u32) {
        let (side, ahead) = self.ahead[stance as usize];
        for other_side in ahead.may_reach(side, ground.sector(other)).into_iter().flatten() {
            self.push_tangent(ground, stance, other, other_side);
        }
    }
}
