//! A curve that grows edge by edge, within a budget of vertices.

use super::affine::Affine;
use super::budget::VertexBudget;
use super::nurbs::Bezier;
use crate::curve::CurveBuilder;
use crate::fit::{Smooth, fitted_edges};
use crate::{Curve, ReadError};
use traverse_geometry::{FLAT_ARC_MM, Point, left_of};

/// A bulge a little above that of a quarter turn, tan(π / 8).
const QUARTER_TURN: f64 = 0.4143;

/// A curve that grows edge by edge.
pub(super) struct Chain<'a> {
    builder: CurveBuilder,
    tolerance_mm: f64,
    /// How far the edges run from what was drawn, as far as it has grown.
    deviation_mm: f64,
    budget: &'a mut VertexBudget,
}

impl<'a> Chain<'a> {
    /// A chain that begins at `start`. What is fitted keeps within the tolerance.
    pub(super) fn from(start: Point, tolerance_mm: f64, budget: &'a mut VertexBudget) -> Self {
        Self { builder: CurveBuilder::from(start), tolerance_mm, deviation_mm: 0.0, budget }
    }

    /// Goes on to `end` by an edge of that bulge.
    pub(super) fn edge(self, bulge: f64, end: Point) -> Result<Self, ReadError> {
        // More than half a turn becomes two edges.
        self.budget.take(if bulge.abs() > 1.0 { 2 } else { 1 })?;
        Ok(Self { builder: self.builder.edge(bulge, end), ..self })
    }

    /// Goes on along a smooth curve; `end` is where that ends, but for rounding.
    pub(super) fn smooth(mut self, curve: &impl Smooth, end: Point) -> Result<Self, ReadError> {
        let edges = fitted_edges(curve, self.tolerance_mm, self.budget.left());
        let edges = edges.ok_or_else(|| self.budget.exceeded())?;
        self.deviation_mm = self.tolerance_mm;
        let last = edges.len().saturating_sub(1);
        for (i, (bulge, edge_end)) in edges.into_iter().enumerate() {
            self = self.edge(bulge, if i == last { end } else { edge_end })?;
        }
        Ok(self)
    }

    /// Goes on along a circular arc that a map makes an ellipse's.
    pub(super) fn mapped_arc(
        self,
        start: Point,
        end: Point,
        bulge: f64,
        map: &Affine,
    ) -> Result<Self, ReadError> {
        let chord = end - start;
        let height = left_of(chord) * (bulge / 2.0);
        if start == end || map.vector(height).norm() <= FLAT_ARC_MM {
            return self.edge(0.0, map.point(end));
        }
        if bulge.abs() > QUARTER_TURN {
            // tan(sweep / 8): half of the arc.
            let half = (bulge.atan() / 2.0).tan();
            let top = start + chord / 2.0 - height;
            return self.mapped_arc(start, top, half, map)?.mapped_arc(top, end, half, map);
        }
        self.smooth(&Bezier::of_arc(start, end, bulge, map), map.point(end))
    }

    /// The curve with two loose ends; none when it has no length.
    pub(super) fn open(self) -> Result<Option<Curve>, ReadError> {
        self.budget.take(1)?;
        Ok(self.builder.open().map(|curve| Curve { deviation_mm: self.deviation_mm, ..curve }))
    }

    /// The closed curve; its last edge came back to the start. None when it has no length.
    pub(super) fn closed(self) -> Result<Option<Curve>, ReadError> {
        Ok(self.builder.closed().map(|curve| Curve { deviation_mm: self.deviation_mm, ..curve }))
    }
}
