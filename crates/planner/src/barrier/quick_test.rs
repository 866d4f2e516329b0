//! A quick test that passes over most of what does not block a straight move.

use super::Blocker;
use traverse_geometry::{Bounds, Edge, Point, Segment, Vector, left_of};

/// What lies further than this beyond a blocker's limit is passed over by a quick test, millimetres: above its rounding.
pub(super) const QUICK_TEST_MARGIN_MM: f64 = 1e-8;

/// Passes over what lies clear of a line: beside it, before it or behind it.
pub(super) struct QuickTest {
    start: Point,
    along: Vector,
    across: Vector,
    length: f64,
}

impl QuickTest {
    pub(super) fn new(line: &Segment) -> Self {
        let length = line.length();
        let along = line.vector().try_normalize(0.0).unwrap_or_default();
        Self { start: line.start, along, across: left_of(along), length }
    }

    /// Whether a box lies clear of the line.
    pub(super) fn passes_box(&self, bounds: &Bounds) -> bool {
        let center = bounds.center() - self.start;
        let half = bounds.size() / 2.0;
        let reach = |axis: &Vector| half.x * axis.x.abs() + half.y * axis.y.abs() + QUICK_TEST_MARGIN_MM;
        let beyond_middle = center.dot(&self.along) - self.length / 2.0;
        center.dot(&self.across).abs() > reach(&self.across)
            || beyond_middle.abs() > reach(&self.along) + self.length / 2.0
    }

    /// Whether a straight blocker lies clear of the line.
    pub(super) fn passes_over(&self, blocker: &Blocker) -> bool {
        let Edge::Segment(edge) = &blocker.edge else { return false };
        self.passes_strip(edge.start, edge.end, blocker.limit)
    }

    /// Whether all within `reach` of the segment from `a` to `b` lies clear of the line.
    pub(super) fn passes_strip(&self, a: Point, b: Point, reach: f64) -> bool {
        let margin = reach + QUICK_TEST_MARGIN_MM;
        let (a, b) = (a - self.start, b - self.start);
        let (a_across, b_across) = (a.dot(&self.across), b.dot(&self.across));
        let (a_along, b_along) = (a.dot(&self.along), b.dot(&self.along));
        a_across.min(b_across) > margin
            || a_across.max(b_across) < -margin
            || a_along.min(b_along) > self.length + margin
            || a_along.max(b_along) < -margin
    }
}
