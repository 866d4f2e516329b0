//! The arc command of path data: from two ends, radii and flags to centre and angles, as appendix B.2 of SVG 2 says.

use super::affine::exact_sin_cos;
use super::outline::Piece;
use crate::fit::EllipticArc;
use std::f64::consts::TAU;
use traverse_geometry::{Point, Vector, cross};

/// An arc as path data gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArcCommand {
    pub(super) radii: (f64, f64),
    /// Turn of the ellipse, degrees.
    pub(super) rotation_deg: f64,
    pub(super) large: bool,
    /// Whether angles grow along it.
    pub(super) sweep: bool,
}

impl ArcCommand {
    /// From `start` to `end`: nothing when they are one point, a line when a radius is 0, larger radii when these do
    /// not reach.
    pub(super) fn piece(&self, start: Point, end: Point) -> Option<Piece> {
        let (rx, ry) = (self.radii.0.abs(), self.radii.1.abs());
        if start == end {
            return None;
        }
        if rx == 0.0 || ry == 0.0 {
            return Some(Piece::Line(end));
        }
        let (sin, cos) = exact_sin_cos(self.rotation_deg);
        let (x_axis, y_axis) = (Vector::new(cos, sin), Vector::new(-sin, cos));
        // Half the chord in coordinates where the ellipse is a unit circle.
        let chord = (end - start) / 2.0;
        let half = Vector::new(chord.dot(&x_axis) / rx, chord.dot(&y_axis) / ry);
        let reach = half.norm();
        let scale = reach.max(1.0);
        let half = half / scale;
        // From the middle of the chord to the centre, at right angles to it.
        let height = (1.0 - half.norm_squared()).max(0.0).sqrt();
        let side = if self.large == self.sweep { -1.0 } else { 1.0 };
        let to_center = if reach >= 1.0 {
            Vector::zeros()
        } else {
            Vector::new(-half.y, half.x).try_normalize(0.0)? * (height * side)
        };
        let (first, second) = (x_axis * (rx * scale), y_axis * (ry * scale));
        let center = start + chord + first * to_center.x + second * to_center.y;
        let (from, to) = (-half - to_center, half - to_center);
        let between = cross(from, to).atan2(from.dot(&to));
        let sweep = match (self.sweep, between < 0.0) {
            (true, true) => between + TAU,
            (false, false) => between - TAU,
            _ => between,
        };
        Some(Piece::Arc(EllipticArc { center, first, second, start: from.y.atan2(from.x), sweep }, end))
    }
}
