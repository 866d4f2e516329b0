//! A tree of bounding boxes over every edge of a scene, each box holding what the edge keeps the tool from.
//!
//! Built by parry, whose vectors are glam's; only boxes go in and out. Cost: O(n log n) to build, O(log n + hits)
//! to ask.

use crate::boundary::Boundary;
use crate::curve::{Curve, right_of};
use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector as ParryVector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction};
use traverse_geometry::{Bounds, Point, Vector};

/// The tree, and how its boxes relate to margins.
pub(crate) struct BoundaryTree {
    bvh: Bvh,
    /// No margin is less than the distance to the edge's box divided by this: above 1 where corners are mitred.
    stretch: f64,
}

impl BoundaryTree {
    /// The tree over every edge of `boundary`.
    pub(crate) fn over(boundary: &Boundary) -> Self {
        let mut stretch = 1.0_f64;
        let boxes = (0..boundary.len()).map(|edge| {
            let edge = edge as u32;
            let solid = boundary.solid(edge);
            let mut bounds = boundary.curve(edge).bounds().grown(solid.clearance);
            if let Some(limit) = solid.mitred()
                && let Some(corner) = boundary.corner_after(edge)
            {
                for vertex in corner.outline(solid.clearance, limit) {
                    stretch = stretch.max((vertex - corner.at).norm() / solid.clearance);
                    bounds = bounds.with(vertex);
                }
            }
            // Rounding of the box itself.
            (edge as usize, aabb(bounds.grown(1e-9)))
        });
        let bvh = Bvh::from_iter(BvhBuildStrategy::Binned, boxes);
        Self { bvh, stretch: stretch * (1.0 + 1e-9) }
    }

    /// Calls `found` with every edge whose box comes within `reach` of `step`, possibly a few more.
    pub(crate) fn near(&self, step: &StepBox, reach: f64, mut found: impl FnMut(u32)) {
        self.bvh.traverse(|node| {
            if step.distance_to(&bounds(node)) > reach {
                return TraversalAction::Prune;
            }
            if let Some(edge) = node.leaf_data() {
                found(edge);
            }
            TraversalAction::Continue
        });
    }

    /// The least margin below `most`, where `margin` gives it for an edge.
    pub(crate) fn least_margin(
        &self,
        step: &StepBox,
        most: f64,
        margin: impl Fn(u32) -> Option<f64>,
    ) -> Option<f64> {
        let bound = |node: &BvhNode, _| step.distance_to(&bounds(node)) / self.stretch;
        self.bvh.find_best(most, bound, |edge, _| margin(edge)).map(|(_, margin)| margin)
    }

    /// Calls `found` with every edge that a ray from `from` to the right may cross, up to `right`.
    pub(crate) fn to_the_right(&self, from: Point, right: f64, mut found: impl FnMut(u32)) {
        self.bvh.traverse(|node| {
            let box_ = bounds(node);
            if box_.min.y > from.y || box_.max.y < from.y || box_.max.x < from.x || box_.min.x > right {
                return TraversalAction::Prune;
            }
            if let Some(edge) = node.leaf_data() {
                found(edge);
            }
            TraversalAction::Continue
        });
    }
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
