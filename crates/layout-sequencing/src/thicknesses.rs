//! Thicknesses at some heights: at every height sections that slide freely stand side by side, in their order.

use crate::beginning::Beginning;
use crate::completion::Counts;
use crate::height_bound::{heights, least_thickness};
use crate::instance::Instance;

/// Heights at which freely sliding sections are bounded.
pub(crate) const HEIGHTS: usize = 24;

/// Thicknesses at some heights.
pub(crate) struct Thicknesses {
    /// By item: how far left and right it reaches.
    pub(crate) borders: Vec<Vec<Option<(i64, i64)>>>,
    /// By kind: the least in any pose, and a gap.
    least: Vec<Vec<i64>>,
    gap: i64,
}

impl Thicknesses {
    pub(crate) fn of(instance: &Instance) -> Self {
        let heights = heights(instance, HEIGHTS);
        let borders = |item: usize| {
            let profile = &instance.items[item].profile;
            let border = |&y: &f64| {
                let (right, left) = (profile.right.x(y)?, profile.left.x(y)?);
                Some((-instance.grid.down(left), instance.grid.down(right)))
            };
            heights.iter().map(border).collect()
        };
        let least =
            |kind: usize| heights.iter().map(|&y| least_thickness(instance, kind, y).unwrap_or(0)).collect();
        Self {
            borders: (0..instance.items.len()).map(borders).collect(),
            least: (0..instance.kinds.len()).map(least).collect(),
            gap: instance.grid.down(instance.gap),
        }
    }

    /// At every height what is left stands to the right of what is placed.
    pub(crate) fn bound(&self, beginning: &Beginning, counts: &Counts) -> i64 {
        let lengths = beginning.front.iter().enumerate().map(|(at, &front)| {
            let left =
                |(kind, least): (usize, &Vec<i64>)| counts.left(beginning.state, kind) as i64 * least[at];
            let rest: i64 = self.least.iter().enumerate().map(left).sum();
            // The first at a height needs no gap before it.
            if front == i64::MIN { rest - self.gap } else { front + rest }
        });
        lengths.max().unwrap_or(0)
    }
}
