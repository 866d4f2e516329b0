//! Features by bundles: what leaves out most of them at once when a stance looks for tangents.
//!
//! Neighbouring features of a barrier are bundled, bundles of neighbours too, and so on. A bundle's sector has the
//! directions of all of its features and a circle round theirs, so a tangent to any of them passes its test as well.
//!
//! Cost: building is n log n; a stance tests a bundle where it may reach the one that it lies in, about log n for each
//! tangent that comes of it.

use super::Sector;
use crate::barrier::{Feature, Side};
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use traverse_geometry::{Bounds, left_of, unit};
use traverse_solve::{Budget, Interrupt};

/// Most features of a bundle that is not divided further.
const BUNDLED: usize = 8;

/// The budget is looked at for each bundle of more features than this.
const FEATURES_BETWEEN_CHECKS: usize = 2048;

/// What a bundle's circle is larger by, as a share: above rounding and what sectors let pass.
const SLACK_RATIO: f64 = 1e-6;

/// Bundles of features, each followed by those that it is divided into.
#[derive(Default)]
pub(crate) struct Bundles(Vec<Bundle>);

struct Bundle {
    sector: Sector,
    features: Range<u32>,
    /// The first bundle that does not lie in this one.
    next: u32,
}

impl Bundles {
    /// How many bundles there are.
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Bundles the features of a barrier.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn push(
        &mut self,
        features: &[Feature],
        range: Range<usize>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        if range.is_empty() {
            return Ok(());
        }
        if range.len() > FEATURES_BETWEEN_CHECKS {
            budget.check(0)?;
        }
        let at = self.0.len();
        let sector = around(&features[range.clone()]);
        let numbers = range.start as u32..range.end as u32;
        self.0.push(Bundle { sector, features: numbers, next: 0 });
        if range.len() > BUNDLED {
            let middle = range.start.midpoint(range.end);
            self.push(features, range.start..middle, budget)?;
            self.push(features, middle..range.end, budget)?;
        }
        self.0[at].next = self.0.len() as u32;
        Ok(())
    }

    /// The first bundle from `at` on, itself not divided further, whose features a tangent that leaves `ahead` on `side`
    /// may reach: those features, and where to go on.
    pub(super) fn next_reached(
        &self,
        mut at: usize,
        end: usize,
        ahead: &Sector,
        side: Side,
    ) -> Option<(Range<u32>, usize)> {
        while at < end {
            let bundle = &self.0[at];
            if ahead.may_reach(side, &bundle.sector) == [None, None] {
                at = bundle.next as usize;
            } else if bundle.features.len() <= BUNDLED {
                return Some((bundle.features.clone(), at + 1));
            } else {
                at += 1;
            }
        }
        None
    }
}

/// A sector that has the directions of all features, and a circle round theirs.
fn around(features: &[Feature]) -> Sector {
    let middle = Bounds::of(features.iter().map(|feature| feature.center)).center();
    let reach = |feature: &Feature| (feature.center - middle).norm() + feature.plan_radius;
    let radius = features.iter().map(reach).fold(0.0, f64::max) * (1.0 + SLACK_RATIO);
    let mut range: Option<(f64, f64)> = None;
    for feature in features {
        let (low, high) = range.unwrap_or((feature.start_angle, feature.start_angle));
        let turn = (feature.start_angle - low + PI).rem_euclid(TAU) - PI;
        let from = low + turn;
        range = Some((low.min(from), high.max(from + feature.sweep)));
        if range.is_some_and(|(low, high)| high - low > PI - 1e-3) {
            range = None;
            break;
        }
    }
    match range {
        Some((low, high)) => Sector::between(middle, radius, left_of(unit(low)), left_of(unit(high))),
        None => Sector::wide(middle, radius),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::barrier::OrientedRing;
    use rand::RngExt;
    use traverse_geometry::{Point, Ring};
    use traverse_solve::{Budget, Seed};

    /// Every feature that a stance may reach lies in a bundle that it may reach, and is shown once.
    #[test]
    fn no_feature_that_may_be_reached_is_left_out() {
        let (mut shown_count, mut all_count) = (0, 0);
        for seed in 0..60 {
            let mut random = Seed(seed).stream();
            let mut features = Vec::new();
            let mut bundles = Bundles::default();
            for owner in 0..6 {
                let corners = random.random_range(3..60);
                let middle = Point::new(random.random_range(0.0..90.0), random.random_range(0.0..90.0));
                let step = TAU / f64::from(corners);
                let mut draw = |low: f64, high: f64| random.random_range(low..high);
                let at = |i: i32, aside: f64, far: f64| middle + unit(step * (f64::from(i) + aside)) * far;
                let points = (0..corners).map(|i| at(i, draw(0.1, 0.9), draw(6.0, 15.0))).collect();
                let ring = Ring::new(points, vec![]).expect("stars don't cross themselves");
                let style = traverse_geometry::CornerStyle::Round;
                let asked = [0.0, 2.0][owner % 2];
                let clearance = crate::barrier::Clearance { asked, style };
                let first = features.len();
                let outline =
                    crate::barrier::Outline { ring: OrientedRing::new(&ring, true), clearance, owner };
                outline.add_features(&mut features, &Budget::unlimited()).expect("no limit");
                bundles.push(&features, first..features.len(), &Budget::unlimited()).expect("no limit");
            }
            let sectors: Vec<Sector> = features.iter().map(Sector::of).collect();
            for (from, ahead) in sectors.iter().enumerate() {
                for side in [Side::Left, Side::Right] {
                    let mut shown = vec![0; features.len()];
                    let mut at = 0;
                    while let Some((found, next)) = bundles.next_reached(at, bundles.len(), ahead, side) {
                        found.for_each(|feature| shown[feature as usize] += 1);
                        at = next;
                    }
                    for (to, other) in sectors.iter().enumerate() {
                        let may = ahead.may_reach(side, other) != [None, None];
                        assert!(!may || shown[to] == 1, "seed {seed}: {from} to {to}");
                        assert!(shown[to] <= 1);
                    }
                    shown_count += shown.iter().sum::<usize>();
                    all_count += shown.len();
                }
            }
        }
        assert!(shown_count * 2 < all_count, "{shown_count} of {all_count}");
    }
}
