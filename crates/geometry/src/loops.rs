//! The edges of one or several rings in one array: what the search for crossings runs on.

use crate::{Bounds, Edge, Point, Vector, left_of};

/// Closed chains, one after the other. Edge `k` runs from vertex `k` to vertex `next(k)`.
pub(crate) struct Loops {
    vertices: Vec<Point>,
    /// Empty when every edge of every chain is straight.
    bulges: Vec<f64>,
    /// Where each chain begins, and the end of the last one.
    starts: Vec<usize>,
    /// Which chain a vertex belongs to.
    chain: Vec<u32>,
}

impl Loops {
    pub(crate) fn new<'a>(chains: impl Iterator<Item = (&'a [Point], &'a [f64])> + Clone) -> Self {
        let count = chains.clone().map(|(vertices, _)| vertices.len()).sum();
        let any_arc = chains.clone().any(|(_, bulges)| !bulges.is_empty());
        let mut loops = Self {
            vertices: Vec::with_capacity(count),
            bulges: Vec::new(),
            starts: vec![0],
            chain: Vec::with_capacity(count),
        };
        for (index, (vertices, bulges)) in chains.enumerate() {
            loops.vertices.extend_from_slice(vertices);
            if any_arc {
                loops.bulges.extend_from_slice(bulges);
                loops.bulges.resize(loops.vertices.len(), 0.0);
            }
            loops.chain.resize(loops.vertices.len(), index as u32);
            loops.starts.push(loops.vertices.len());
        }
        loops
    }

    pub(crate) fn len(&self) -> usize {
        self.vertices.len()
    }

    pub(crate) fn vertex(&self, k: usize) -> Point {
        self.vertices[k]
    }

    /// The chain that edge `k` belongs to.
    pub(crate) fn chain(&self, k: usize) -> usize {
        self.chain[k] as usize
    }

    /// The number of edge `k` in its own chain.
    pub(crate) fn local(&self, k: usize) -> usize {
        k - self.starts[self.chain(k)]
    }

    pub(crate) fn next(&self, k: usize) -> usize {
        let chain = self.chain(k);
        if k + 1 == self.starts[chain + 1] { self.starts[chain] } else { k + 1 }
    }

    pub(crate) fn previous(&self, k: usize) -> usize {
        let chain = self.chain(k);
        if k == self.starts[chain] { self.starts[chain + 1] - 1 } else { k - 1 }
    }

    pub(crate) fn is_straight(&self, k: usize) -> bool {
        self.bulge(k) == 0.0
    }

    pub(crate) fn has_arcs(&self) -> bool {
        !self.bulges.is_empty()
    }

    fn bulge(&self, k: usize) -> f64 {
        self.bulges.get(k).copied().unwrap_or(0.0)
    }

    pub(crate) fn edge(&self, k: usize) -> Edge {
        Edge::from_bulge(self.vertices[k], self.vertices[self.next(k)], self.bulge(k))
    }

    /// The direction that most of the length runs along or across: in its frame boxes lie tight round the edges of
    /// a hatch or a comb at any angle.
    pub(crate) fn main_direction(&self) -> Vector {
        // Fourth powers of unit vectors: a quarter turn more or less makes no difference to them.
        let sum = (0..self.len()).fold(Vector::zeros(), |sum, k| {
            let along = self.vertices[self.next(k)] - self.vertices[k];
            let length = along.norm();
            let unit = along / length;
            let square = Vector::new(unit.x * unit.x - unit.y * unit.y, 2.0 * unit.x * unit.y);
            sum + Vector::new(square.x * square.x - square.y * square.y, 2.0 * square.x * square.y) * length
        });
        crate::unit(sum.y.atan2(sum.x) / 4.0)
    }

    /// The box of edge `k` in the frame whose x axis is `direction`, grown by `margin`.
    pub(crate) fn bounds_along(&self, k: usize, direction: Vector, margin: f64) -> Bounds {
        let turned = |p: Point| {
            Point::new(p.x * direction.x + p.y * direction.y, p.y * direction.x - p.x * direction.y)
        };
        let (start, end) = (self.vertices[k], self.vertices[self.next(k)]);
        let chord = Bounds::of([turned(start), turned(end)]);
        let bulge = self.bulge(k);
        if bulge == 0.0 {
            return chord.grown(margin);
        }
        // Up to half a turn an arc lies in the rectangle over its chord, as high as its sagitta.
        let rise = left_of(end - start) * (-bulge / 2.0);
        chord.with(turned(start + rise)).with(turned(end + rise)).grown(margin)
    }
}
