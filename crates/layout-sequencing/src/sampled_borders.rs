//! A cheap floor of joins: borders sampled at a few heights. What two sections need at one height they need at least;
//! a look at every pair of thousands costs some nanoseconds each.

use crate::instance::{Instance, Item};
use traverse_solve::{Budget, Interrupt};

/// Heights that are sampled.
const HEIGHTS: usize = 64;

/// Where a section does not reach: no sum of two comes near a real length.
const ABSENT: i16 = i16::MIN / 2;
/// The largest sample: two of them are added.
const LARGEST: i64 = (i16::MAX / 4) as i64;

/// Borders of all items at the same heights.
#[derive(Debug)]
pub(crate) struct SampledBorders {
    /// Units of the grid in one step of a sample.
    step: i64,
    /// How far each item reaches right, gap included, rounded down.
    right: Vec<[i16; HEIGHTS]>,
    /// How far each item reaches left, rounded down.
    left: Vec<[i16; HEIGHTS]>,
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
        let step = instance.longest_reach / LARGEST + 1;
        let mut borders = Self { step, right: vec![], left: vec![] };
        for item in &instance.items {
            budget.check(0)?;
            let sampled = |x: Option<f64>| {
                x.map_or(ABSENT, |x| instance.grid.down(x).div_euclid(step).clamp(-LARGEST, LARGEST) as i16)
            };
            borders.right.push(heights.map(|y| sampled(item.profile.grown_right.x(y))));
            borders.left.push(heights.map(|y| sampled(item.profile.left.x(y))));
        }
        Ok(borders)
    }

    /// Never above [`Instance::kind_cost`] of an allowed join.
    pub(crate) fn floor(&self, instance: &Instance, left: usize, right: usize) -> i64 {
        let (lefts, rights) = (instance.kinds[left].items.clone(), instance.kinds[right].items.clone());
        let mut least = i16::MAX;
        for i in lefts {
            for j in rights.clone() {
                let sums = self.right[i].iter().zip(&self.left[j]).map(|(right, left)| right + left);
                least = least.min(sums.fold(0, i16::max));
            }
        }
        i64::from(least) * self.step - instance.items[instance.kinds[left].items.start].width
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section, SectionLayout};
    use traverse_solve::Seed;

    /// A section between a chain up and a chain down, anywhere in height.
    fn section(id: usize, chance: &mut impl RngExt) -> Section {
        let (low, high) = (chance.random_range(0.0..40.0), chance.random_range(60.0..100.0));
        let mut xy = vec![];
        for (base, upwards) in [(60.0, true), (0.0, false)] {
            for step in 0..5 {
                let part = f64::from(step) / 4.0;
                let y = low + (high - low) * if upwards { part } else { 1.0 - part };
                xy.extend([base + chance.random_range(0.0..30.0), y]);
            }
        }
        let ring = Ring::from_xy(&xy, &[]).expect("chains don't cross");
        let shape = Polygon::from_ring(ring);
        let part =
            Part { id: "part".into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false };
        let poses = Pose::ALL[..1 + id % 4].to_vec();
        Section { id: id.to_string(), parts: vec![part], quantity: 1, poses }
    }

    #[test]
    fn floors_are_below_joins_and_mostly_near() {
        let mut chance = Seed(5).stream();
        for gap_mm in [0.0, 3.0] {
            let layout = SectionLayout {
                gap_mm,
                ..SectionLayout::new((0..30).map(|id| section(id, &mut chance)).collect())
            };
            let budget = Budget::unlimited();
            let instance = Instance::of(&layout, 1, &budget).expect("no limit");
            let borders = SampledBorders::of(&instance, &budget).expect("no limit");
            let (mut below, mut pairs) = (0, 0);
            for left in 0..instance.kinds.len() {
                for right in 0..instance.kinds.len() {
                    let (floor, cost) = (
                        borders.floor(&instance, left, right),
                        instance.kind_cost(left, right).expect("nothing is forbidden"),
                    );
                    assert!(floor <= cost, "{left} {right}");
                    below += cost - floor;
                    pairs += 1;
                }
            }
            assert!(instance.grid.mm(below / pairs) < 2.0);
        }
    }
}
