//! A tree of bounding boxes over every edge of a scene, each box holding what the edge keeps the tool from.
//!
//! Built by parry, whose vectors are glam's; only boxes go in and out. Cost: O(n log n) to build, O(log n + hits)
//! to ask.

use crate::boundary::Boundary;
use crate::curve::{Curve, right_of};
use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector as ParryVector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction};
use std::ops::Range;
use traverse_geometry::{Bounds, Point, Vector};

/// Most edges in one tree: building it takes a few milliseconds, so that giving up does not wait for long.
const TREE_SIZE: usize = 16_384;

/// So few edges are looked at one by one.
const FEW_EDGES: usize = 256;

/// The tree, in parts, and how its boxes relate to margins.
pub(crate) struct BoundaryTree {
    /// First edge of each part; boxes count from there.
    parts: Vec<(u32, Bvh)>,
    /// No margin is less than the distance to the edge's box divided by this: above 1 where corners are mitred.
    stretch: f64,
}

impl BoundaryTree {
    /// The tree over every edge of `boundary`, given up when `go_on` says no.
    pub(crate) fn over(boundary: &Boundary, go_on: &dyn Fn() -> bool) -> Option<Self> {
        let mut stretch = 1.0_f64;
        let mut parts = Vec::new();
        for first in (0..boundary.len()).step_by(TREE_SIZE) {
            if !go_on() {
                return None;
            }
            let count = TREE_SIZE.min(boundary.len() - first);
            let boxes = (0..count).map(|at| (at, edge_box(boundary, (first + at) as u32, &mut stretch)));
            parts.push((first as u32, Bvh::from_iter(BvhBuildStrategy::Binned, boxes)));
        }
        Some(Self { parts, stretch: stretch * (1.0 + 1e-9) })
    }

    /// Calls `found` with every edge whose box comes within `reach` of `step`, possibly a few more.
    pub(crate) fn near(&self, step: &StepBox, reach: f64, mut found: impl FnMut(u32)) {
        self.traverse(|bounds| step.distance_to(bounds) <= reach, &mut found);
    }

    /// The least distance from `at` to the edges `among`. Cost: linear for a few edges; for many, as
    /// [`Self::least_margin`].
    pub(crate) fn distance_among(&self, boundary: &Boundary, at: Point, among: &Range<u32>) -> Option<f64> {
        let distance = |edge: u32| boundary.curve(edge).distance_to_point(at);
        if among.len() <= FEW_EDGES {
            return among.clone().map(distance).min_by(f64::total_cmp);
        }
        let step = StepBox::of(&Curve::straight(at, at));
        let bound = |node: &BvhNode, _| step.distance_to(&bounds(node));
        let holds = |(first, _): &&(u32, Bvh)| *first < among.end && among.start < first + TREE_SIZE as u32;
        self.parts.iter().filter(holds).fold(None, |least: Option<f64>, (first, part)| {
            let of_these = |edge: u32| among.contains(&(first + edge)).then(|| distance(first + edge));
            let nearer = part.find_best(least.unwrap_or(f64::INFINITY), bound, |edge, _| of_these(edge));
            nearer.map(|(_, distance)| distance).or(least)
        })
    }

    /// The least margin below `most`, where `margin` gives it for an edge.
    pub(crate) fn least_margin(
        &self,
        step: &StepBox,
        most: f64,
        margin: impl Fn(u32) -> Option<f64>,
    ) -> Option<f64> {
        let bound = |node: &BvhNode, _| step.distance_to(&bounds(node)) / self.stretch;
        self.parts.iter().fold(None, |least: Option<f64>, (first, part)| {
            let nearer = part.find_best(least.unwrap_or(most), bound, |edge, _| margin(first + edge));
            nearer.map(|(_, margin)| margin).or(least)
        })
    }

    /// Calls `found` with every edge that a ray from `from` to the right may cross, up to `right`.
    pub(crate) fn to_the_right(&self, from: Point, right: f64, mut found: impl FnMut(u32)) {
        let ray = Bounds { min: from, max: Point::new(right, from.y) };
        self.traverse(|bounds| bounds.meets(&ray), &mut found);
    }

    fn traverse(&self, wanted: impl Fn(&Bounds) -> bool, found: &mut impl FnMut(u32)) {
        for (first, part) in &self.parts {
            part.traverse(|node| {
                if !wanted(&bounds(node)) {
                    return TraversalAction::Prune;
                }
                if let Some(edge) = node.leaf_data() {
                    found(first + edge);
                }
                TraversalAction::Continue
            });
        }
    }
}

/// The box that holds what `edge` keeps the tool from.
fn edge_box(boundary: &Boundary, edge: u32, stretch: &mut f64) -> Aabb {
    let solid = boundary.solid(edge);
    let mut bounds = boundary.curve(edge).bounds().grown(solid.clearance);
    if let Some(limit) = solid.mitred()
        && let Some(corner) = boundary.corner_after(edge)
    {
        for vertex in corner.outline(solid.clearance, limit) {
            *stretch = stretch.max((vertex - corner.at).norm() / solid.clearance);
            bounds = bounds.with(vertex);
        }
    }
    // Rounding of the box itself.
    aabb(bounds.grown(1e-9))
}

/// A step, ready to be held against boxes.
pub(crate) struct StepBox {
    bounds: Bounds,
    shape: Curve,
    /// Right of a straight step.
    normal: Vector,
}

impl StepBox {
    /// The box of `shape`.
    pub(crate) fn of(shape: &Curve) -> Self {
        let normal = match shape {
            Curve::Straight(straight) => right_of(straight.direction()),
            Curve::Circular(_) => Vector::zeros(),
        };
        Self { bounds: shape.bounds(), shape: *shape, normal }
    }

    /// No point of the step is nearer to the box than this.
    fn distance_to(&self, other: &Bounds) -> f64 {
        let gap = (other.min - self.bounds.max).sup(&(self.bounds.min - other.max)).sup(&Vector::zeros());
        let apart = gap.norm();
        let across = match &self.shape {
            // Separated by a line along the step.
            Curve::Straight(straight) => {
                let half = (other.max - other.min) / 2.0;
                let extent = self.normal.x.abs() * half.x + self.normal.y.abs() * half.y;
                self.normal.dot(&(other.min + half - straight.a)).abs() - extent
            }
            // All inside or all outside the circle.
            Curve::Circular(arc) => {
                let (low, high) = (other.min - arc.center, other.max - arc.center);
                let nearest = low.sup(&-high).sup(&Vector::zeros()).norm();
                let farthest = low.abs().sup(&high.abs()).norm();
                (nearest - arc.radius).max(arc.radius - farthest)
            }
        };
        // Rounding of coordinates and radii far out must not hide an edge.
        apart.max(across - 1e-14 * self.scale())
    }

    fn scale(&self) -> f64 {
        match &self.shape {
            Curve::Straight(straight) => straight.a.x.abs().max(straight.a.y.abs()).max(straight.length()),
            Curve::Circular(arc) => arc.radius,
        }
    }
}

fn aabb(bounds: Bounds) -> Aabb {
    Aabb::new(ParryVector::new(bounds.min.x, bounds.min.y), ParryVector::new(bounds.max.x, bounds.max.y))
}

fn bounds(node: &BvhNode) -> Bounds {
    let (min, max) = (node.mins(), node.maxs());
    Bounds { min: Point::new(min.x, min.y), max: Point::new(max.x, max.y) }
}
