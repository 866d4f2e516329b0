//! A cheap floor of joins: borders sampled at a few heights. What two sections need at one height they need at least;
//! a look at every pair of thousands costs some nanoseconds each.

use crate::instance::{Instance, Item};
use traverse_solve::{Budget, Interrupt};

/// Heights that are sampled.
const HEIGHTS: usize = 16;

/// Where a section does not reach: no sum of two comes near a real length.
const ABSENT: i32 = i32::MIN / 4;

/// Borders of all items at the same heights.
#[derive(Debug)]
pub(crate) struct SampledBorders {
    /// Units of the grid in one step of a sample.
    step: i64,
    /// How far each item reaches right, gap included, rounded down.
    right: Vec<[i32; HEIGHTS]>,
    /// How far each item reaches left, rounded down.
    left: Vec<[i32; HEIGHTS]>,
}

impl SampledBorders {
    pub(crate) fn of(instance: &Instance, budget: &Budget) -> Result<Self, Interrupt> {
        let span = |item: &Item| item.profile.left.heights();
        let low =
            instance.items.iter().filter_map(span).map(|heights| heights.0).fold(f64::INFINITY, f64::min);
        let high =
            instance.items.iter().filter_map(span).map(|heights| heights.1).fold(f64::NEG_INFINITY, f64::max);
        let heights: [f64; HEIGHTS] =
            std::array::from_fn(|at| low + (high - low) * (at as f64 + 0.5) / HEIGHTS as f64);
        let step = instance.longest_reach / i64::from(i32::MAX / 8) + 1;
        let mut borders = Self { step, right: vec![], left: vec![] };
        for item in &instance.items {
            budget.check(0)?;
            let sampled =
                |x: Option<f64>| x.map_or(ABSENT, |x| instance.grid.down(x).div_euclid(step) as i32);
            borders.right.push(heights.map(|y| sampled(item.profile.grown_right.x(y))));
            borders.left.push(heights.map(|y| sampled(item.profile.left.x(y))));
        }
        Ok(borders)
    }

    /// Never above [`Instance::kind_cost`] of an allowed join.
    pub(crate) fn floor(&self, instance: &Instance, left: usize, right: usize) -> i64 {
        let (lefts, rights) = (instance.kinds[left].items.clone(), instance.kinds[right].items.clone());
        let mut least = i32::MAX;
        for i in lefts {
            for j in rights.clone() {
                let sums = self.right[i].iter().zip(&self.left[j]).map(|(right, left)| right + left);
                least = least.min(sums.fold(0, i32::max));
            }
        }
        i64::from(least) * self.step - instance.items[instance.kinds[left].items.start].width
    }
}
