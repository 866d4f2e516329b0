//! Distance between two edges, circular ones exactly: no flattening.
//!
//! The least distance lies at an end of one edge, where both cross (0), or where a common normal meets both:
//! for an arc that normal runs through its centre. Cost: constant.

use crate::{Arc, Edge, Point, Segment, Vector, left_of};

impl Edge {
    /// Distance between the nearest points of both edges; 0 when they touch or cross.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        match (self, other) {
            (Self::Segment(a), Self::Segment(b)) => segment_segment(a, b),
            (Self::Segment(a), Self::Arc(b)) => segment_arc(a, b),
            (Self::Arc(a), Self::Segment(b)) => segment_arc(b, a),
            (Self::Arc(a), Self::Arc(b)) => arc_arc(a, b),
        }
    }
}

fn segment_segment(a: &Segment, b: &Segment) -> f64 {
    if a.meets(b) {
        return 0.0;
    }
    a.distance_to_point(b.start)
        .min(a.distance_to_point(b.end))
        .min(b.distance_to_point(a.start))
        .min(b.distance_to_point(a.end))
}

fn segment_arc(segment: &Segment, arc: &Arc) -> f64 {
    let ends = segment
        .distance_to_point(arc.start)
        .min(segment.distance_to_point(arc.end))
        .min(arc.distance_to_point(segment.start))
        .min(arc.distance_to_point(segment.end));
    let foot = segment.nearest_point(arc.center);
    let nearest = ends.min(arc.distance_to_point(foot));
    if nearest > 0.0 && segment_crosses_arc(segment, arc) { 0.0 } else { nearest }
}

fn segment_crosses_arc(segment: &Segment, arc: &Arc) -> bool {
    let Some(along) = segment.vector().try_normalize(0.0) else { return false };
    let to_center = arc.center - segment.start;
    let foot = to_center.dot(&along);
    let offset = to_center.dot(&left_of(along));
    let half_square = (arc.radius - offset) * (arc.radius + offset);
    if half_square < 0.0 {
        return false;
    }
    let half = half_square.sqrt();
    let length = segment.length();
    [foot - half, foot + half]
        .into_iter()
        .any(|t| (0.0..=length).contains(&t) && arc.spans(segment.start + along * t - arc.center))
}

fn arc_arc(a: &Arc, b: &Arc) -> f64 {
    let mut nearest = a
        .distance_to_point(b.start)
        .min(a.distance_to_point(b.end))
        .min(b.distance_to_point(a.start))
        .min(b.distance_to_point(a.end));
    let Some(axis) = (b.center - a.center).try_normalize(0.0) else { return nearest };
    for direction in [axis, -axis] {
        if a.spans(direction) {
            nearest = nearest.min(b.distance_to_point(a.center + direction * a.radius));
        }
    }
    if nearest > 0.0
        && circle_crossings(a, b, axis)
            .into_iter()
            .flatten()
            .any(|p| a.spans(p - a.center) && b.spans(p - b.center))
    {
        return 0.0;
    }
    nearest
}

/// Where both full circles cross, if they do.
fn circle_crossings(a: &Arc, b: &Arc, axis: Vector) -> Option<[Point; 2]> {
    let distance = (b.center - a.center).norm();
    let along = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2.0;
    let half_square = (a.radius - along) * (a.radius + along);
    if half_square < 0.0 {
        return None;
    }
    let foot = a.center + axis * along;
    let half = left_of(axis) * half_square.sqrt();
    Some([foot + half, foot - half])
}
