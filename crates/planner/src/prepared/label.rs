//! Labels: ways of touching a corner or arc of a prepared scene.

use super::link::Link;
use crate::barrier::Side;

/// The bit that says that the circle lies on the right.
const RIGHT: u32 = 1 << 31;

/// The place of the target's labels.
const TARGET: u32 = u32::MAX;

/// How a label is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// From a place that stands for the start, by a tangent of which no more is known than what it costs at least.
    Guess,
    /// From a place that stands for the start, along a tangent that is worked out and not yet tested.
    Untested,
    /// From a place that stands for the start, along a tangent that nothing blocks.
    FromStart,
    /// Along a link.
    Link,
    /// Without a straight move: the feature before goes over into this one.
    Over,
    /// Straight to a place that stands for the target.
    ToTarget,
}

/// A way of touching a feature or of reaching the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Label {
    /// Millimetres from the start.
    pub(super) cost: f64,
    /// The offset of the feature before at which it is left.
    pub(super) left_at: f64,
    /// The offset of arrival; 0 at the target.
    pub(super) offset: f64,
    to: u32,
    /// The label that it comes from; at the first one the start's place.
    pub(super) from: u32,
    /// The target's place; of no meaning elsewhere.
    pub(super) place: u32,
    pub(super) step: Step,
}

impl Label {
    /// At a feature with its circle on `side`, from the start's place `from`.
    pub(super) fn guess(feature: u32, side: Side, from: u32) -> Self {
        let to = if side == Side::Right { feature | RIGHT } else { feature };
        Self { cost: 0.0, left_at: 0.0, offset: 0.0, to, from, place: 0, step: Step::Guess }
    }

    /// The same tangent from the start, worked out.
    pub(super) fn worked_out(&self, offset: f64, cost: f64) -> Self {
        Self { cost, offset, step: Step::Untested, ..*self }
    }

    /// Along a link from the label `from`, which leaves at `left_at`.
    pub(super) fn along(link: &Link, from: u32, left_at: f64, cost: f64) -> Self {
        Self {
            offset: link.offset,
            left_at,
            step: Step::Link,
            cost,
            ..Self::guess(link.feature(), link.side(), from)
        }
    }

    /// Over onto a feature from the label `from`.
    pub(super) fn over(feature: u32, side: Side, offset: f64, from: u32, left_at: f64, cost: f64) -> Self {
        Self { offset, left_at, step: Step::Over, cost, ..Self::guess(feature, side, from) }
    }

    /// At the target's place `place` from the label `from`.
    pub(super) fn target(place: u32, from: u32, left_at: f64, cost: f64) -> Self {
        Self { cost, left_at, offset: 0.0, to: TARGET, from, place, step: Step::ToTarget }
    }

    /// The feature that it touches.
    pub(super) fn feature(&self) -> u32 {
        self.to & !RIGHT
    }

    /// On which side of the way the circle lies.
    pub(super) fn side(&self) -> Side {
        if self.to & RIGHT == 0 { Side::Left } else { Side::Right }
    }
}
