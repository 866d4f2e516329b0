//! Where on the canvas a point of the plane comes to lie.

use traverse_geometry::{Bounds, Point};

/// Width of the canvas; everything else follows from it. Letters are about a fiftieth of it, so that they can be read
/// in a picture of 400 pixels too.
pub(super) const WIDTH: f64 = 1000.0;
/// Free border of the canvas.
pub(super) const MARGIN: f64 = 30.0;
/// The drawing is at most this high.
const GREATEST_HEIGHT: f64 = 940.0;
/// The drawing's box is at least this high.
const LEAST_HEIGHT: f64 = 160.0;

/// A rectangle of the canvas, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box2 {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Box2 {
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    pub(super) fn within(&self, other: &Self) -> bool {
        self.left >= other.left
            && self.right <= other.right
            && self.top >= other.top
            && self.bottom <= other.bottom
    }

    /// The box with `air` around it.
    pub(super) fn grown(&self, air: f64) -> Self {
        Self {
            left: self.left - air,
            top: self.top - air,
            right: self.right + air,
            bottom: self.bottom + air,
        }
    }

    /// The square of half side `r` around a point.
    pub(super) fn around((x, y): (f64, f64), r: f64) -> Self {
        Self { left: x - r, top: y - r, right: x + r, bottom: y + r }
    }

    /// Distance from a point, 0 inside.
    pub(super) fn distance(&self, (x, y): (f64, f64)) -> f64 {
        let dx = (self.left - x).max(x - self.right).max(0.0);
        let dy = (self.top - y).max(y - self.bottom).max(0.0);
        dx.hypot(dy)
    }
}

/// Maps millimetres, y up, to the canvas, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    /// Canvas units per millimetre.
    pub(super) scale: f64,
    /// The box that the drawing fills.
    pub(super) area: Box2,
    origin: Point,
    shift: (f64, f64),
}

impl Frame {
    /// Shows `extent`, a box of 1 mm when that is empty, with a free border of `air`, a share of its size.
    pub(super) fn new(extent: Bounds, air: f64, header_height: f64) -> Self {
        let extent = with_size(extent);
        let size = extent.size();
        let air = air * size.x.max(size.y).max(1e-9);
        let extent = extent.grown(air);
        let size = extent.size();
        let width = WIDTH - 2.0 * MARGIN;
        let scale = (width / size.x).min(GREATEST_HEIGHT / size.y);
        let top = MARGIN + header_height;
        let height = (size.y * scale).max(LEAST_HEIGHT);
        let area = Box2 { left: MARGIN, top, right: MARGIN + width, bottom: top + height };
        let shift =
            (area.left + (width - size.x * scale) / 2.0, area.bottom - (height - size.y * scale) / 2.0);
        Self { scale, area, origin: extent.min, shift }
    }

    pub(super) fn place(&self, p: Point) -> (f64, f64) {
        (self.shift.0 + (p.x - self.origin.x) * self.scale, self.shift.1 - (p.y - self.origin.y) * self.scale)
    }

    /// The point of the plane that lies there.
    pub(super) fn point(&self, (x, y): (f64, f64)) -> Point {
        let (x, y) = ((x - self.shift.0) / self.scale, (self.shift.1 - y) / self.scale);
        Point::new(self.origin.x + x, self.origin.y + y)
    }
}

/// The box, of a size above 0.
fn with_size(extent: Bounds) -> Bounds {
    if extent.is_empty() {
        return Bounds::of([Point::origin(), Point::new(1.0, 1.0)]);
    }
    let size = extent.size();
    if size.x.max(size.y) > 0.0 { extent } else { extent.grown(0.5) }
}
