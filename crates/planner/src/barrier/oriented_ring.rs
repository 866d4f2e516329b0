//! A ring, run so that the material lies on the left.

use traverse_geometry::{Bounds, Edge, Point, Ring};

/// How far rounding may move a point of an arc, as a share of its radius.
const ROUNDING_RATIO: f64 = 1e-14;

/// A ring as it is, or run the other way from the same first vertex: as [`Ring::reversed`] has it, of which no copy is made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OrientedRing<'a> {
    ring: &'a Ring,
    is_reversed: bool,
}

impl<'a> OrientedRing<'a> {
    /// The ring run counter-clockwise, or clockwise.
    pub(crate) fn new(ring: &'a Ring, counter_clockwise: bool) -> Self {
        Self { ring, is_reversed: ring.is_counter_clockwise() != counter_clockwise }
    }

    /// Count of edges.
    pub(crate) fn len(&self) -> usize {
        self.ring.len()
    }

    pub(crate) fn bounds(&self) -> Bounds {
        self.ring.bounds()
    }

    pub(crate) fn touches_itself(&self) -> bool {
        self.ring.touches_itself()
    }

    /// Where edge `i` begins and ends, and its bulge.
    fn chord(&self, i: usize) -> (Point, Point, f64) {
        let (vertices, bulges) = (self.ring.vertices(), self.ring.bulges());
        let n = vertices.len();
        let next = if i + 1 == n { 0 } else { i + 1 };
        if !self.is_reversed {
            return (vertices[i], vertices[next], bulges.get(i).copied().unwrap_or(0.0));
        }
        let back = |i: usize| if i == 0 { 0 } else { n - i };
        (vertices[back(i)], vertices[back(next)], bulges.get(n - 1 - i).map_or(0.0, |bulge| -bulge))
    }

    /// The segment from where edge `i` begins to where it ends, and how far from it the edge may lead, rounding included.
    pub(super) fn strip(&self, i: usize) -> (Point, Point, f64) {
        let (start, end, bulge) = self.chord(i);
        if bulge == 0.0 {
            return (start, end, 0.0);
        }
        // No arc leads further from its chord than its height above it.
        let half = (end - start).norm() / 2.0;
        let radius = half * (1.0 + bulge * bulge) / (2.0 * bulge.abs());
        (start, end, half * bulge.abs() + ROUNDING_RATIO * radius)
    }

    /// Edge `i`.
    pub(crate) fn edge(&self, i: usize) -> Edge {
        let (start, end, bulge) = self.chord(i);
        Edge::from_bulge(start, end, bulge)
    }

    /// Every edge, in order.
    pub(crate) fn edges(self) -> impl ExactSizeIterator<Item = Edge> + 'a {
        (0..self.len()).map(move |i| self.edge(i))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reversed_edges_are_those_of_the_reversed_ring() {
        let vertices = [(0.0, 0.0), (4.0, 0.0), (5.0, 3.0), (1.0, 4.0)].map(|(x, y)| Point::new(x, y));
        for bulges in [vec![], vec![0.2, 0.0, -0.1, 0.3]] {
            let ring = Ring::new(vertices.to_vec(), bulges).expect("it does not cross itself");
            for counter_clockwise in [true, false] {
                let expected = if counter_clockwise { ring.clone() } else { ring.reversed() };
                let oriented = OrientedRing::new(&ring, counter_clockwise);
                assert!(oriented.edges().eq(expected.edges()));
            }
        }
    }
}
