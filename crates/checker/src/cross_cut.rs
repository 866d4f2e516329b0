//! A cut across the corridor: which edges it meets, and what covers the places between them.

use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::curve::{Curve, right_of};
use crate::inside::is_inside;
use traverse_geometry::{Point, Vector};

/// An edge that the cut meets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// Millimetres left of the step.
    pub(crate) offset: f64,
    pub(crate) edge: u32,
    pub(crate) curve: Curve,
    /// Where on the edge.
    pub(crate) fraction: f64,
}

/// A cut across the corridor at one place.
#[derive(Clone, Debug)]
pub(crate) struct CrossCut {
    pub(crate) at: Point,
    left: Vector,
    reach: f64,
    /// From right to left.
    pub(crate) lines: Vec<Line>,
}

impl CrossCut {
    /// The cut at `fraction` of `step`, through those of `edges` that it meets within `reach`.
    pub(crate) fn across(
        boundary: &Boundary,
        step: &Curve,
        fraction: f64,
        edges: &[u32],
        reach: f64,
    ) -> Self {
        let (at, along) = (step.point_at(fraction), step.direction_at(fraction));
        let left = -right_of(along);
        let mut lines: Vec<Line> = Vec::new();
        for &edge in edges {
            let curve = boundary.curve(edge);
            let mut cuts = Vec::new();
            curve.cut_by_line(at, along, 0.0, &mut cuts);
            for fraction in cuts {
                let offset = left.dot(&(curve.point_at(fraction) - at));
                if offset.abs() <= reach {
                    lines.push(Line { offset, edge, curve, fraction });
                }
            }
        }
        lines.sort_by(|one, other| one.offset.total_cmp(&other.offset));
        Self { at, left, reach, lines }
    }

    /// A solid of these edges that covers the place `offset` left of the step.
    pub(crate) fn cover(&self, offset: f64, boundary: &Boundary, tree: &BoundaryTree) -> Option<u32> {
        let p = self.at + self.left * offset;
        self.lines
            .iter()
            .map(|line| boundary.solid_of(line.edge))
            .find(|&solid| is_inside(boundary, tree, p, solid))
    }

    /// What covers the place between the rightmost edge and the right wall.
    pub(crate) fn cover_right(&self, boundary: &Boundary, tree: &BoundaryTree) -> Option<u32> {
        self.cover((self.lines.first()?.offset - self.reach) / 2.0, boundary, tree)
    }

    /// What covers the place between the leftmost edge and the left wall.
    pub(crate) fn cover_left(&self, boundary: &Boundary, tree: &BoundaryTree) -> Option<u32> {
        self.cover((self.lines.last()?.offset + self.reach) / 2.0, boundary, tree)
    }
}
