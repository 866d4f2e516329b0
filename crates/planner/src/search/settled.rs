//! Labels that were expanded, and what they make idle.

use crate::barrier::Side;
use std::collections::HashMap;

/// Costs that differ by less than this are equal, millimetres: rounding, far below what is promised.
const COST_TOLERANCE_MM: f64 = 1e-12;

/// Where on which feature, as far as labels can be compared: on one side, within one free stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Lane {
    pub(super) feature: u32,
    pub(super) side: Side,
    pub(super) stretch: usize,
}

/// Offsets and costs of expanded labels per lane.
#[derive(Default)]
pub(super) struct Settled(HashMap<Lane, Vec<(f64, f64)>>);

impl Settled {
    pub(super) fn add(&mut self, lane: Lane, offset: f64, cost: f64) {
        self.0.entry(lane).or_default().push((offset, cost));
    }

    /// Whether an expanded label, going on along the arc of `radius`, is at `offset` for no more than `cost`.
    pub(super) fn serves(&self, lane: Lane, radius: f64, offset: f64, cost: f64) -> bool {
        self.any(lane, radius, offset, |paid| paid <= cost + COST_TOLERANCE_MM)
    }

    /// The same for clearly less than `cost`.
    pub(super) fn beats(&self, lane: Lane, radius: f64, offset: f64, cost: f64) -> bool {
        self.any(lane, radius, offset, |paid| paid < cost - COST_TOLERANCE_MM)
    }

    fn any(&self, lane: Lane, radius: f64, offset: f64, holds: impl Fn(f64) -> bool) -> bool {
        self.0.get(&lane).is_some_and(|settled| {
            settled.iter().any(|&(from, paid)| {
                let turn = (offset - from) * lane.side.sign();
                turn >= 0.0 && holds(paid + radius * turn)
            })
        })
    }
}
