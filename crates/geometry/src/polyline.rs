//! An open chain of straight and circular edges.

use crate::chain_input::{ChainInput, Closure};
use crate::{Bounds, Edge, Finding, Point, Reason};

/// An open chain: edge `i` runs from vertex `i` to vertex `i + 1`. At least one edge, none of length 0. It may touch
/// and cross itself and end where it began.
///
/// Always valid: built by [`Polyline::new`] or [`Polyline::from_xy`], which report every finding at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    vertices: Vec<Point>,
    /// Empty when every edge is straight, otherwise one per edge.
    bulges: Vec<f64>,
}

impl Polyline {
    /// A chain through `vertices`, edge `i` with `bulges[i]`: one fewer than vertices, or none when all are straight.
    /// Consecutive equal vertices are dropped, as for [`crate::Ring::new`]. Cost: linear.
    ///
    /// # Errors
    /// Everything that is wrong, at once, as for [`crate::Ring::new`], apart from area and crossings.
    pub fn new(vertices: Vec<Point>, bulges: Vec<f64>) -> Result<Self, Vec<Finding>> {
        Self::validated(ChainInput::from_vertices(vertices, bulges, Closure::Open))
    }

    /// A chain from x0, y0, x1, y1, … as they are on the wire; otherwise as [`Polyline::new`].
    ///
    /// # Errors
    /// As [`Polyline::new`], and an odd count of numbers.
    pub fn from_xy(xy_mm: &[f64], bulges: &[f64]) -> Result<Self, Vec<Finding>> {
        Self::validated(ChainInput::from_xy(xy_mm, bulges, Closure::Open))
    }

    fn validated(mut input: ChainInput) -> Result<Self, Vec<Finding>> {
        let count = input.vertices.len();
        if input.is_placed() && count < 2 {
            let message = format!(
                "{count} distinct vertices; an open chain needs at least 2, none equal to the one before it"
            );
            input.findings.push(|| Finding::new("xy_mm", Reason::TooFewVertices, count, message));
        }
        if input.findings.is_empty() {
            Ok(Self::trusted(input.vertices, input.bulges))
        } else {
            Err(input.findings.into_findings("xy_mm"))
        }
    }

    /// A chain from parts that are known to be valid.
    pub(crate) fn trusted(vertices: Vec<Point>, bulges: Vec<f64>) -> Self {
        debug_assert!(vertices.len() >= 2);
        debug_assert!(bulges.is_empty() || bulges.len() + 1 == vertices.len());
        Self { vertices, bulges }
    }

    /// The vertices, in order.
    #[must_use]
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// One bulge per edge, or none when every edge is straight.
    #[must_use]
    pub fn bulges(&self) -> &[f64] {
        &self.bulges
    }

    /// Count of edges, at least 1.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.vertices.len() - 1
    }

    /// Where the chain begins.
    #[must_use]
    pub fn start(&self) -> Point {
        self.vertices[0]
    }

    /// Where the chain ends.
    #[must_use]
    pub fn end(&self) -> Point {
        self.vertices[self.vertices.len() - 1]
    }

    /// Every edge, in order.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = Edge> + DoubleEndedIterator + '_ {
        (0..self.edge_count()).map(|i| {
            Edge::from_bulge(
                self.vertices[i],
                self.vertices[i + 1],
                self.bulges.get(i).copied().unwrap_or(0.0),
            )
        })
    }

    /// Millimetres along the chain. Cost: linear.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }

    /// Bounding box. Cost: linear.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.edges().fold(Bounds::EMPTY, |bounds, edge| bounds.union(edge.bounds()))
    }

    /// The same chain, run from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let vertices = self.vertices.iter().rev().copied().collect();
        Self { vertices, bulges: self.bulges.iter().rev().map(|bulge| -bulge).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn reasons(xy_mm: &[f64], bulges: &[f64]) -> Vec<(String, Reason)> {
        let findings = Polyline::from_xy(xy_mm, bulges).unwrap_err();
        findings.into_iter().map(|finding| (finding.field, finding.reason)).collect()
    }

    #[test]
    fn a_line_and_a_half_circle() {
        let chain = Polyline::from_xy(&[0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 4.0, 2.0], &[0.7, 0.0, 1.0]).unwrap();
        assert_eq!(chain.vertices().len(), 3);
        assert_eq!(chain.bulges(), [0.0, 1.0]);
        assert!((chain.length() - 4.0 - PI).abs() < 1e-12);
        assert_eq!(chain.bounds(), Bounds::of([Point::new(0.0, 0.0), Point::new(5.0, 2.0)]));
        assert_eq!(chain.reversed().start(), chain.end());
        assert_eq!(chain.reversed().reversed(), chain);
        assert!((chain.reversed().length() - chain.length()).abs() < 1e-12);
    }

    #[test]
    fn crossing_and_closing_are_fine() {
        assert!(Polyline::from_xy(&[0.0, 0.0, 2.0, 2.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0], &[]).is_ok());
    }

    #[test]
    fn an_equal_end_is_dropped_before_it() {
        let chain = Polyline::from_xy(&[0.0, 0.0, 4.0, 0.0, 4.0, 0.0], &[0.5, 0.25]).unwrap();
        assert_eq!((chain.vertices().len(), chain.bulges()), (2, &[0.5][..]));
    }

    #[test]
    fn what_is_wrong_is_said() {
        assert_eq!(reasons(&[], &[]), [("xy_mm".into(), Reason::TooFewVertices)]);
        assert_eq!(reasons(&[1.0, 1.0, 1.0, 1.0], &[]), [("xy_mm".into(), Reason::TooFewVertices)]);
        assert_eq!(
            reasons(&[1.0, 1.0, 2.0, 1.0, 3.0], &[2.0]),
            [("xy_mm".into(), Reason::OddCoordinateCount), ("bulges[0]".into(), Reason::BulgeOutOfRange)]
        );
        assert_eq!(
            reasons(&[f64::NAN, 1.0, 2.0, 1.0], &[0.0, 0.0]),
            [("bulges".into(), Reason::BulgeCountMismatch), ("xy_mm[0]".into(), Reason::NotFinite)]
        );
    }
}
