//! A triangulation that is being made, by the crate `spade`: corners and borders in, triangles out.

use super::mesh::{LOOKS_BETWEEN_CHECKS, Triangle, Way};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, LineIntersectionIterator, Point2, Triangulation};
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt};

/// Most edges that a border may turn: their number squared is what `spade` takes for it, with no look at the budget.
const EDGES_TURNED: usize = 512;

/// The budget is looked at once for so many corners.
const STEPS_BETWEEN_CHECKS: usize = 32;

/// A triangulation that is being made.
pub(super) struct Triangulating {
    by_spade: ConstrainedDelaunayTriangulation<Point2<f64>>,
    last: Option<FixedVertexHandle>,
}

impl Triangulating {
    /// Nothing yet, with room for so many corners: growing later would move all of them at once.
    pub(super) fn with_room(corners: usize) -> Self {
        // A triangulation of n corners has fewer than 3n edges and 2n faces.
        let by_spade = ConstrainedDelaunayTriangulation::with_capacity(corners, 3 * corners, 2 * corners);
        Self { by_spade, last: None }
    }

    /// Adds a corner; none where it can't be told apart from others.
    pub(super) fn insert(&mut self, point: Point) -> Option<FixedVertexHandle> {
        // Zeros have one sign only, and what is next to nothing is nothing.
        let coordinate = |value: f64| if value.abs() < 1e-30 { 0.0 } else { value };
        let point = Point2::new(coordinate(point.x), coordinate(point.y));
        let inserted = match self.last {
            Some(hint) => self.by_spade.insert_with_hint(point, hint),
            None => self.by_spade.insert(point),
        };
        self.last = inserted.ok();
        self.last
    }

    /// Adds a ring; whether all of its edges are there, or none when its corners can't be.
    pub(super) fn add_ring(
        &mut self,
        corners: impl Iterator<Item = Point>,
        budget: &Budget,
    ) -> Result<Option<bool>, Interrupt> {
        let mut handles = Vec::new();
        for (i, corner) in corners.enumerate() {
            if i % STEPS_BETWEEN_CHECKS == STEPS_BETWEEN_CHECKS - 1 {
                budget.check(0)?;
            }
            let Some(handle) = self.insert(corner) else { return Ok(None) };
            handles.push(handle);
        }
        let mut is_added = true;
        for (i, &from) in handles.iter().enumerate() {
            if i % STEPS_BETWEEN_CHECKS == STEPS_BETWEEN_CHECKS - 1 {
                budget.check(0)?;
            }
            let to = handles[(i + 1) % handles.len()];
            if from == to || self.by_spade.exists_constraint(from, to) {
                continue;
            }
            // An edge that crosses another one is left out, and one that would turn too many.
            if self.crossed_by(from, to) <= EDGES_TURNED && self.by_spade.can_add_constraint(from, to) {
                self.by_spade.add_constraint(from, to);
            } else {
                is_added = false;
            }
        }
        Ok(Some(is_added))
    }

    /// How many edges lie across a border, counted up to a few more than may.
    fn crossed_by(&self, from: FixedVertexHandle, to: FixedVertexHandle) -> usize {
        let across = LineIntersectionIterator::new_from_handles(&self.by_spade, from, to);
        across.take(EDGES_TURNED + 1).count()
    }

    /// The triangles, and which of their edges are borders.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn triangles(&self, budget: &Budget) -> Result<(Vec<Triangle>, Vec<[bool; 3]>), Interrupt> {
        let count = self.by_spade.num_inner_faces();
        let (mut triangles, mut borders) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for (i, face) in self.by_spade.inner_faces().enumerate() {
            if i.is_multiple_of(LOOKS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            let edges = face.adjacent_edges();
            let across = edges.map(|edge| {
                let back = edge.rev();
                let Some(beyond) = back.face().as_inner() else { return Way::NONE };
                let by = beyond.adjacent_edges().iter().position(|edge| *edge == back);
                // Face 0 is what lies outside.
                by.map_or(Way::NONE, |by| Way::into(beyond.fix().index() - 1, by))
            });
            triangles.push(Triangle::new(edges.map(|edge| edge.from().fix().index() as u32), across));
            borders.push([0, 1, 2].map(|i: usize| edges[i].is_constraint_edge()));
        }
        Ok((triangles, borders))
    }

    /// The corners, by number.
    pub(super) fn corners(&self) -> Vec<Point> {
        self.by_spade.vertices().map(|vertex| vertex.position()).map(|at| Point::new(at.x, at.y)).collect()
    }
}
