//! The plane in triangles between the corners of a scene, with the borders of obstacles as edges: what says, to a start,
//! which corners may be seen from it.
//!
//! A constrained Delaunay triangulation (L. P. Chew 1989), by the crate `spade`. It may show too much, never too little:
//! owners whose borders cross others', and those that keep less distance than some corner's circle has radius, hide
//! nothing; neither do owners that are gone, and what was added later is offered always.

use super::terrain::Terrain;
use crate::barriers::{Barriers, WORK_AREA};
use crate::search::Ground;
use rustc_hash::FxHashMap;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use traverse_geometry::{Bounds, CornerStyle, Edge, Location, Point, Vector, cross};
use traverse_solve::{Budget, Interrupt};

/// No owner.
const NONE: u32 = u32::MAX;

/// The owner that stands for the work area.
const OUTSIDE: u32 = u32::MAX - 1;

/// The budget is looked at once for so many rings, borders or triangles.
const STEPS_BETWEEN_CHECKS: usize = 256;

/// When more corners than this, and than there were, were added, a mesh no longer pays.
const ADDED_FEATURES: usize = 256;

/// The least step, as a share of the mean distance of corners.
const STEP_RATIO: f64 = 0.25;

/// How far the mesh reaches beyond the scene: this share of its size, and as many millimetres.
const MARGIN_RATIO: f64 = 0.25;

/// A triangle, its corners counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub(super) corners: [u32; 3],
    /// Across the edge from each corner to the next.
    pub(super) across: [Way; 3],
    /// Who covers it, or [`NONE`].
    owner: u32,
}

/// Into a triangle, by one of its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Way(u32);

impl Way {
    /// Beyond the mesh.
    pub(super) const NONE: Self = Self(u32::MAX);

    fn into(triangle: usize, edge: usize) -> Self {
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
    first: Vec<u32>,
    features: Vec<u32>,
    /// Features of obstacles that were added later.
    pub(super) added: Vec<u32>,
    /// A triangle near each cell of a grid over the mesh.
    near: Vec<u32>,
    bounds: Bounds,
    columns: usize,
    per_cell: Vector,
    /// The largest radius of a corner's circle, millimetres.
    pub(super) radius: f64,
    /// By how much it is worth while to look further at once, millimetres.
    pub(super) step: f64,
}

impl Mesh {
    /// The mesh of a scene as it is now; none where a mesh says nothing: there are arcs or mitred barriers, or coordinates
    /// that can't be told apart. Cost: about 1 µs for each corner.
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

    /// The triangle that a point lies in, or that it touches; none beyond the mesh.
    pub(super) fn triangle_at(&self, point: Point) -> Option<u32> {
        if !self.bounds.contains(point) {
            return None;
        }
        let by = (point - self.bounds.min).component_mul(&self.per_cell);
        let column = (by.x as usize).min(self.columns - 1);
        let row = (by.y as usize).min(self.near.len() / self.columns - 1);
        self.walk(self.near[row * self.columns + column], point)
    }

    /// From triangle to triangle towards a point (visibility walk: O. Devillers, S. Pion, M. Teillaud 2002).
    fn walk(&self, from: u32, point: Point) -> Option<u32> {
        let (mut at, mut before) = (from, None);
        for _ in 0..self.triangles.len() {
            let triangle = self.triangles.get(at as usize)?;
            let corners = triangle.corners.map(|corner| self.corners[corner as usize]);
            let mut ways =
                triangle.across.iter().enumerate().filter(|&(_, way)| Some(way.triangle()) != before);
            let beyond = ways.find(|&(i, _)| cross(corners[next(i)] - corners[i], point - corners[i]) < 0.0);
            let Some((_, way)) = beyond else { return Some(at) };
            (before, at) = (Some(at), way.triangle());
        }
        None
    }
}

/// What a mesh is made of.
struct Plan {
    /// The largest radius of any corner's circle, millimetres.
    radius: f64,
    bounds: Bounds,
}

impl Plan {
    fn of(terrain: &Terrain, barriers: &Barriers<'_>) -> Option<Self> {
        let mut bounds = Bounds::EMPTY;
        for owner in barriers.owners() {
            let clearance = barriers.clearance(owner);
            if clearance.asked > 0.0 && matches!(clearance.style, CornerStyle::Miter { .. }) {
                return None;
            }
            for outline in barriers.outlines(owner) {
                if outline.ring.edges().any(|edge| matches!(edge, Edge::Arc(_))) {
                    return None;
                }
                bounds = bounds.union(outline.ring.bounds());
            }
        }
        let radii = (0..terrain.features.len() as u32).filter(|&feature| terrain.is_there(feature));
        let radius = radii.map(|feature| terrain.feature(feature).plan_radius).fold(0.0, f64::max);
        (!bounds.is_empty()).then_some(Self { radius, bounds })
    }

