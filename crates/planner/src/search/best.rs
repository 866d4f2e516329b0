//! The cheapest way of touching each feature, as far as a search has come.
//!
//! **What it makes idle.** Say a free way touches a circle of radius r at offset o for cost c, and nothing blocks any of the
//! feature's range. Then it can be brought to any other offset o′ of the range for c + r·|o′ − o|, along the arc and on either
//! side, also backwards: a way that is not taut, but a way. Another way that is there for clearly more is no part of a
//! shortest path. On the same side and further on, where the first one runs taut, it need not even be dearer.

use crate::barrier::Side;

/// Costs that differ by less than this are equal, millimetres: rounding, far below what is promised.
const COST_TOLERANCE_MM: f64 = 1e-12;

/// Turned back by less than this is not turned at all, radians: rounding of what goes over from circle to circle and back.
pub(crate) const TURN_TOLERANCE: f64 = 1e-12;

/// What is dearer by more than this is idle, millimetres: above what planning at one contact tolerance and pricing at 0 can
/// set apart.
const DEARER_MM: f64 = 1e-9;

/// The cheapest way known of touching a feature.
#[derive(Clone, Copy, Debug)]
struct Known {
    cost: f64,
    offset: f64,
    /// The search that it belongs to, and the side.
    search: u32,
    side: Side,
}

/// The cheapest way known of touching each feature; nothing is cleared between searches.
#[derive(Default)]
pub(crate) struct Best {
    search: u32,
    known: Vec<Known>,
}

impl Best {
    /// Forgets all, for a search among so many features.
    pub(crate) fn begin(&mut self, feature_count: usize) {
        self.search = self.search.wrapping_add(1);
        if self.search == 0 {
            self.known.clear();
            self.search = 1;
        }
        let nothing = Known { cost: 0.0, offset: 0.0, search: 0, side: Side::Left };
        self.known.resize(feature_count, nothing);
    }

    /// Whether a way that is at `offset` for `cost` at least is idle: clearly dearer than one that is known.
    pub(crate) fn is_dearer(&self, feature: u32, radius: f64, offset: f64, cost: f64) -> bool {
        let known = &self.known[feature as usize];
        known.search == self.search && known.cost + radius * (offset - known.offset).abs() < cost - DEARER_MM
    }

    /// Takes in a free way, unless one that is known serves. `radius` is the priced one.
    pub(crate) fn improve(&mut self, feature: u32, side: Side, radius: f64, offset: f64, cost: f64) -> bool {
        let search = self.search;
        let known = &mut self.known[feature as usize];
        if known.search == search {
            let turn = (offset - known.offset) * side.sign();
            let there = known.cost + radius * turn.abs();
            if there < cost - DEARER_MM
                || known.side == side && turn >= -TURN_TOLERANCE && there <= cost + COST_TOLERANCE_MM
            {
                return false;
            }
            if known.cost <= cost {
                return true;
            }
        }
        *known = Known { cost, offset, search, side };
        true
    }
}
