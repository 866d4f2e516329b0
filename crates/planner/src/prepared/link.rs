//! A tangent from one feature to another that nothing blocks: what a prepared scene keeps by the hundred thousand.

use crate::barrier::Side;

/// The bit that says on which side the circle lies that a link reaches.
const RIGHT: u32 = 1 << 31;

/// A tangent from one feature to another that nothing blocks. 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    to: u32,
    angle_error: f32,
    /// Offsets at which it leaves and arrives.
    pub(crate) left_at: f64,
    pub(crate) offset: f64,
    /// Its length on the answered path, millimetres.
    pub(crate) length: f64,
}

impl Link {
    /// To `feature`, which it touches on `side`; its direction is known to `angle_error` radians.
    pub(super) fn to(feature: u32, side: Side, angle_error: f64) -> Self {
        let to = if side == Side::Right { feature | RIGHT } else { feature };
        Self { to, angle_error: angle_error as f32, left_at: 0.0, offset: 0.0, length: 0.0 }
    }

    /// The feature that it reaches.
    pub(crate) fn feature(&self) -> u32 {
        self.to & !RIGHT
    }

    /// On which side of the way the circle lies that it reaches.
    pub(crate) fn side(&self) -> Side {
        if self.to & RIGHT == 0 { Side::Left } else { Side::Right }
    }

    /// How far its direction may be off by rounding, radians.
    pub(crate) fn angle_error(&self) -> f64 {
        f64::from(self.angle_error)
    }

    /// Whether both reach the same feature on the same side.
    pub(super) fn leads_where(&self, other: &Self) -> bool {
        self.to == other.to
    }
}
