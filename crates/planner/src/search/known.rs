//! The barriers that a search has met so far. Those that it has not met bend no path; they block all the same.

use super::bundles::Bundles;
use super::circles::Circles;
use super::sector::Sector;
use super::{Ground, Stretches};
use crate::barrier::Feature;
use crate::barriers::{Barriers, Marks};
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};
use traverse_geometry::{Point, Segment};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 4096;

/// A scene's barriers, or some of them, and which of these were met.
pub(crate) struct Known<'a> {
    barriers: &'a Barriers<'a>,
    /// Owners that are there at all.
    there: Marks,
    /// Owners that were met.
    met: Marks,
    /// Features of what was met.
    pub(crate) features: Vec<Feature>,
    /// Their directions, for the quick test.
    sectors: Vec<Sector>,
    pub(super) bundles: Bundles,
    /// Per feature the stretches of its range that nothing blocks, worked out when first asked for.
    free: Vec<OnceCell<Stretches>>,
    circles: Circles,
}

/// A barrier that was just met.
pub(crate) struct Met {
    /// Its features.
    pub(crate) features: Range<usize>,
    /// Their bundles.
    pub(crate) bundles: Range<usize>,
    /// Whether any of them lies on the circle of another.
    pub(crate) has_same_circles: bool,
}

/// What lies in the way of a straight move.
pub(crate) enum Way {
    /// Nothing.
    Free,
    /// A barrier that was met.
    Blocked,
    /// None that was met; nearest to its beginning the barrier of this owner.
    Meets(usize),
}

impl<'a> Known<'a> {
    /// Nothing met yet. `left_out` is taken for not there.
    pub(crate) fn new(barriers: &'a Barriers<'a>, left_out: &BTreeSet<usize>) -> Self {
        let mut there = barriers.there();
        left_out.iter().for_each(|&owner| there.set(owner, false));
        Self {
            barriers,
            there,
            met: Marks::of(barriers.scene.obstacles.len(), false),
            features: Vec::new(),
            sectors: Vec::new(),
            bundles: Bundles::default(),
            free: Vec::new(),
            circles: Circles::default(),
        }
    }

    /// Owners of the barriers that were met.
    pub(crate) fn met(&self) -> impl Iterator<Item = usize> {
        self.barriers.owners().filter(|&owner| self.met.has(owner))
    }

    pub(crate) fn was_met(&self, owner: usize) -> bool {
        self.met.has(owner)
    }

    /// Meets the owner's barrier.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn meet(&mut self, owner: usize, budget: &Budget) -> Result<Met, Interrupt> {
        let first = self.features.len();
        self.met.set(owner, true);
        for outline in self.barriers.outlines(owner) {
            outline.add_features(&mut self.features, budget)?;
        }
        for feature in first..self.features.len() {
            if feature % FEATURES_BETWEEN_CHECKS == 0 {
                budget.check(0)?;
            }
            self.sectors.push(Sector::of(&self.features[feature]));
            self.circles.push(&self.features[feature]);
        }
        self.free.resize_with(self.features.len(), OnceCell::new);
        let features = first..self.features.len();
        let bundles = self.bundles.len();
        self.bundles.push(&self.features, features.clone(), budget)?;
        let bundles = bundles..self.bundles.len();
        let mut has_same_circles = false;
        for feature in features.clone() {
            if feature % FEATURES_BETWEEN_CHECKS == 0 {
                budget.check(0)?;
            }
            has_same_circles |= self.on_same_circle(feature as u32).next().is_some();
            if has_same_circles {
                break;
            }
        }
        Ok(Met { features, bundles, has_same_circles })
    }

    /// What lies in the way from `from` to `to`.
    pub(crate) fn way(&self, from: Point, to: Point) -> Way {
        if from == to {
            return Way::Free;
        }
        let mut met = false;
        let mut nearest: Option<(f64, usize)> = None;
        self.barriers.blocking(&Segment::new(from, to), |blocker| {
            if !self.there.has(blocker.owner) {
                return ControlFlow::Continue(());
            }
            if self.met.has(blocker.owner) {
                met = true;
                return ControlFlow::Break(());
            }
            let found = (blocker.edge.distance_to_point(from), blocker.owner);
            if nearest.is_none_or(|known| found < known) {
                nearest = Some(found);
            }
            ControlFlow::Continue(())
        });
        match nearest {
            _ if met => Way::Blocked,
            Some((_, owner)) => Way::Meets(owner),
            None => Way::Free,
        }
    }
}

impl Ground for Known<'_> {
    fn feature(&self, feature: u32) -> &Feature {
        &self.features[feature as usize]
    }

    fn sector(&self, feature: u32) -> &Sector {
        &self.sectors[feature as usize]
    }

    /// Worked out when first asked for, against all barriers, met or not.
    fn stretches(&self, feature: u32) -> &Stretches {
        self.free[feature as usize].get_or_init(|| {
            let feature = &self.features[feature as usize];
            // A control point is no arc: whether it can be passed is decided by the moves that meet there.
            if feature.plan_radius == 0.0 {
                return Stretches::all(feature);
            }
            let blocked = self.barriers.blocked_offsets(feature);
            Stretches::of(feature, blocked.filter(|&(_, _, owner)| self.there.has(owner)))
        })
    }

    fn knows_stretches(&self, feature: u32) -> bool {
        self.free[feature as usize].get().is_some()
    }

    fn on_same_circle(&self, feature: u32) -> impl Iterator<Item = u32> {
        let near = self.circles.near(self.feature(feature));
        near.filter(move |&other| other != feature && self.is_same_circle(feature, other))
    }
}
