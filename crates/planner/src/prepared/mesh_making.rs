//! How a scene becomes a mesh: its rings are triangulated, what they enclose is covered, features are put to their corners.

use super::mesh::{LOOKS_BETWEEN_CHECKS, Mesh, NONE, OUTSIDE, Way};
use super::terrain::Terrain;
use super::triangulating::Triangulating;
use crate::barriers::{Barriers, WORK_AREA};
use crate::search::Ground;
use rustc_hash::FxHashMap;
use traverse_geometry::{Bounds, CornerStyle, Edge, Location, Point, Vector, cross};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many owners.
const OWNERS_BETWEEN_CHECKS: usize = 32;

/// The least step, as a share of the mean distance of corners.
const STEP_RATIO: f64 = 0.05;

/// How far the mesh reaches beyond the scene: this share of its size, and as many millimetres.
const MARGIN_RATIO: f64 = 0.25;

/// What a mesh is made of.
pub(super) struct Plan {
    /// The largest radius of any corner's circle, millimetres.
    radius: f64,
    bounds: Bounds,
    /// At most so many corners are there, beside those of the frame.
    corner_count: usize,
}

impl Plan {
    /// None where a mesh says nothing.
    pub(super) fn of(terrain: &Terrain, barriers: &Barriers<'_>) -> Option<Self> {
        let (mut bounds, mut corner_count) = (Bounds::EMPTY, 0);
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
                corner_count += outline.ring.len();
            }
        }
        let radii = (0..terrain.features.len() as u32).filter(|&feature| terrain.is_there(feature));
        let radius = radii.map(|feature| terrain.feature(feature).plan_radius).fold(0.0, f64::max);
        (!bounds.is_empty()).then_some(Self { radius, bounds, corner_count })
    }

    /// The mesh, unless coordinates can't be told apart.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn mesh(
        &self,
        terrain: &Terrain,
        barriers: &Barriers<'_>,
        budget: &Budget,
    ) -> Result<Option<Mesh>, Interrupt> {
        let size = self.bounds.size();
        let bounds = self.bounds.grown(self.radius + MARGIN_RATIO * (size.x + size.y) + 1.0);
        let mut triangulation = Triangulating::with_room(self.corner_count + 4);
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
            if step.is_multiple_of(OWNERS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            for outline in barriers.outlines(owner) {
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
        let (mut mesh, borders) = Mesh::from(&triangulation, bounds, self.radius, budget)?;
        mesh.cover(barriers, &hiding, &borders, budget)?;
        mesh.place_features(terrain, budget)?;
        Ok(Some(mesh))
    }
}

impl Mesh {
    fn from(
        triangulating: &Triangulating,
        bounds: Bounds,
        radius: f64,
        budget: &Budget,
    ) -> Result<(Self, Vec<[bool; 3]>), Interrupt> {
        let (triangles, borders) = triangulating.triangles(budget)?;
        let corners = triangulating.corners();
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
            cell_rows: rows,
            per_cell,
            radius,
            step,
        };
        mesh.near = mesh.triangles_by_cell(columns * rows);
        Ok((mesh, borders))
    }

    /// For each cell a triangle whose middle lies there, or in the nearest cell before it that has one.
    fn triangles_by_cell(&self, cell_count: usize) -> Vec<u32> {
        let mut near = vec![NONE; cell_count];
        for (i, triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = triangle.corners.map(|corner| self.corners[corner as usize].coords);
            near[self.cell_of(Point::from((a + b + c) / 3.0))] = i as u32;
        }
        let mut last = 0;
        for cell in &mut near {
            if *cell == NONE {
                *cell = last;
            }
            last = *cell;
        }
        near
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
            let (mut next, mut largest) = (0, (f64::NEG_INFINITY, seed));
            while let Some(&at) = part.get(next) {
                next += 1;
                if next.is_multiple_of(LOOKS_BETWEEN_CHECKS) {
                    budget.check(0)?;
                }
                let triangle = &self.triangles[at as usize];
                let [a, b, c] = triangle.corners.map(|corner| self.corners[corner as usize]);
                let area = cross(b - a, c - a);
                if area >= largest.0 {
                    largest = (area, at);
                }
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
            let owner = self.coverer(barriers, hiding, largest.1);
            part.iter().for_each(|&at| self.triangles[at as usize].owner = owner);
        }
        Ok(())
    }

    /// Who covers a part, told from the middle of its largest triangle.
    fn coverer(&self, barriers: &Barriers<'_>, hiding: &[usize], largest: u32) -> u32 {
        let [a, b, c] = self.triangles[largest as usize].corners.map(|corner| self.corners[corner as usize]);
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

    fn place_features(&mut self, terrain: &Terrain, budget: &Budget) -> Result<(), Interrupt> {
        let key = |at: Point| [at.x, at.y].map(|value| (value + 0.0).to_bits());
        let corners = self.corners.iter().enumerate();
        budget.check(0)?;
        let by_place: FxHashMap<[u64; 2], u32> = corners.map(|(i, &at)| (key(at), i as u32)).collect();
        let mut at_corners: Vec<(u32, u32)> = Vec::new();
        for feature in (0..terrain.features.len() as u32).filter(|&feature| terrain.is_there(feature)) {
            if (feature as usize).is_multiple_of(LOOKS_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            match by_place.get(&key(terrain.feature(feature).center)) {
                Some(&corner) => at_corners.push((corner, feature)),
                None => self.added.push(feature),
            }
        }
        budget.check(0)?;
        at_corners.sort_unstable();
        let mut at = 0;
        for corner in 0..=self.corners.len() as u32 {
            at += at_corners[at..].iter().take_while(|&&(of, _)| of < corner).count();
            self.first.push(at as u32);
        }
        self.features = at_corners.into_iter().map(|(_, feature)| feature).collect();
        Ok(())
    }
}
