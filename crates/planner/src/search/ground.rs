//! What a search stands on: the features that its paths may bend round.

use super::{Sector, Tangent};
use crate::barrier::{Feature, Side};

/// Features by number, and what is known of each.
pub(crate) trait Ground {
    /// The feature.
    fn feature(&self, feature: u32) -> &Feature;

    /// Its directions, for the quick test.
    fn sector(&self, feature: u32) -> &Sector;

    /// The stretches of its range that nothing blocks.
    fn stretches(&self, feature: u32) -> &Stretches;

    /// Whether these have been worked out.
    fn knows_stretches(&self, feature: u32) -> bool;

    /// Other features on the same circle.
    fn on_same_circle(&self, feature: u32) -> impl Iterator<Item = u32>;

    /// Whether two features lie on the same circle.
    fn is_same_circle(&self, one: u32, other: u32) -> bool {
        super::circles::is_same_circle(self.feature(one), self.feature(other))
    }

    /// Whether a path passes from one feature to the other without a straight move.
    fn goes_over(&self, one: u32, other: u32) -> bool {
        let feature = self.feature(one);
        let neighbour = Some(other);
        feature.after == neighbour || feature.before == neighbour || self.is_same_circle(one, other)
    }

    /// The straight move along the border of a mitred barrier from one feature to the other, where one is an arc and both
    /// are neighbours. On `side` of the way lie both.
    fn along_border(&self, from: u32, to: u32, side: Side) -> Option<Tangent> {
        let (one, other) = (self.feature(from), self.feature(to));
        let (at, onto) = match side {
            Side::Left => (one.straight_after == Some(to)).then_some((one.sweep, 0.0))?,
            Side::Right => (other.straight_after == Some(from)).then_some((0.0, other.sweep))?,
        };
        let normal = -other.direction_at(onto) * side.sign();
        Some(Tangent::along(one.plan_point(at), other.plan_point(onto), normal))
    }
}

/// The stretches of a feature's range that no barrier blocks, in order, and whose barriers block the rest.
pub(crate) struct Stretches {
    pub(crate) free: Vec<(f64, f64)>,
    pub(crate) blocked_by: Vec<usize>,
}

impl Stretches {
    /// What `blocked`, ranges of offsets with their owners, leaves of the feature's range.
    pub(crate) fn of(feature: &Feature, blocked: impl Iterator<Item = (f64, f64, usize)>) -> Self {
        let mut blocked: Vec<(f64, f64, usize)> = blocked.collect();
        let mut blocked_by: Vec<usize> = blocked.iter().map(|&(_, _, owner)| owner).collect();
        blocked_by.sort_unstable();
        blocked_by.dedup();
        blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut free = Vec::new();
        let mut free_from = 0.0_f64;
        for (from, to, _) in blocked {
            if from >= free_from && (from > 0.0 || free_from > 0.0) {
                free.push((free_from, from));
            }
            free_from = free_from.max(to);
        }
        if free_from < feature.sweep || (free_from == 0.0 && feature.sweep == 0.0) {
            free.push((free_from, feature.sweep));
        }
        Self { free, blocked_by }
    }

    /// All of a feature's range.
    pub(crate) fn all(feature: &Feature) -> Self {
        Self { free: vec![(0.0, feature.sweep)], blocked_by: Vec::new() }
    }

    /// The free stretch that holds `offset` within `tolerance`, if any.
    pub(crate) fn at(&self, offset: f64, tolerance: f64) -> Option<usize> {
        self.free.iter().position(|&(from, to)| from - tolerance <= offset && offset <= to + tolerance)
    }
}
