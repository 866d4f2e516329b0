//! From one start to many targets: best first without a goal (E. W. Dijkstra 1959) along links, tangents that nothing
//! blocks.
//!
//! What start and targets see is given. A target's tangents are looked at where their features are looked into; the
//! way to a target ends when it is the cheapest of all that are open.
//!
//! Exact for the same reason as the search for one target: labels are left out where [`Best`] says that they are idle.
//!
//! Cost: every corner and arc that is nearer than the farthest target, with its links.

use super::label::{Label, Place, Step};
use super::route::route;
use super::shortest::LABEL_LIMIT;
use super::stance::From;
use super::tree::{Room, Tree};
use super::{Best, End, Ground, Moves};
use crate::barrier::Side;
use crate::measure::{Length, Measure};
use crate::trace::trace;
use rustc_hash::FxHashMap;
use traverse_solve::{Budget, Interrupt};

/// A corner or arc that an end sees, as the way from the end touches it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sighted {
    pub(crate) feature: u32,
    pub(crate) side: Side,
    /// From this one of the places that stand for the end.
    pub(crate) place: u32,
}

/// A target, and what it sees.
#[derive(Clone, Copy)]
pub(crate) struct Goal<'a> {
    pub(crate) end: &'a End,
    pub(crate) sighted: &'a [Sighted],
}

/// A search under way.
pub(crate) struct Spread<'a, M> {
    tree: Tree<'a>,
    moves: M,
    sighted: &'a [Sighted],
    goals: &'a [Goal<'a>],
    /// Goals and their places by feature and side.
    seen_from: FxHashMap<(u32, Side), Vec<(u32, u32)>>,
    idle: &'a mut Best,
    /// What reaching each goal costs so far.
    best: Vec<f64>,
    /// Labels of goals: the tree's name for each is its place in this list.
    reached: Vec<(u32, u32)>,
}

impl<'a, M: Moves> Spread<'a, M> {
    /// A search from `start`, which sees `sighted`.
    pub(crate) fn new(
        moves: M,
        start: &'a End,
        sighted: &'a [Sighted],
        goals: &'a [Goal<'a>],
        (room, idle): (Room, &'a mut Best),
    ) -> Self {
        let mut seen_from: FxHashMap<(u32, Side), Vec<(u32, u32)>> = FxHashMap::default();
        for (goal, Goal { sighted, .. }) in goals.iter().enumerate() {
            for sight in *sighted {
                // The way to the goal runs the other way than the one from it.
                let side = match sight.side {
                    Side::Left => Side::Right,
                    Side::Right => Side::Left,
                };
                seen_from.entry((sight.feature, side)).or_default().push((goal as u32, sight.place));
            }
        }
        Self {
            tree: Tree::in_all_directions(Length, start, room),
            moves,
            sighted,
            goals,
            seen_from,
            idle,
            best: vec![f64::INFINITY; goals.len()],
            reached: Vec::new(),
        }
    }

    /// The search's memory, for the next one.
    pub(crate) fn into_room(self) -> Room {
        self.tree.into_room()
    }

    /// What the shortest way to each goal costs, millimetres; infinity where there is none.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn run(&mut self, budget: &Budget, steps: &mut u64) -> Result<Vec<f64>, Interrupt> {
        let mut costs = vec![f64::INFINITY; self.goals.len()];
        let mut open_goals = self.goals.len();
        while open_goals > 0 {
            budget.check(*steps)?;
            if self.tree.label_count() > LABEL_LIMIT {
                return Err(Interrupt::Memory);
            }
            let Some((_, label)) = self.tree.pop() else { break };
            if let Place::Target(reached) = label.place {
                let (goal, place) = self.reached[reached as usize];
                let cost = &mut costs[goal as usize];
                if *cost == f64::INFINITY {
                    let end = self.goals[goal as usize].end;
                    self.tree.target = end;
                    let label = Label { place: Place::Target(place), ..label };
                    let route = route(&self.tree, self.moves.ground(), &label);
                    *cost = trace(&route, self.tree.start.point, end.point).length();
                    open_goals -= 1;
                }
                continue;
            }
            if self.is_idle(&label) || self.tree.is_served(self.moves.ground(), &label) {
                continue;
            }
            let Some(stance) = self.tree.stand(self.moves.ground(), &label) else { continue };
            *steps += 1;
            match label.place {
                Place::Start(place) => self.leave_start(stance, place, budget)?,
                Place::Feature(feature, side) => self.leave_feature(stance, feature, side, budget)?,
                Place::Target(_) => {}
            }
        }
        Ok(costs)
    }

    /// To all that the start sees, and straight to the goals.
    fn leave_start(&mut self, stance: u32, place: u32, budget: &Budget) -> Result<(), Interrupt> {
        for sight in self.sighted.iter().filter(|sight| sight.place == place) {
            self.tree.push_tangent(self.moves.ground(), stance, sight.feature, sight.side);
        }
        let from = self.tree.start.places[place as usize];
        for (goal, Goal { end, .. }) in self.goals.iter().enumerate() {
            budget.check(0)?;
            for (to, &at) in end.places.iter().enumerate() {
                if self.moves.is_free(from, at) {
                    self.reach(stance, goal as u32, to as u32);
                }
            }
        }
        Ok(())
    }

    /// To the goals that see the feature, over onto its neighbours, and along its links.
    fn leave_feature(
        &mut self,
        stance: u32,
        feature: u32,
        side: Side,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        if let Some(goals) = self.seen_from.get(&(feature, side)).cloned() {
            for (goal, place) in goals {
                self.reach(stance, goal, place);
            }
        }
        self.tree.push_over(self.moves.ground(), stance, |_| true);
        self.moves.see(feature, side, budget)?;
        let From::Feature(departure) = self.tree.stances[stance as usize].from else { return Ok(()) };
        for link in self.moves.links(feature, side) {
            let Some(left_at) = departure.leaves_along(link) else { continue };
            let planned_cost = departure.planned_cost(Length, left_at);
            let arc = |from| Length.between(&departure.circle, from, left_at);
            if self.tree.settled.beats(departure.lane, left_at, planned_cost, arc) {
                continue;
            }
            let label = Label {
                cost: planned_cost + link.length,
                left_at,
                offset: link.offset,
                place: Place::Feature(link.feature(), link.side()),
                parent: stance,
                step: Step::Link,
            };
            let onto = link.feature();
            let radius = self.moves.ground().feature(onto).price_radius;
            if self.moves.is_whole(onto)
                && !self.idle.improve(onto, link.side(), radius, label.offset, label.cost)
            {
                continue;
            }
            // Where it lies does not matter: nothing is estimated.
            self.tree.push(self.moves.ground(), label, departure.circle.center);
        }
        Ok(())
    }

    /// Whether a way that is known makes the label idle.
    fn is_idle(&self, label: &Label) -> bool {
        let Place::Feature(feature, _) = label.place else { return false };
        let radius = self.moves.ground().feature(feature).price_radius;
        self.moves.is_whole(feature) && self.idle.is_dearer(feature, radius, label.offset, label.cost)
    }

    /// Takes note of a straight way from a stance to a goal, if it leads there for less than is known.
    fn reach(&mut self, stance: u32, goal: u32, place: u32) {
        let end = self.goals[goal as usize].end;
        let Some(label) = self.tree.at_target(stance, end, place) else { return };
        let best = &mut self.best[goal as usize];
        if label.cost < *best {
            *best = label.cost;
            let reached = self.reached.len() as u32;
            self.reached.push((goal, place));
            self.tree.add(Label { place: Place::Target(reached), ..label }, end.point);
        }
    }
}
