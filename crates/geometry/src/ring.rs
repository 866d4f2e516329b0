//! A closed chain of straight and circular edges.

use crate::{Bounds, Edge, Point};

/// A closed chain of straight and circular edges. Edge `i` runs from vertex `i` to vertex `i + 1`, the last one
/// back to vertex 0. Either orientation. It may touch itself at vertices and along edges; it never crosses itself.
///
/// Always valid: built by [`Ring::new`] or [`Ring::from_xy`], which report every finding at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    vertices: Vec<Point>,
    /// Empty when every edge is straight, otherwise one per vertex.
    bulges: Vec<f64>,
    touches_itself: bool,
    counter_clockwise: bool,
    bounds: Bounds,
}

impl Ring {
    /// A ring from parts that are known to be valid; `touches_itself` as [`Ring::touches_itself`] says.
    pub(crate) fn trusted(vertices: Vec<Point>, bulges: Vec<f64>, touches_itself: bool) -> Self {
        debug_assert!(bulges.is_empty() || bulges.len() == vertices.len());
        debug_assert!(vertices.len() >= if bulges.is_empty() { 3 } else { 2 });
        let mut ring =
            Self { vertices, bulges, touches_itself, counter_clockwise: true, bounds: Bounds::EMPTY };
        ring.counter_clockwise = ring.signed_area() > 0.0;
        ring.bounds = ring.edges().fold(Bounds::EMPTY, |bounds, edge| bounds.union(edge.bounds()));
        ring
    }

    /// The vertices, in order, the first not repeated.
    #[must_use]
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// One bulge per edge, or none when every edge is straight.
    #[must_use]
    pub fn bulges(&self) -> &[f64] {
        &self.bulges
    }

    /// Count of edges, and of vertices.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a ring is never empty")]
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Whether any edge is circular.
    #[must_use]
    pub fn has_arcs(&self) -> bool {
        !self.bulges.is_empty()
    }

    /// Edge `i`, from vertex `i` on.
    ///
    /// # Panics
    /// When `i` is not below [`Ring::len`].
    #[must_use]
    pub fn edge(&self, i: usize) -> Edge {
        let next = if i + 1 == self.vertices.len() { 0 } else { i + 1 };
        Edge::from_bulge(self.vertices[i], self.vertices[next], self.bulges.get(i).copied().unwrap_or(0.0))
    }

    /// Every edge, in order.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = Edge> + DoubleEndedIterator + '_ {
        (0..self.vertices.len()).map(|i| self.edge(i))
    }

    /// Millimetres round the ring.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }

    /// The area enclosed, square millimetres: positive when the ring runs counter-clockwise, never 0.
    /// Straight edges to twice the precision of `f64`, arcs to its rounding error. Cost: linear.
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        crate::area::signed_area(self.edges()).0
    }

    /// Whether the ring runs counter-clockwise. Known since validation: costs nothing.
    #[must_use]
    pub fn is_counter_clockwise(&self) -> bool {
        self.counter_clockwise
    }

    /// The same ring run the other way, from the same first vertex.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let n = self.vertices.len();
        let vertices = (0..n).map(|i| self.vertices[(n - i) % n]).collect();
        let bulges = if self.bulges.is_empty() {
            Vec::new()
        } else {
            (0..n).map(|i| -self.bulges[n - 1 - i]).collect()
        };
        Self { vertices, bulges, counter_clockwise: !self.counter_clockwise, ..*self }
    }

    /// Whether any two edges touch that do not follow each other, or an edge turns back along the one before it
    /// (an antenna or a slit of width 0). Straight edges exactly; arcs within [`crate::CONTACT_TOLERANCE_MM`], where
    /// a cusp counts as turning back. Known since validation: costs nothing.
    #[must_use]
    pub fn touches_itself(&self) -> bool {
        self.touches_itself
    }

    /// Bounding box. Known since validation: costs nothing.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }
}
