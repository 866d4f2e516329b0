//! The plane in triangles between the corners of a scene, with the borders of obstacles as edges: what says, to a start,
//! which corners may be seen from it.
//!
//! A constrained Delaunay triangulation (L. P. Chew 1989), by the crate `spade`. It may show too much, never too little:
//! owners whose borders cross others', and those that keep less distance than some corner's circle has radius, hide
//! nothing; neither do owners that are gone, and what was added later is offered always.

use super::mesh_making::Plan;
use super::terrain::Terrain;
use crate::barriers::Barriers;
use traverse_geometry::{Bounds, Point, Vector, cross};
use traverse_solve::{Budget, Interrupt};

/// No owner.
pub(super) const NONE: u32 = u32::MAX;

/// The owner that stands for the work area.
pub(super) const OUTSIDE: u32 = u32::MAX - 1;

/// The budget is looked at once for so many triangles or features.
pub(super) const LOOKS_BETWEEN_CHECKS: usize = 4096;

/// When more corners than this, and than there were, were added, a mesh no longer pays.
const ADDED_FEATURES: usize = 256;

/// A triangle, its corners counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub(super) corners: [u32; 3],
    /// Across the edge from each corner to the next.
    pub(super) across: [Way; 3],
    /// Who covers it, or [`NONE`].
    pub(super) owner: u32,
}

impl Triangle {
    /// A triangle that nothing covers.
    pub(super) fn new(corners: [u32; 3], across: [Way; 3]) -> Self {
        Self { corners, across, owner: NONE }
    }
}

/// Into a triangle, by one of its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Way(u32);

impl Way {
    /// Beyond the mesh.
    pub(super) const NONE: Self = Self(u32::MAX);

    /// Into a triangle by its edge from the corner of this place to the next.
    pub(super) fn into(triangle: usize, edge: usize) -> Self {
        Self((triangle * 4 + edge) as u32)
    }

    pub(super) fn triangle(self) -> u32 {
        self.0 / 4
    }

    pub(super) fn edge(self) -> usize {
        (self.0 % 4) as usize
    }
}

/// The place after this one among three.
pub(super) fn next(place: usize) -> usize {
    if place == 2 { 0 } else { place + 1 }
}

/// A triangulated scene.
pub(super) struct Mesh {
    pub(super) corners: Vec<Point>,
    pub(super) triangles: Vec<Triangle>,
    /// Features by corner: those of corner i from `first[i]` to `first[i + 1]`.
    pub(super) first: Vec<u32>,
    pub(super) features: Vec<u32>,
    /// Features of obstacles that were added later.
    pub(super) added: Vec<u32>,
    /// A triangle near each cell of a grid over the mesh.
    pub(super) near: Vec<u32>,
    pub(super) bounds: Bounds,
    pub(super) columns: usize,
    pub(super) cell_rows: usize,
    pub(super) per_cell: Vector,
    /// The largest radius of a corner's circle, millimetres.
    pub(super) radius: f64,
    /// By how much it is worth while to look further at once, millimetres.
    pub(super) step: f64,
}

impl Mesh {
    /// The mesh of a scene as it is now; none where a mesh says nothing: there are arcs or mitred barriers, or coordinates
    /// that can't be told apart. Cost: about n log n.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn of(
        terrain: &Terrain,
        barriers: &Barriers<'_>,
        budget: &Budget,
    ) -> Result<Option<Self>, Interrupt> {
        let Some(plan) = Plan::of(terrain, barriers) else { return Ok(None) };
        plan.mesh(terrain, barriers, budget)
    }

    /// Notes features that were added; false when there are so many that the mesh no longer pays.
    pub(super) fn add(&mut self, features: std::ops::Range<usize>) -> bool {
        self.added.extend(features.map(|feature| feature as u32));
        self.added.len() <= self.features.len().max(ADDED_FEATURES)
    }

    /// The features at a corner.
    pub(super) fn features_at(&self, corner: u32) -> &[u32] {
        let corner = corner as usize;
        &self.features[self.first[corner] as usize..self.first[corner + 1] as usize]
    }

    /// Whether a triangle hides what lies behind it.
    pub(super) fn is_covered(&self, terrain: &Terrain, triangle: u32) -> bool {
        match self.triangles[triangle as usize].owner {
            NONE => false,
            OUTSIDE => true,
            owner => terrain.there.has(owner as usize),
        }
    }

    /// The triangle that a point lies in, farther than `least_height` from its edges, millimetres; none where it is nearer to
    /// one, or beyond the mesh.
    pub(super) fn triangle_at(&self, point: Point, least_height: f64) -> Option<u32> {
        if !self.bounds.contains(point) {
            return None;
        }
        self.walk(self.near[self.cell_of(point)], point, least_height)
    }

    /// The cell of a point within the bounds.
    pub(super) fn cell_of(&self, point: Point) -> usize {
        let by = (point - self.bounds.min).component_mul(&self.per_cell);
        // A cast from a float saturates.
        let column = (by.x as usize).min(self.columns - 1);
        let row = (by.y as usize).min(self.cell_rows - 1);
        row * self.columns + column
    }

    /// From triangle to triangle towards a point (visibility walk: O. Devillers, S. Pion, M. Teillaud 2002).
    fn walk(&self, from: u32, point: Point, least_height: f64) -> Option<u32> {
        let mut at = from;
        for _ in 0..self.triangles.len() {
            let triangle = self.triangles.get(at as usize)?;
            let corners = triangle.corners.map(|corner| self.corners[corner as usize]);
            let height = |i: usize| {
                let along = corners[next(i)] - corners[i];
                cross(along, point - corners[i]) / along.norm()
            };
            let heights = [0, 1, 2].map(height);
            if heights.iter().all(|&height| height > least_height) {
                return Some(at);
            }
            let beyond = (0..3).find(|&i| heights[i] < 0.0)?;
            if triangle.across[beyond] == Way::NONE {
                return None;
            }
            at = triangle.across[beyond].triangle();
        }
        None
    }
}
