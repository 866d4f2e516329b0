//! Where sections come to stand: each as far left as those before it let it.
//!
//! x_k is the largest of x_m + offset(m, k) over all earlier m, not only the neighbour: where the one between leaves a
//! height uncovered, the one before it may be in the way. With kept order no section passes the left edge of the one
//! before it. Sections that end further left than the place found are not looked at.

use crate::instance::Instance;
use traverse_geometry::SlideRule;

/// Sections in their places.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Placing {
    /// Left edges.
    pub(crate) x: Vec<i64>,
    /// The furthest that this item or any before it can touch.
    pub(crate) reach: Vec<i64>,
    /// The furthest right end so far, widths rounded down.
    pub(crate) end: Vec<i64>,
}

impl Placing {
    /// Every item of a sequence in its place.
    pub(crate) fn of(instance: &Instance, sequence: &[usize]) -> Self {
        let mut placing = Self::default();
        for at in 0..sequence.len() {
            placing.push(instance, sequence, at);
        }
        placing
    }

    /// The item at `at` in its place, all before it being in theirs.
    #[inline]
    pub(crate) fn push(&mut self, instance: &Instance, sequence: &[usize], at: usize) {
        let item = sequence[at];
        let mut x = match instance.rule {
            SlideRule::KeepOrder => self.x.last().copied().unwrap_or(0),
            SlideRule::Free => 0,
        };
        for earlier in (0..at).rev() {
            if self.reach[earlier] <= x {
                break;
            }
            x = x.max(self.x[earlier] + instance.offset(sequence[earlier], item));
        }
        self.push_at(instance, item, x);
    }

    /// The item at a place that is known.
    #[inline]
    pub(crate) fn push_at(&mut self, instance: &Instance, item: usize, x: i64) {
        let item = &instance.items[item];
        self.reach.push(self.reach.last().copied().unwrap_or(0).max(x + item.reach));
        self.end.push(self.end.last().copied().unwrap_or(0).max(x + item.width));
        self.x.push(x);
    }

    /// The places before `at` only.
    pub(crate) fn truncate(&mut self, at: usize) {
        self.x.truncate(at);
        self.reach.truncate(at);
        self.end.truncate(at);
    }

    /// The furthest right end.
    pub(crate) fn length(&self) -> i64 {
        self.end.last().copied().unwrap_or(0)
    }
}
