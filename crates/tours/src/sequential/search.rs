//! Iterated local search that keeps an order: a few random exchanges, then 3-exchanges from every touched place
//! until none helps; taken back when the tour got worse by more than the search's temper allows.

use super::exchange::{Labels, backward, forward, is_allowed};
use super::path::{Exchange, Path};
use crate::cost::Costs;
use crate::local_search::cycle_cost;
use crate::precedence::Precedence;
use crate::work::Work;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::VecDeque;
use traverse_solve::Interrupt;

/// The longest segment that a kick moves.
const KICK_LENGTH: usize = 30;
/// Kicks without a better tour after which the search goes back to the best.
const PATIENCE: u64 = 4_000;

/// A path from the depot through all nodes that is being improved.
#[derive(Debug)]
pub(crate) struct SequentialSearch<'a, C> {
    costs: &'a C,
    precedence: &'a Precedence,
    path: Path,
    cost: i64,
    best: Path,
    best_cost: i64,
    queue: VecDeque<usize>,
    queued: Vec<bool>,
    undo: Vec<Exchange>,
    labels: Labels,
    chance: Xoshiro256PlusPlus,
    idle: u64,
    /// How much dearer than before a tour may be and still be kept, at most.
    temper: f64,
}

/// The cheapest next node among those whose predecessors are all behind, from the depot on. O(n²).
pub(crate) fn greedy_order(costs: &impl Costs, precedence: &Precedence, depot: usize) -> Vec<usize> {
    let size = costs.size();
    let mut waiting: Vec<usize> = (0..size).map(|node| precedence.predecessors[node].len()).collect();
    let mut walk = vec![depot];
    let mut met = vec![false; size];
    met[depot] = true;
    let mut at = depot;
    while walk.len() < size {
        let ready = (0..size).filter(|&node| !met[node] && waiting[node] == 0);
        let Some(next) = ready.min_by_key(|&node| (costs.cost(at, node), node)) else { break };
        met[next] = true;
        precedence.successors[next].iter().for_each(|&later| waiting[later] -= 1);
        walk.push(next);
        at = next;
    }
    walk
}

impl<'a, C: Costs> SequentialSearch<'a, C> {
    /// Begins with a walk that keeps the order and begins at the depot. Costs must not be negative.
    pub(crate) fn new(
        costs: &'a C,
        precedence: &'a Precedence,
        walk: Vec<usize>,
        chance: Xoshiro256PlusPlus,
    ) -> Self {
        let cost = cycle_cost(costs, &walk);
        let size = walk.len();
        let path = Path::new(walk.clone());
        Self {
            costs,
            precedence,
            best: path.clone(),
            path,
            cost,
            best_cost: cost,
            queue: walk.into(),
            queued: vec![true; size],
            undo: vec![],
            labels: Labels::new(size),
            chance,
            idle: 0,
            temper: 0.0,
        }
    }

    /// The best walk so far.
    pub(crate) fn best(&self) -> (&[usize], i64) {
        (self.best.walk(), self.best_cost)
    }

    fn make(&mut self, exchange: Exchange, saving: i64) {
        let Exchange { before, middle, end } = exchange;
        for position in [before, before + 1, middle, middle + 1, end, end + 1] {
            let node = self.path.at(position);
            if !std::mem::replace(&mut self.queued[node], true) {
                self.queue.push_back(node);
            }
        }
        self.path.exchange(exchange);
        self.cost -= saving;
        self.undo.push(exchange);
    }

    /// Improves until no exchange from a touched node helps.
    pub(crate) fn descend(&mut self, work: &Work<'_>) -> Result<(), Interrupt> {
        while let Some(node) = self.queue.pop_front() {
            self.queued[node] = false;
            work.breathe()?;
            loop {
                let at = self.path.position(node);
                let (costs, order) = (self.costs, self.precedence);
                let dearest = self.path.dearest(costs);
                let found = (at + 1 < self.path.end())
                    .then(|| forward(costs, order, &self.path, at, dearest, &mut self.labels))
                    .flatten()
                    .or_else(|| {
                        (at > 1)
                            .then(|| backward(costs, order, &self.path, at, dearest, &mut self.labels))
                            .flatten()
                    });
                let Some((exchange, saving)) = found else { break };
                self.make(exchange, saving);
            }
        }
        if self.cost < self.best_cost {
            self.best_cost = self.cost;
            self.best.clone_from(&self.path);
            self.idle = 0;
        }
        Ok(())
    }

    /// `kicks` kicks, each repaired, and kept or taken back.
    pub(crate) fn kicks(&mut self, kicks: u64, work: &mut Work<'_>) -> Result<(), Interrupt> {
        self.undo.clear();
        if self.path.end() < 4 {
            return Ok(());
        }
        for _ in 0..kicks {
            work.step()?;
            let before = self.cost;
            for _ in 0..self.chance.random_range(1..=3) {
                self.kick();
            }
            self.descend(work)?;
            let worse = (self.cost - before) as f64;
            if worse > 0.0 && worse > self.temper * -self.chance.random_range(f64::MIN_POSITIVE..1.0).ln() {
                while let Some(exchange) = self.undo.pop() {
                    self.path.exchange(exchange.undone());
                }
                self.cost = before;
            }
            self.undo.clear();
            self.idle += 1;
            if self.idle > PATIENCE {
                self.idle = 0;
                self.path.clone_from(&self.best);
                self.cost = self.best_cost;
            }
        }
        Ok(())
    }

    /// Lets tours that are dearer by about this much be kept.
    pub(crate) fn loosen(&mut self, temper: f64) {
        self.temper = temper;
    }

    /// One random exchange that keeps the order.
    fn kick(&mut self) {
        let end = self.path.end();
        for attempt in 0..20 {
            // Where much is ordered only short segments can move.
            let longest = (KICK_LENGTH >> (attempt / 4)).max(2);
            let before = self.chance.random_range(0..end - 2);
            let middle = before + self.chance.random_range(1..=longest.min(end - 2 - before));
            let last = middle + self.chance.random_range(1..=longest.min(end - 1 - middle));
            let exchange = Exchange { before, middle, end: last };
            if is_allowed(self.precedence, &self.path, exchange, &mut self.labels) {
                let saving = exchange.saving(&self.path, |from, to| self.costs.cost(from, to));
                self.make(exchange, saving);
                return;
            }
        }
    }
}
