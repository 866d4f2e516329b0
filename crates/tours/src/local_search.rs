//! Iterated local search: kick the tour, repair it with 3-opt where it was touched, keep it if it is no worse.
//!
//! A kick and its repair cost about the same in a tour of fifty nodes and of ten thousand: moves come from
//! neighbour lists, only touched nodes are looked at again, and a kick that did not pay is taken back swap by swap.
//! Costs may be computed lazily. After Johnson and McGeoch (2002), iterated 3-opt for asymmetric problems.

use crate::cost::Costs;
use crate::moves::{double_bridge, three_opt};
use crate::neighbours::Neighbours;
use crate::tour_array::{Swap, TourArray};
use crate::work::Work;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::VecDeque;
use traverse_solve::Interrupt;

/// The longest segment that a kick moves.
const KICK_LENGTH: usize = 30;
/// Kicks without a better tour after which the search goes back to the best.
const PATIENCE: u64 = 10_000;

/// A tour that is being improved.
#[derive(Debug)]
pub(crate) struct LocalSearch<'a, C> {
    costs: &'a C,
    neighbours: &'a Neighbours,
    tour: TourArray,
    cost: i64,
    best: Vec<usize>,
    best_cost: i64,
    queue: VecDeque<usize>,
    queued: Vec<bool>,
    undo: Vec<Swap>,
    chance: Xoshiro256PlusPlus,
    idle: u64,
    /// How much dearer than before a tour may be and still be kept, about.
    temper: f64,
}

impl<'a, C: Costs> LocalSearch<'a, C> {
    /// Begins with a tour, not yet improved. Every arc must have a cost that can be added.
    pub(crate) fn new(
        costs: &'a C,
        neighbours: &'a Neighbours,
        order: Vec<usize>,
        chance: Xoshiro256PlusPlus,
    ) -> Self {
        let cost = cycle_cost(costs, &order);
        let size = order.len();
        Self {
            costs,
            neighbours,
            best: order.clone(),
            queue: order.iter().copied().collect(),
            tour: TourArray::new(order),
            cost,
            best_cost: cost,
            queued: vec![true; size],
            undo: vec![],
            chance,
            idle: 0,
            temper: 0.0,
        }
    }

    /// The best tour so far.
    pub(crate) fn best(&self) -> (&[usize], i64) {
        (&self.best, self.best_cost)
    }

    /// Improves until no 3-opt move from the lists helps.
    pub(crate) fn descend(&mut self, work: &Work<'_>) -> Result<(), Interrupt> {
        let mut looked = 0_u32;
        while let Some(node) = self.queue.pop_front() {
            self.queued[node] = false;
            looked += 1;
            if looked.is_multiple_of(64) {
                work.breathe()?;
            }
            while let Some(made) = three_opt::improve(self.costs, self.neighbours, &mut self.tour, node) {
                self.cost -= made.saving;
                self.undo.push(made.swap);
                self.enqueue(&made.touched);
            }
        }
        if self.cost < self.best_cost {
            self.keep_best();
        }
        Ok(())
    }

    /// `kicks` kicks, each repaired, and kept or taken back.
    pub(crate) fn kicks(&mut self, kicks: u64, work: &mut Work<'_>) -> Result<(), Interrupt> {
        self.undo.clear();
        if self.tour.len() < double_bridge::LEAST_SIZE {
            return Ok(());
        }
        for _ in 0..kicks {
            work.step()?;
            let before = self.cost;
            let kick = double_bridge::kick(self.costs, &mut self.tour, KICK_LENGTH, &mut self.chance);
            self.cost -= kick.saving;
            self.undo.extend(kick.swaps);
            self.enqueue(&kick.touched);
            self.descend(work)?;
            let worse = (self.cost - before) as f64;
            if worse > 0.0 && worse > self.temper * -self.chance.random_range(f64::MIN_POSITIVE..1.0).ln() {
                while let Some(swap) = self.undo.pop() {
                    self.tour.undo(swap);
                }
                self.cost = before;
            }
            self.undo.clear();
            self.idle += 1;
            if self.idle > PATIENCE {
                self.idle = 0;
                self.cost = self.best_cost;
                self.tour = TourArray::new(self.best.clone());
            }
        }
        Ok(())
    }

    /// Lets tours that are dearer by about this much be kept.
    pub(crate) fn loosen(&mut self, temper: f64) {
        self.temper = temper;
    }

    fn keep_best(&mut self) {
        self.best_cost = self.cost;
        self.idle = 0;
        self.best.clear();
        self.best.extend_from_slice(self.tour.order());
    }

    fn enqueue(&mut self, nodes: &[usize]) {
        for &node in nodes {
            if !std::mem::replace(&mut self.queued[node], true) {
                self.queue.push_back(node);
            }
        }
    }
}

/// The cost of a closed tour whose arcs all have one.
pub(crate) fn cycle_cost(costs: &impl Costs, order: &[usize]) -> i64 {
    let arcs = order.iter().zip(order.iter().cycle().skip(1));
    arcs.map(|(&from, &to)| costs.cost(from, to)).sum()
}
