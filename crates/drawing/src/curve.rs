//! One entity of a drawing as a chain of straight and circular edges.

use crate::Source;
use std::sync::Arc as Shared;
use traverse_geometry::{Arc, Edge, Point};

/// One entity of a drawing as a chain of straight and circular edges, millimetres.
///
/// Every bulge lies within [−1, 1]: edges of more than half a turn are split on reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// At least 2.
    pub vertices: Vec<Point>,
    /// tan(sweep / 4) of the edge that leaves each vertex; one per vertex, the last one unused when open.
    pub bulges: Vec<f64>,
    /// Whether the last vertex is joined to the first.
    pub closed: bool,
    /// How far at most the chain runs from what was drawn, millimetres: 0 for lines and circular arcs, more for
    /// ellipses and splines.
    pub deviation_mm: f64,
    /// What the file says of it.
    pub source: Shared<Source>,
}

impl Curve {
    /// A chain that is what was drawn, of a file that says nothing of it.
    #[must_use]
    pub fn new(vertices: Vec<Point>, bulges: Vec<f64>, closed: bool) -> Self {
        Self { vertices, bulges, closed, deviation_mm: 0.0, source: Shared::default() }
    }

    /// Count of edges.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.vertices.len().saturating_sub(usize::from(!self.closed))
    }

    /// The edges, in order.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let next = self.vertices.iter().cycle().skip(1);
        let starts = self.vertices.iter().zip(&self.bulges);
        starts.zip(next).take(self.edge_count()).map(|((&start, &bulge), &end)| {
            Edge::from_bulge(start, end, if start == end { 0.0 } else { bulge })
        })
    }

    /// Whether it has an edge, and a bulge for each vertex.
    pub(crate) fn is_whole(&self) -> bool {
        self.vertices.len() > 1 && self.bulges.len() == self.vertices.len()
    }

    /// Whether every number of it is finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.vertices.iter().flat_map(|p| p.iter()).chain(&self.bulges).all(|number| number.is_finite())
    }

    /// Millimetres along the curve.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }
}

/// Builds a curve edge by edge. Edges without length are left out; edges of more than half a turn are split.
#[derive(Debug)]
pub(crate) struct CurveBuilder {
    vertices: Vec<Point>,
    bulges: Vec<f64>,
}

impl CurveBuilder {
    /// A curve that begins at `start`.
    pub(crate) fn from(start: Point) -> Self {
        Self { vertices: vec![start], bulges: Vec::new() }
    }

    /// Goes on to `end` by an edge of that bulge.
    pub(crate) fn edge(mut self, bulge: f64, end: Point) -> Self {
        let Some(&start) = self.vertices.last() else { return self };
        if start == end {
            return self;
        }
        if bulge.abs() > 1.0 {
            // tan(sweep / 8): half of the edge.
            let half = (bulge.atan() / 2.0).tan();
            self.vertices.push(Arc::from_bulge(start, end, bulge).point_at(0.5));
            self.bulges.extend([half, half]);
        } else {
            self.bulges.push(bulge);
        }
        self.vertices.push(end);
        self
    }

    /// The curve with two loose ends; none when it has no length.
    pub(crate) fn open(mut self) -> Option<Curve> {
        self.bulges.push(0.0);
        (self.vertices.len() > 1).then(|| Curve::new(self.vertices, self.bulges, false))
    }

    /// The closed curve; its last edge came back to the start. None when it has no length.
    pub(crate) fn closed(mut self) -> Option<Curve> {
        if self.vertices.len() > 1 && self.vertices.first() == self.vertices.last() {
            self.vertices.pop();
        }
        (self.vertices.len() > 1).then(|| Curve::new(self.vertices, self.bulges, true))
    }
}