    fn mesh(
        &self,
        terrain: &Terrain,
        barriers: &Barriers<'_>,
        budget: &Budget,
    ) -> Result<Option<Mesh>, Interrupt> {
        let size = self.bounds.size();
        let bounds = self.bounds.grown(self.radius + MARGIN_RATIO * (size.x + size.y) + 1.0);
        let mut triangulation = Triangulating::default();
        let mut hiding = Vec::new();
        let frame = [
            bounds.min,
            Point::new(bounds.max.x, bounds.min.y),
            bounds.max,
            Point::new(bounds.min.x, bounds.max.y),
        ];
        if frame.into_iter().any(|corner| triangulation.insert(corner).is_none()) {
            return Ok(None);
        }
        for (step, owner) in barriers.owners().enumerate() {
            let mut is_hiding = barriers.clearance(owner).planned() >= self.radius;
            for (ring, outline) in barriers.outlines(owner).enumerate() {
                if (step + ring) % STEPS_BETWEEN_CHECKS == 0 {
                    budget.check(0)?;
                }
                let Some(is_added) =
                    triangulation.add_ring(outline.ring.edges().map(|edge| edge.start()), budget)?
                else {
                    return Ok(None);
                };
                is_hiding &= is_added;
            }
            if is_hiding {
                hiding.push(owner);
            }
        }
        hiding.sort_unstable();
        let (mut mesh, borders) = Mesh::from(&triangulation, bounds, self.radius);
        mesh.cover(barriers, &hiding, &borders, budget)?;
        mesh.place_features(terrain);
        Ok(Some(mesh))
    }
}

/// A triangulation that is being made.
#[derive(Default)]
struct Triangulating {
    by_spade: ConstrainedDelaunayTriangulation<Point2<f64>>,
    last: Option<FixedVertexHandle>,
}

impl Triangulating {
    fn insert(&mut self, point: Point) -> Option<FixedVertexHandle> {
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
    fn add_ring(
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
            // An edge that crosses another one is left out.
            if self.by_spade.can_add_constraint(from, to) {
                self.by_spade.add_constraint(from, to);
            } else {
                is_added = false;
            }
        }
        Ok(Some(is_added))
    }

    /// The triangles, and which of their edges are borders.
    fn triangles(&self) -> (Vec<Triangle>, Vec<[bool; 3]>) {
        let faces = self.by_spade.inner_faces().map(|face| {
            let edges = face.adjacent_edges();
            let triangle = Triangle {
                corners: edges.map(|edge| edge.from().fix().index() as u32),
                across: edges.map(|edge| {
                    let back = edge.rev();
                    let Some(beyond) = back.face().as_inner() else { return Way::NONE };
                    let by = beyond.adjacent_edges().iter().position(|edge| *edge == back);
                    // Face 0 is what lies outside.
                    by.map_or(Way::NONE, |by| Way::into(beyond.fix().index() - 1, by))
                }),
                owner: NONE,
            };
            (triangle, [0, 1, 2].map(|i: usize| edges[i].is_constraint_edge()))
        });
        faces.unzip()
    }
}

impl Mesh {
    fn from(triangulating: &Triangulating, bounds: Bounds, radius: f64) -> (Self, Vec<[bool; 3]>) {
        let (triangles, borders) = triangulating.triangles();
        let vertices = triangulating.by_spade.vertices().map(|vertex| vertex.position());
        let corners: Vec<Point> = vertices.map(|at| Point::new(at.x, at.y)).collect();
        let size = bounds.size();
        let columns =
            ((corners.len() as f64 * size.x / size.y).sqrt().ceil() as usize).clamp(1, corners.len());
        let rows = corners.len().div_ceil(columns);
        let per_cell = Vector::new(columns as f64 / size.x, rows as f64 / size.y);
        let (first, features, added) = (Vec::new(), Vec::new(), Vec::new());
        let step = (size.x * size.y / corners.len() as f64).sqrt() * STEP_RATIO;
        let mut mesh = Self {
            corners,
            triangles,
            first,
            features,
            added,
            near: Vec::new(),
            bounds,
            columns,
            per_cell,
            radius,
            step,
        };
        let mut near = 0;
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        mesh.near = cells
            .map(|(row, column)| {
                let by = Vector::new((column as f64 + 0.5) / per_cell.x, (row as f64 + 0.5) / per_cell.y);
                near = mesh.walk(near, bounds.min + by).unwrap_or(near);
                near
            })
            .collect();
        (mesh, borders)
    }

