//! Where on a feature a planned path would come too near to a blocker.

use super::{Blocker, Feature};
use std::f64::consts::TAU;
use traverse_geometry::{Edge, Point, Vector, left_of, positive_angle};

/// The offsets of `feature` nearer to the blocker's edge than its limit. Boundaries are where the circle meets the
/// edge's parallels and end circles; between two of them one point decides.
pub(super) fn blocked_by(feature: &Feature, blocker: &Blocker) -> Vec<(f64, f64)> {
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
    let normal = left_of(along);
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
