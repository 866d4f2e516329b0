//! Placeholder body: the API is final, the checks are being filled in.

use crate::Violation;
use traverse_geometry::{Path, Point, Scene};

/// What checking a path found.
#[derive(Clone, Debug, PartialEq)]
pub struct PathCheck {
    /// What is wrong; empty: the path is sound.
    pub violations: Vec<Violation>,
    /// The path's length, recomputed, millimetres. NaN when a number of the path is not finite.
    pub cost: f64,
    /// Over the whole path: distance to the nearest obstacle or border less the clearance asked for it.
    /// Negative: too near. None: nothing is in the way, or a number of the path is not finite.
    pub smallest_margin_mm: Option<f64>,
}

impl PathCheck {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.violations.is_empty()
    }
}

/// Checks `path` from `start` to `target` in `scene`.
#[must_use]
pub fn check_rapid_move(scene: &Scene, start: Point, target: Point, path: &Path, tolerance_mm: f64) -> PathCheck {
    let _ = (scene, start, target, tolerance_mm);
    PathCheck { violations: Vec::new(), cost: path.length(), smallest_margin_mm: None }
}
