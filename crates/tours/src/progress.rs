//! The best tour and the best bound so far, shared by the steps of the ladder, and told to the observer.

use crate::network::Network;
use std::sync::Mutex;
use std::sync::atomic::{AtomicI64, Ordering};
use traverse_solve::Observer;

/// What searches side by side know of one another.
#[derive(Debug)]
pub(crate) struct Shared {
    cost: AtomicI64,
    walk: Mutex<Vec<usize>>,
}

impl Shared {
    pub(crate) fn new(best: Option<(&[usize], i64)>) -> Self {
        let (walk, cost) = best.map_or((vec![], i64::MAX), |(walk, cost)| (walk.to_vec(), cost));
        Self { cost: AtomicI64::new(cost), walk: Mutex::new(walk) }
    }

    /// Takes a cheaper walk over.
    pub(crate) fn offer(&self, walk: &[usize], cost: i64) {
        if let Ok(mut best) = self.walk.lock()
            && cost < self.cost.load(Ordering::Acquire)
        {
            best.clear();
            best.extend_from_slice(walk);
            self.cost.store(cost, Ordering::Release);
        }
    }
}

/// The best walk and the best bound so far.
pub(crate) struct Progress<'a> {
    observer: &'a mut dyn Observer,
    best: Option<(Vec<usize>, i64)>,
    bound: i64,
    shared: Option<&'a Shared>,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(observer: &'a mut dyn Observer) -> Self {
        Self { observer, best: None, bound: i64::MIN, shared: None }
    }

    /// The same progress, while someone searches beside.
    pub(crate) fn beside<'b>(&'b mut self, shared: &'b Shared) -> Progress<'b> {
        Progress { observer: self.observer, best: self.best.clone(), bound: self.bound, shared: Some(shared) }
    }

    /// What was found while someone searched beside; already told.
    pub(crate) fn take_over(&mut self, best: Option<(Vec<usize>, i64)>, bound: i64) {
        self.best = best;
        self.bound = bound;
    }

    /// What was found.
    pub(crate) fn into_found(self) -> (Option<(Vec<usize>, i64)>, i64) {
        (self.best, self.bound)
    }

    /// The best cost so far; [`i64::MAX`] while there is none.
    pub(crate) fn upper(&mut self) -> i64 {
        let own = self.best.as_ref().map_or(i64::MAX, |best| best.1);
        if let Some(shared) = self.shared
            && shared.cost.load(Ordering::Acquire) < own
            && let Ok(walk) = shared.walk.lock()
        {
            let cost = shared.cost.load(Ordering::Acquire);
            self.best = Some((walk.clone(), cost));
            self.observer.better_cost(cost as f64);
            return cost;
        }
        own
    }

    pub(crate) fn best(&self) -> Option<(&[usize], i64)> {
        self.best.as_ref().map(|(walk, cost)| (walk.as_slice(), *cost))
    }

    #[cfg(test)]
    pub(crate) fn bound(&self) -> i64 {
        self.bound
    }

    /// Takes a walk over if it is allowed and cheaper than the best.
    pub(crate) fn offer(&mut self, network: &Network, walk: &[usize]) {
        let Some(cost) = network.walk_cost(walk) else { return };
        if cost < self.upper() && keeps_order(network, walk) {
            self.best = Some((walk.to_vec(), cost));
            self.observer.better_cost(cost as f64);
            if let Some(shared) = self.shared {
                shared.offer(walk, cost);
            }
        }
    }

    /// No tour costs less than this. That there is none is an ending and no bound: sums with it would not be exact.
    pub(crate) fn raise_bound(&mut self, bound: i64) {
        let bound = bound.min(self.upper());
        if bound > self.bound && bound < i64::MAX {
            self.bound = bound;
            self.observer.better_bound(bound as f64);
        }
    }

    /// Whether cost and bound have met.
    pub(crate) fn is_proven(&mut self) -> bool {
        let upper = self.upper();
        upper != i64::MAX && self.bound >= upper
    }
}

fn keeps_order(network: &Network, walk: &[usize]) -> bool {
    let (Some(depot), false) = (network.depot, network.precedence.is_empty()) else { return true };
    let begin = walk.iter().position(|&node| node == depot).unwrap_or(0);
    network.precedence.is_kept_by(&[&walk[begin..], &walk[..begin]].concat())
}
