//! The barriers that a search looks at: some of a scene's, so that what it finds bounds the scene's optimum.

use crate::barrier::{Blocker, Feature, Obstruction};
use std::cell::OnceCell;
use traverse_solve::{Budget, Interrupt};

/// A set of barriers.
#[derive(Default)]
pub(crate) struct Relaxation {
    pub(crate) features: Vec<Feature>,
    pub(crate) obstruction: Obstruction,
    /// Per feature the stretches of its range that nothing blocks, worked out when first asked for.
    free: Vec<OnceCell<Vec<(f64, f64)>>>,
}

impl Relaxation {
    /// Adds one barrier. `features` link to each other by indices from 0 on.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn add(
        &mut self,
        blockers: &[Blocker],
        features: &[Feature],
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let first = self.features.len();
        self.features.extend(features.iter().map(|feature| Feature {
            before: feature.before.map(|i| i + first),
            after: feature.after.map(|i| i + first),
            ..*feature
        }));
        self.obstruction.add(blockers, budget)?;
        // What is new may block arcs that were free.
        self.free.clear();
        self.free.resize_with(self.features.len(), OnceCell::new);
        Ok(())
    }

    /// The stretches of the feature's range that no barrier blocks, in order.
    pub(crate) fn free_stretches(&self, feature: usize) -> &[(f64, f64)] {
        self.free[feature].get_or_init(|| {
            let feature = &self.features[feature];
            // A control point is no arc: whether it can be passed is decided by the moves that meet there.
            if feature.plan_radius == 0.0 {
                return vec![(0.0, feature.sweep)];
            }
            let mut blocked: Vec<(f64, f64)> =
                self.obstruction.blocked_offsets(feature).map(|(from, to, _)| (from, to)).collect();
            blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut stretches = Vec::new();
            let mut free_from = 0.0_f64;
            for (from, to) in blocked {
                if from >= free_from && (from > 0.0 || free_from > 0.0) {
                    stretches.push((free_from, from));
                }
                free_from = free_from.max(to);
            }
            if free_from < feature.sweep || (free_from == 0.0 && feature.sweep == 0.0) {
                stretches.push((free_from, feature.sweep));
            }
            stretches
        })
    }

    /// Whether the feature's stretches have been worked out.
    pub(crate) fn knows_stretches(&self, feature: usize) -> bool {
        self.free[feature].get().is_some()
    }

    /// The free stretch of the feature that holds `offset`, if any.
    pub(crate) fn stretch_at(&self, feature: usize, offset: f64) -> Option<usize> {
        let tolerance = self.features[feature].offset_tolerance();
        self.free_stretches(feature)
            .iter()
            .position(|&(from, to)| from - tolerance <= offset && offset <= to + tolerance)
    }
}
