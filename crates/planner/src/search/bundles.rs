//! Features by bundles: what leaves out most of them at once when a stance looks for tangents.
//!
//! Neighbouring features of a barrier are bundled, bundles of neighbours too, and so on. A bundle has the directions of all of
//! its features, and their centres lie near its axis: a point, or where a border runs along, a segment. So a tangent to any of
//! them passes the bundle's test as well, and on a border that bends gently hardly more do.
//!
//! Cost: building is n log n; a stance tests a bundle where it may reach the one that it lies in, about log n for each
//! tangent that comes of it.

use super::Sector;
use super::directions::Directions;
use super::sector::slack;
use crate::barrier::{Feature, Side};
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use traverse_geometry::{Bounds, Segment};
use traverse_solve::{Budget, Interrupt};

/// Most features of a bundle that is not divided further.
const BUNDLED: usize = 8;

/// The budget is looked at for each bundle of more features than this.
const FEATURES_BETWEEN_CHECKS: usize = 2048;

/// What a bundle reaches further by, as a share: above rounding and what sectors let pass.
const SLACK_RATIO: f64 = 1e-6;

/// Bundles of features, each followed by those that it is divided into.
#[derive(Default)]
pub(crate) struct Bundles(Vec<Bundle>);

struct Bundle {
    /// Centres lie within `reach` of this.
    axis: Segment,
    reach: f64,
    /// Least and greatest radius.
    radii: [f64; 2],
    directions: Directions,
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
        let numbers = range.start as u32..range.end as u32;
        self.0.push(Bundle::of(&features[range.clone()], numbers));
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
            if !bundle.may_be_reached(ahead, side) {
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

impl Bundle {
    /// Features with these numbers. What lies in it is not known yet.
    fn of(features: &[Feature], numbers: Range<u32>) -> Self {
        let directions = directions(features);
        let (axis, reach) = axis(features, directions.near.is_finite());
        let radius = |feature: &Feature| feature.plan_radius;
        let least = features.iter().map(radius).fold(f64::INFINITY, f64::min);
        let greatest = features.iter().map(radius).fold(0.0, f64::max);
        let radii = [least * (1.0 - SLACK_RATIO), greatest * (1.0 + SLACK_RATIO)];
        Self { axis, reach, radii, directions, features: numbers, next: 0 }
    }

    /// Whether a tangent that leaves `ahead` on `side` may touch one of the circles: as [`Sector::may_reach`], for centres and
    /// radii that are not known better.
    fn may_be_reached(&self, ahead: &Sector, side: Side) -> bool {
        let ends = [self.axis.start, self.axis.end].map(|end| end - ahead.center);
        let slack = self.reach + slack(ends[0]).max(slack(ends[1]));
        let admits = |other_side: Side, across: f64, slack: f64| {
            ahead.directions.admits(side, &ends, across, slack)
                && self.directions.admits(other_side, &ends, across, slack)
        };
        let either_side = slack + ahead.radius + self.radii[1];
        let near = ahead.directions.near.max(self.directions.near);
        if near.is_infinite() {
            let by_bundle = |other_side| self.directions.admits(other_side, &ends, 0.0, either_side);
            return ahead.directions.admits(side, &ends, 0.0, either_side)
                && (by_bundle(Side::Left) || by_bundle(Side::Right));
        }
        let nearest = self.axis.distance_to_point(ahead.center) - self.reach;
        [Side::Left, Side::Right].into_iter().any(|other_side| {
            let across = self.radii.map(|radius| radius * other_side.sign() - ahead.radius * side.sign());
            if nearest < near * across[0].abs().max(across[1].abs()) {
                return admits(other_side, 0.0, either_side);
            }
            admits(other_side, across[0].midpoint(across[1]), slack + (across[1] - across[0]).abs())
        })
    }
}

/// A point near which all centres lie, or where that is nearer a chord of a border that bends `gently`, and how near,
/// millimetres.
fn axis(features: &[Feature], gently: bool) -> (Segment, f64) {
    let reach = |axis: &Segment| {
        let far = features.iter().map(|feature| axis.distance_to_point(feature.center));
        far.fold(0.0, f64::max) * (1.0 + SLACK_RATIO)
    };
    let middle = Bounds::of(features.iter().map(|feature| feature.center)).center();
    let point = Segment::new(middle, middle);
    let of_point = reach(&point);
    let [first, .., last] = features else { return (point, of_point) };
    let chord = Segment::new(first.center, last.center);
    let of_chord = if gently { reach(&chord) } else { f64::INFINITY };
    if of_chord < of_point { (chord, of_chord) } else { (point, of_point) }
}

/// The directions of all features.
fn directions(features: &[Feature]) -> Directions {
    let mut range: Option<(f64, f64)> = None;
    for feature in features {
        let (low, high) = range.unwrap_or((feature.start_angle, feature.start_angle));
        let turn = (feature.start_angle - low + PI).rem_euclid(TAU) - PI;
        let from = low + turn;
        let (low, high) = (low.min(from), high.max(from + feature.sweep));
        if high - low > PI - 1e-3 {
            return Directions::ALL;
        }
        range = Some((low, high));
    }
    range.map_or(Directions::ALL, |(low, high)| Directions::touching(low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::barrier::OrientedRing;
    use crate::search::Tangent;
    use rand::RngExt;
    use traverse_geometry::{Point, Ring, unit};
    use traverse_solve::{Budget, Seed};

    /// Whether a tangent from within the range of one feature leads into that of another.
    fn leads(side: Side, from: &Feature, to_side: Side, to: &Feature) -> bool {
        let [rho1, rho2] = [(from, side), (to, to_side)].map(|(it, side)| it.plan_radius * side.sign());
        Tangent::between(from.center, rho1, to.center, rho2).is_some_and(|tangent| {
            [(from, side), (to, to_side)]
                .iter()
                .all(|(it, side)| it.offset_of(-tangent.normal * side.sign(), tangent.angle_error).is_some())
        })
    }

    /// Every feature that a tangent leads to lies in a bundle that may be reached, and is shown once.
    #[test]
    fn no_feature_that_a_tangent_leads_to_is_left_out() {
        let (mut shown_count, mut all_count) = (0, 0);
        for seed in 0..60 {
            let mut random = Seed(seed).stream();
            let mut features = Vec::new();
            let mut bundles = Bundles::default();
            for owner in 0..6 {
                // The last one is long and bends gently.
                let is_long = owner == 5;
                let corners =
                    if is_long { random.random_range(100..250) } else { random.random_range(3..60) };
                let middle = Point::new(random.random_range(0.0..90.0), random.random_range(0.0..90.0));
                let step = TAU / f64::from(corners);
                let mut draw = |low: f64, high: f64| random.random_range(low..high);
                let at = |i: i32, aside: f64, far: f64| middle + unit(step * (f64::from(i) + aside)) * far;
                let points = (0..corners)
                    .map(|i| if is_long { at(i, 0.5, 30.0) } else { at(i, draw(0.1, 0.9), draw(6.0, 15.0)) });
                let points = points.collect();
                let ring = Ring::new(points, vec![]).expect("stars don't cross themselves");
                let style = traverse_geometry::CornerStyle::Round;
                let asked = [0.0, 2.0][(owner + seed as usize) % 2];
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
                        let may = ahead.may_reach(side, other).into_iter().flatten();
                        let leads = |to_side| leads(side, &features[from], to_side, &features[to]);
                        if shown[to] == 0 {
                            assert!(!may.into_iter().any(leads), "seed {seed}: {from} to {to}");
                        }
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
