//! What the layers of a drawing stand for.

use crate::{LayerPattern, LayerRole};

/// Layers of these names are the work area unless [`Roles`] says otherwise.
pub const WORK_AREA_LAYERS: [&str; 3] = ["WORK_AREA", "WORKAREA", "TABLE"];

/// What the layers of a drawing stand for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Roles {
    /// Layers that bound the work area. Default: [`WORK_AREA_LAYERS`].
    pub work_area: Vec<LayerPattern>,
    /// Layers that hold obstacles. Default: `*`. A layer of the work area is never one of obstacles.
    pub obstacles: Vec<LayerPattern>,
}

impl Default for Roles {
    fn default() -> Self {
        Self {
            work_area: WORK_AREA_LAYERS.map(LayerPattern::new).to_vec(),
            obstacles: vec![LayerPattern::new("*")],
        }
    }
}

impl Roles {
    /// What a layer of that name stands for.
    #[must_use]
    pub fn of(&self, layer: &str) -> LayerRole {
        let chosen = |patterns: &[LayerPattern]| patterns.iter().any(|pattern| pattern.fits(layer));
        if chosen(&self.work_area) {
            LayerRole::WorkArea
        } else if chosen(&self.obstacles) {
            LayerRole::Obstacles
        } else {
            LayerRole::None
        }
    }

    /// Patterns that were asked for by name and fit none of the layers.
    pub(crate) fn unmatched<'a>(&self, layers: impl Iterator<Item = &'a str> + Clone) -> Vec<LayerPattern> {
        let defaults = Self::default();
        self.work_area
            .iter()
            .filter(|pattern| !defaults.work_area.contains(pattern))
            .chain(self.obstacles.iter().filter(|pattern| !defaults.obstacles.contains(pattern)))
            .filter(|pattern| !layers.clone().any(|layer| pattern.fits(layer)))
            .cloned()
            .collect()
    }
}
