//! The borders of everything that is in the way, as one flat list of edges with the material on their left.

use crate::curve::{Curve, cross};
use crate::mitre::Corner;
use std::ops::Range;
use traverse_geometry::{Bounds, CornerStyle, MITER_RATIO_LIMIT, Point, Polygon, Ring, Scene};

/// An obstacle, or all that lies outside the work area.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    /// Index of the obstacle; none: the outside of the work area.
    pub(crate) obstacle: Option<usize>,
    /// Millimetres.
    pub(crate) clearance: f64,
    /// Mitred corners, cut beyond this ratio; none: round.
    pub(crate) miter_limit: Option<f64>,
    /// Box round its border.
    pub(crate) bounds: Bounds,
    /// Its edges.
    pub(crate) edges: Range<u32>,
}

impl Solid {
    /// The ratio beyond which corners are cut, where the mitre makes a difference.
    pub(crate) fn mitred(&self) -> Option<f64> {
        self.miter_limit.filter(|_| self.clearance > 0.0)
    }
}

/// A vertex and the edge that leaves it.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    at: Point,
    bulge: f64,
    next: u32,
    solid: u32,
}

/// Every border of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Boundary {
    pub(crate) solids: Vec<Solid>,
    vertices: Vec<Vertex>,
}

impl Boundary {
    /// The borders of `scene`. Cost: linear.
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut boundary = Self { solids: Vec::new(), vertices: Vec::with_capacity(scene.vertex_count()) };
        let miter_limit = match scene.corner_style {
            CornerStyle::Round => None,
            CornerStyle::Miter { limit } => {
                Some(limit.unwrap_or(MITER_RATIO_LIMIT).clamp(1.0, MITER_RATIO_LIMIT))
            }
        };
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            boundary.add(&obstacle.shape, Some(index), scene.clearance_of(obstacle), miter_limit);
        }
        if let Some(area) = &scene.work_area {
            boundary.add(area, None, scene.border_clearance(), miter_limit);
        }
        boundary
    }

    fn add(&mut self, shape: &Polygon, obstacle: Option<usize>, clearance: f64, miter_limit: Option<f64>) {
        let solid = self.solids.len() as u32;
        let first = self.vertices.len();
        for (index, ring) in shape.rings().enumerate() {
            // Material on the left: outer borders counter-clockwise, holes clockwise, all turned round for the outside.
            let counter_clockwise = (index == 0) == obstacle.is_some();
            self.add_ring(ring, counter_clockwise, solid);
        }
        let edges = first as u32..self.vertices.len() as u32;
        let all = edges.clone();
        let bounds = all.fold(Bounds::EMPTY, |bounds, edge| bounds.union(self.curve(edge).bounds()));
        self.solids.push(Solid { obstacle, clearance, miter_limit, bounds, edges });
    }

    fn add_ring(&mut self, ring: &Ring, counter_clockwise: bool, solid: u32) {
        let count = ring.len();
        let bulge = |i: usize| ring.bulges().get(i).copied().unwrap_or(0.0);
        let forward = (signed_area(ring) > 0.0) == counter_clockwise;
        let first = self.vertices.len() as u32;
        for i in 0..count {
            let (at, bulge) = if forward {
                (ring.vertices()[i], bulge(i))
            } else {
                let from = count - 1 - i;
                (ring.vertices()[from], -bulge((from + count - 1) % count))
            };
            self.vertices.push(Vertex { at, bulge, next: first + (i as u32 + 1) % count as u32, solid });
        }
    }

    /// Count of edges.
    pub(crate) fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Edge `edge`, material on its left.
    pub(crate) fn curve(&self, edge: u32) -> Curve {
        let vertex = &self.vertices[edge as usize];
        Curve::from_bulge(vertex.at, self.vertices[vertex.next as usize].at, vertex.bulge)
    }

    /// The edge that leaves where `edge` ends.
    pub(crate) fn next(&self, edge: u32) -> u32 {
        self.vertices[edge as usize].next
    }

    /// Index of the solid that `edge` bounds.
    pub(crate) fn solid_of(&self, edge: u32) -> u32 {
        self.vertices[edge as usize].solid
    }

    /// The solid that `edge` bounds.
    pub(crate) fn solid(&self, edge: u32) -> &Solid {
        &self.solids[self.solid_of(edge) as usize]
    }

    /// The corner where `edge` ends, if it is convex.
    pub(crate) fn corner_after(&self, edge: u32) -> Option<Corner> {
        Corner::between(&self.curve(edge), &self.curve(self.next(edge)))
    }
}

/// Twice the area enclosed, positive counter-clockwise.
fn signed_area(ring: &Ring) -> f64 {
    let vertices = ring.vertices();
    let origin = vertices[0];
    (0..vertices.len())
        .map(|i| {
            let (a, b) = (vertices[i], vertices[(i + 1) % vertices.len()]);
            let under_chord = cross(a - origin, b - origin);
            match Curve::from_bulge(a, b, ring.bulges().get(i).copied().unwrap_or(0.0)) {
                Curve::Straight(_) => under_chord,
                Curve::Circular(arc) => {
                    let sweep = 2.0 * arc.half;
                    under_chord + arc.turn * arc.radius * arc.radius * (sweep - sweep.sin())
                }
            }
        })
        .sum()
}
