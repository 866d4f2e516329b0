//! What is drawn twice on top of itself counts once.

use super::Loop;
use super::chain::Link;
use super::snap::snap;
use crate::Curve;
use std::collections::HashMap;
use traverse_geometry::Point;

/// A curve is compared with so many of its kind at most: bounds the work on hostile drawings.
const MOST_COMPARISONS: usize = 8;

/// A loop is compared with another one at so many of its points at most.
const SAMPLES: usize = 64;

/// The links without those whose curve repeats the curve of an earlier link, run either way.
pub(super) fn without_repeated_links(
    links: Vec<Link>,
    curves: &[Curve],
    tolerance_mm: f64,
    repeated: &mut dyn FnMut(usize),
) -> Vec<Link> {
    let middles: Vec<Point> = links.iter().map(|link| middle_of(&curves[link.curve])).collect();
    let middle_of = snap(&middles, tolerance_mm).vertex_of;
    let mut kept: Vec<Link> = Vec::with_capacity(links.len());
    let mut alike: HashMap<(usize, usize, usize, usize), Vec<usize>> = HashMap::new();
    for (link, middle) in links.into_iter().zip(middle_of) {
        let edges = curves[link.curve].edge_count();
        let kind = alike.entry((link.from.min(link.to), link.from.max(link.to), edges, middle)).or_default();
        let same = |&other: &usize| {
            let other: &Link = &kept[other];
            same_way(&curves[link.curve], &curves[other.curve], link.from == other.from, tolerance_mm)
        };
        if kind.iter().take(MOST_COMPARISONS).any(same) {
            repeated(link.curve);
        } else {
            kind.push(kept.len());
            kept.push(link);
        }
    }
    kept
}

/// A point that is the same whichever way the curve runs.
fn middle_of(curve: &Curve) -> Point {
    let edges = curve.edge_count();
    if edges.is_multiple_of(2) {
        return curve.vertices[edges / 2];
    }
    curve.edges().nth(edges / 2).map_or(curve.vertices[0], |edge| edge.point_at(0.5))
}

/// Whether two open curves of as many edges, with the same ends, run the same way.
fn same_way(a: &Curve, b: &Curve, same_direction: bool, tolerance_mm: f64) -> bool {
    let edges = a.edge_count();
    let near = |p: Point, q: Point| (p - q).norm() <= 2.0 * tolerance_mm;
    let b_edges: Vec<_> = b.edges().collect();
    a.edges().enumerate().all(|(i, edge)| {
        let other = if same_direction { b_edges[i] } else { b_edges[edges - 1 - i].reversed() };
        near(edge.end(), other.end()) && near(edge.point_at(0.5), other.point_at(0.5))
    })
}

/// The loops without those that repeat an earlier one, however they are cut into edges.
pub(super) fn without_repeated_loops(
    loops: Vec<Loop>,
    tolerance_mm: f64,
    repeated: &mut dyn FnMut(&Loop),
) -> Vec<Loop> {
    let corners: Vec<Point> =
        loops.iter().map(Loop::bounds).flat_map(|bounds| [bounds.min, bounds.max]).collect();
    let corner_of = snap(&corners, tolerance_mm).vertex_of;
    let mut kept: Vec<Loop> = Vec::with_capacity(loops.len());
    let mut alike: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
    for (each, corners) in loops.into_iter().zip(corner_of.chunks_exact(2)) {
        let kind = alike.entry((corners[0], corners[1])).or_default();
        if kind.iter().take(MOST_COMPARISONS).any(|&other| same_loop(&each, &kept[other], tolerance_mm)) {
            repeated(&each);
        } else {
            kind.push(kept.len());
            kept.push(each);
        }
    }
    kept
}

/// Equal area, and sampled points of one lie on the other.
fn same_loop(a: &Loop, b: &Loop, tolerance_mm: f64) -> bool {
    if (a.area() - b.area()).abs() > tolerance_mm * a.length() {
        return false;
    }
    let stride = a.vertices.len().div_ceil(SAMPLES);
    a.edges().step_by(stride).flat_map(|edge| [edge.start(), edge.point_at(0.5)]).all(|p| {
        b.edges().any(|edge| {
            edge.bounds().grown(tolerance_mm).contains(p) && edge.distance_to_point(p) <= tolerance_mm
        })
    })
}