    /// Works out which triangles the owners in `hiding`, in order, cover: each part that borders enclose at once.
    fn cover(
        &mut self,
        barriers: &Barriers<'_>,
        hiding: &[usize],
        borders: &[[bool; 3]],
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let mut is_done = vec![false; self.triangles.len()];
        let mut part = Vec::new();
        for seed in 0..self.triangles.len() as u32 {
            if std::mem::replace(&mut is_done[seed as usize], true) {
                continue;
            }
            budget.check(0)?;
            part.clear();
            part.push(seed);
            let mut next = 0;
            while let Some(&at) = part.get(next) {
                next += 1;
                let triangle = &self.triangles[at as usize];
                for (&way, &is_border) in triangle.across.iter().zip(&borders[at as usize]) {
                    if way == Way::NONE || is_border {
                        continue;
                    }
                    let beyond = way.triangle();
                    if !std::mem::replace(&mut is_done[beyond as usize], true) {
                        part.push(beyond);
                    }
                }
            }
            let owner = self.coverer(barriers, hiding, &part);
            part.iter().for_each(|&at| self.triangles[at as usize].owner = owner);
        }
        Ok(())
    }

    /// Who covers a part, told from the middle of its largest triangle.
    fn coverer(&self, barriers: &Barriers<'_>, hiding: &[usize], part: &[u32]) -> u32 {
        let corners =
            |at: u32| self.triangles[at as usize].corners.map(|corner| self.corners[corner as usize]);
        let area = |&at: &u32| {
            let [a, b, c] = corners(at);
            cross(b - a, c - a)
        };
        let Some(&largest) = part.iter().max_by(|a, b| area(a).total_cmp(&area(b))) else { return NONE };
        let [a, b, c] = corners(largest);
        let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
        for owner in barriers.owners_at(middle) {
            if hiding.binary_search(&owner).is_err() {
                continue;
            }
            let Some(shape) = barriers.shape(owner) else { continue };
            match shape.locate(middle) {
                Location::Inside if owner != WORK_AREA => return owner as u32,
                Location::Outside if owner == WORK_AREA => return OUTSIDE,
                _ => {}
            }
        }
        NONE
    }

    fn place_features(&mut self, terrain: &Terrain) {
        let key = |at: Point| [at.x, at.y].map(|value| (value + 0.0).to_bits());
        let corners = self.corners.iter().enumerate();
        let by_place: FxHashMap<[u64; 2], u32> = corners.map(|(i, &at)| (key(at), i as u32)).collect();
        let mut at_corners: Vec<(u32, u32)> = Vec::new();
        for feature in (0..terrain.features.len() as u32).filter(|&feature| terrain.is_there(feature)) {
            match by_place.get(&key(terrain.feature(feature).center)) {
                Some(&corner) => at_corners.push((corner, feature)),
                None => self.added.push(feature),
            }
        }
        at_corners.sort_unstable();
        let mut at = 0;
        for corner in 0..=self.corners.len() as u32 {
            at += at_corners[at..].iter().take_while(|&&(of, _)| of < corner).count();
            self.first.push(at as u32);
        }
        self.features = at_corners.into_iter().map(|(_, feature)| feature).collect();
    }
}
