//! Where on the canvas a point of the plane comes to lie.

use super::Shown;
use traverse_geometry::{Bounds, Point, Scene};

/// Width of the canvas; everything else follows from it.
pub(super) const WIDTH: f64 = 1200.0;
/// Free border of the canvas.
pub(super) const MARGIN: f64 = 36.0;
/// The drawing is at most this high.
const GREATEST_HEIGHT: f64 = 1100.0;
/// The drawing's box is at least this high.
const LEAST_HEIGHT: f64 = 160.0;
/// Free border of the drawing, as a share of its extent.
const AIR: f64 = 0.025;

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
    pub(super) fn new(scene: &Scene, shown: &Shown<'_>, header_height: f64) -> Self {
        let extent = extent(scene, shown);
        let size = extent.size();
        let air = AIR * size.x.max(size.y).max(1e-9);
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

/// Everything that is drawn, with the barriers; a box of 1 mm when there is nothing.
fn extent(scene: &Scene, shown: &Shown<'_>) -> Bounds {
    let work_area = scene.work_area.iter().map(traverse_geometry::Polygon::bounds);
    let obstacles =
        scene.obstacles.iter().map(|obstacle| obstacle.shape.bounds().grown(scene.clearance_of(obstacle)));
    let steps = shown.paths().iter().flat_map(|path| path.edges().map(|edge| edge.bounds()));
    let ends = shown.ends().into_iter().map(|(start, target)| Bounds::of([start, target]));
    let all = work_area.chain(obstacles).chain(steps).chain(ends).fold(Bounds::EMPTY, Bounds::union);
    if all.is_empty() {
        return Bounds::of([Point::origin(), Point::new(1.0, 1.0)]);
    }
    let size = all.size();
    if size.x.max(size.y) > 0.0 { all } else { all.grown(0.5) }
}
