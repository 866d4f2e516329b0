//! Labels that were looked into, and what they make idle.

use crate::barrier::Side;

/// Costs that differ by less than this are equal, millimetres or seconds: rounding, far below what is promised.
const COST_TOLERANCE: f64 = 1e-12;

/// Offsets that differ by less than this may be the same, radians: above every rounding.
const OFFSET_TOLERANCE: f64 = 1e-6;

/// Turned back by less than this is not turned at all, radians: rounding of what goes over from circle to circle and back.
const TURN_TOLERANCE: f64 = 1e-12;

/// Where on which feature, as far as labels can be compared: on one side, within one free stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Lane {
    pub(super) feature: u32,
    pub(super) side: Side,
    pub(super) stretch: usize,
}

/// A label that was looked into.
#[derive(Clone, Copy)]
struct Paid {
    stretch: u32,
    offset: f64,
    cost: f64,
}

/// Offsets and costs of labels that were looked into, per feature and side.
#[derive(Default)]
pub(super) struct Settled(Vec<[Vec<Paid>; 2]>);

impl Settled {
    pub(super) fn add(&mut self, lane: Lane, offset: f64, cost: f64) {
        let feature = lane.feature as usize;
        if self.0.len() <= feature {
            self.0.resize_with(feature + 1, Default::default);
        }
        let paid = Paid { stretch: lane.stretch as u32, offset, cost };
        self.0[feature][lane.side as usize].push(paid);
    }

    /// Forgets what was settled at a feature.
    pub(super) fn forget(&mut self, feature: u32) {
        self.0[feature as usize].iter_mut().for_each(Vec::clear);
    }

    /// Whether a settled label, going on along the arc, is at `offset` for no more than `cost`. `arc` is what the arc
    /// costs to there from an offset before.
    pub(super) fn serves(&self, lane: Lane, offset: f64, cost: f64, arc: impl Fn(f64) -> f64) -> bool {
        self.any(lane, offset, arc, |paid| paid <= cost + COST_TOLERANCE)
    }

    /// The same for clearly less than `cost`.
    pub(super) fn beats(&self, lane: Lane, offset: f64, cost: f64, arc: impl Fn(f64) -> f64) -> bool {
        self.any(lane, offset, arc, |paid| paid < cost - COST_TOLERANCE)
    }

    /// The least cost of a settled label at `offset` after it went on along the arc, which costs `arc` from an offset
    /// before; stretches are not told apart, and one that lies ahead by less than [`OFFSET_TOLERANCE`] counts as well.
    pub(super) fn least(
        &self,
        feature: u32,
        side: Side,
        offset: f64,
        arc: impl Fn(f64) -> f64,
    ) -> Option<f64> {
        let settled = self.0.get(feature as usize)?[side as usize].iter();
        let turned = settled.map(|paid| (paid, (offset - paid.offset) * side.sign()));
        let behind = turned.filter(|&(_, turn)| turn >= -OFFSET_TOLERANCE);
        let on = |(paid, turn): (&Paid, f64)| paid.cost + if turn > 0.0 { arc(paid.offset) } else { 0.0 };
        behind.map(on).min_by(f64::total_cmp)
    }

    fn any(&self, lane: Lane, offset: f64, arc: impl Fn(f64) -> f64, holds: impl Fn(f64) -> bool) -> bool {
        let Some(sides) = self.0.get(lane.feature as usize) else { return false };
        sides[lane.side as usize].iter().any(|paid| {
            let turn = (offset - paid.offset) * lane.side.sign();
            paid.stretch == lane.stretch as u32
                && turn >= -TURN_TOLERANCE
                && holds(paid.cost + arc(paid.offset))
        })
    }
}
