//! A region bounded by one outer ring, less its holes.

use crate::{Bounds, Ring};

/// A region bounded by one outer ring, less its holes. Holes lie inside and apart; touching is permitted.
///
/// Always valid: built by [`Polygon::new`], which reports every finding at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    outer: Ring,
    holes: Vec<Ring>,
}

impl Polygon {
    /// The region inside one ring.
    #[must_use]
    pub fn from_ring(outer: Ring) -> Self {
        Self { outer, holes: Vec::new() }
    }

    /// A polygon from parts that are known to be valid.
    pub(crate) fn trusted(outer: Ring, holes: Vec<Ring>) -> Self {
        Self { outer, holes }
    }

    /// The outer border.
    #[must_use]
    pub fn outer(&self) -> &Ring {
        &self.outer
    }

    /// What is taken out.
    #[must_use]
    pub fn holes(&self) -> &[Ring] {
        &self.holes
    }

    /// Outer ring, then holes.
    pub fn rings(&self) -> impl Iterator<Item = &Ring> + Clone {
        std::iter::once(&self.outer).chain(&self.holes)
    }

    /// Every ring, turned so that the region lies on the left of its edges.
    pub fn region_left_rings(&self) -> impl Iterator<Item = Ring> + '_ {
        self.rings().enumerate().map(|(index, ring)| {
            let counter_clockwise = index == 0;
            if ring.is_counter_clockwise() == counter_clockwise { ring.clone() } else { ring.reversed() }
        })
    }

    /// Count of vertices of all rings.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.rings().map(Ring::len).sum()
    }

    /// Square millimetres.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.outer.signed_area().abs() - self.holes.iter().map(|hole| hole.signed_area().abs()).sum::<f64>()
    }

    /// Bounding box.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.outer.bounds()
    }
}
