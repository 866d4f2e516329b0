//! Whether a shape climbs: it is drawn as seen from above, and that has to be told.

use super::groups::Group;

/// Heights that differ by less differ by rounding; the unit is the file's.
const HEIGHT_TOLERANCE: f64 = 1e-9;

/// The heights of a shape's points.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Heights {
    first: Option<f64>,
    vary: bool,
}

impl Heights {
    /// One more. What is no number differs from all.
    pub(super) fn note(&mut self, z: f64) {
        let first = *self.first.get_or_insert(z);
        // Not a number: neither below nor above.
        let same = (z - first).abs() <= HEIGHT_TOLERANCE;
        self.vary |= !same;
    }

    /// Whether there are two.
    pub(super) fn vary(&self) -> bool {
        self.vary
    }
}

/// The height that a group says. It moves nothing, so what is no number refuses no file.
pub(super) fn height(group: &Group<'_>) -> f64 {
    group.real().unwrap_or(f64::NAN)
}
