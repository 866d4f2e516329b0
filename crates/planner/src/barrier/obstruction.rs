//! A set of blockers that answers quickly which of them block a move.

use super::{Blocker, Feature};
use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector as ParryVector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use std::f64::consts::TAU;
use traverse_geometry::{Arc, Bounds, Edge, Point, Vector, cross, positive_angle};
use traverse_solve::{Budget, Interrupt};

/// Blockers in bounding-volume trees. Building costs n log n; a query about log n and what it meets.
#[derive(Default)]
pub(crate) struct Obstruction {
    blockers: Vec<Blocker>,
    trees: Vec<(usize, Bvh)>,
}

impl Obstruction {
    /// Most blockers in one tree: building it stays far below the time in which a cancelled call must stop.
    pub(crate) const TREE_SIZE: usize = 16_384;

    /// Adds `blockers`.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn add(&mut self, blockers: &[Blocker], budget: &Budget) -> Result<(), Interrupt> {
        for part in blockers.chunks(Self::TREE_SIZE) {
            budget.check(0)?;
            let first = self.blockers.len();
            let leaves = part.iter().enumerate().map(|(i, blocker)| (i, aabb(&blocker.bounds())));
            self.trees.push((first, Bvh::from_iter(BvhBuildStrategy::Binned, leaves)));
            self.blockers.extend_from_slice(part);
        }
        Ok(())
    }

    /// Every blocker that blocks the move `piece`.
    pub(crate) fn blocking<'a>(&'a self, piece: &'a Edge) -> impl Iterator<Item = &'a Blocker> + 'a {
        self.near(piece).filter(move |blocker| blocker.blocks(piece))
    }

    /// Every blocker that may block the move `piece`, and some that don't.
    pub(crate) fn near<'a>(&'a self, piece: &'a Edge) -> impl Iterator<Item = &'a Blocker> + 'a {
        let bounds = piece.bounds();
        self.trees.iter().flat_map(move |(first, tree)| {
            tree.leaves(move |node| may_meet(node, piece, &bounds))
                .map(move |leaf| &self.blockers[first + leaf as usize])
        })
    }

    /// The offsets of `feature` at which the planned path would come too near to some blocker: disjoint or not,
    /// each with the blocker's owner.
    pub(crate) fn blocked_offsets<'a>(
        &'a self,
        feature: &'a Feature,
    ) -> impl Iterator<Item = (f64, f64, usize)> + 'a {
        let circle =
            Arc::from_angles(feature.center, feature.plan_radius, feature.start_angle, feature.sweep);
        let bounds = circle.bounds();
        self.trees
            .iter()
            .flat_map(move |(first, tree)| {
                tree.leaves(move |node| overlaps(node, &bounds))
                    .map(move |leaf| &self.blockers[first + leaf as usize])
            })
            .flat_map(move |blocker| {
                blocked_by(feature, blocker).into_iter().map(move |(from, to)| (from, to, blocker.owner))
            })
    }
}

/// The offsets of `feature` nearer to the blocker's edge than its limit. Boundaries are where the circle meets the
/// edge's parallels and end circles; between two of them one point decides.
fn blocked_by(feature: &Feature, blocker: &Blocker) -> Vec<(f64, f64)> {
    let mut cuts = vec![0.0, feature.sweep];
    let mut cut = |center: Point, radius: f64| circle_offsets(feature, center, radius, &mut cuts);
    cut(blocker.edge.start(), blocker.limit);
    cut(blocker.edge.end(), blocker.limit);
    match blocker.edge {
        Edge::Arc(arc) => {
            cut(arc.center, arc.radius + blocker.limit);
            cut(arc.center, arc.radius - blocker.limit);
        }
        Edge::Segment(segment) => {
            if let Some(along) = segment.vector().try_normalize(0.0) {
                for side in [blocker.limit, -blocker.limit] {
                    line_offsets(feature, segment.start, along, side, &mut cuts);
                }
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut blocked: Vec<(f64, f64)> = Vec::new();
    for pair in cuts.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let middle = feature.plan_point((from + to) / 2.0);
        if to > from && blocker.edge.distance_to_point(middle) < blocker.limit {
            match blocked.last_mut() {
                Some(last) if last.1 == from => last.1 = to,
                _ => blocked.push((from, to)),
            }
        }
    }
    blocked
}

/// Adds the offsets at which the feature's circle meets another circle.
fn circle_offsets(feature: &Feature, center: Point, radius: f64, cuts: &mut Vec<f64>) {
    let axis = center - feature.center;
    let distance = axis.norm();
    let own = feature.plan_radius;
    if distance == 0.0 || radius <= 0.0 || own == 0.0 {
        return;
    }
    let cosine = (distance * distance + own * own - radius * radius) / (2.0 * distance * own);
    push_pair(feature, axis.y.atan2(axis.x), cosine, cuts);
}

/// Adds the offsets at which the feature's circle meets the line `side` to the left of one through `start`.
fn line_offsets(feature: &Feature, start: Point, along: Vector, side: f64, cuts: &mut Vec<f64>) {
    if feature.plan_radius == 0.0 {
        return;
    }
    let normal = traverse_geometry::left_of(along);
    let height = normal.dot(&(feature.center - start));
    push_pair(feature, normal.y.atan2(normal.x), (side - height) / feature.plan_radius, cuts);
}

fn push_pair(feature: &Feature, middle: f64, cosine: f64, cuts: &mut Vec<f64>) {
    if cosine.abs() > 1.0 {
        return;
    }
    let half = cosine.acos();
    for angle in [middle - half, middle + half] {
        let offset = positive_angle(angle - feature.start_angle);
        if offset < feature.sweep.min(TAU) {
            cuts.push(offset);
        }
    }
}

fn aabb(bounds: &Bounds) -> Aabb {
    Aabb::new(ParryVector::new(bounds.min.x, bounds.min.y), ParryVector::new(bounds.max.x, bounds.max.y))
}

fn overlaps(node: &BvhNode, bounds: &Bounds) -> bool {
    let (min, max) = (node.mins(), node.maxs());
    min.x <= bounds.max.x && bounds.min.x <= max.x && min.y <= bounds.max.y && bounds.min.y <= max.y
}

/// Whether a box may meet the move: by its own box, and by the line that a straight move runs on.
fn may_meet(node: &BvhNode, piece: &Edge, bounds: &Bounds) -> bool {
    if !overlaps(node, bounds) {
        return false;
    }
    let Edge::Segment(segment) = piece else { return true };
    let (min, max) = (node.mins(), node.maxs());
    let along = segment.vector();
    let center = Vector::new((min.x + max.x) / 2.0, (min.y + max.y) / 2.0);
    let half = Vector::new((max.x - min.x) / 2.0, (max.y - min.y) / 2.0);
    let distance = cross(along, center - segment.start.coords).abs();
    let reach = half.x * along.y.abs() + half.y * along.x.abs();
    // A relative margin far above rounding keeps the filter on the safe side.
    distance <= reach * (1.0 + 1e-9) + along.norm() * 1e-9
}
