//! The pieces of barriers' borders about an end, and where straight and circular curves cross.

use super::legal::Legal;
use crate::barrier::{Clearance, Outline};
use std::f64::consts::TAU;
use traverse_geometry::{
    Arc, CONTACT_TOLERANCE_MM, CornerStyle, Edge, Point, Segment, Vector, cross, left_of, unit,
};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many edges.
const EDGES_BETWEEN_CHECKS: usize = 4096;

/// A piece of the border of a barrier, or a bit more.
pub(crate) struct Piece {
    pub(crate) edge: Edge,
    /// Millimetres from the end.
    pub(crate) distance: f64,
    /// Whether the end lies inside this barrier.
    pub(crate) around: bool,
}

/// Pieces within `within` of the end. Farther ones of barriers around the end only when all are asked for. Cost: linear.
///
/// # Errors
/// The budget ended.
pub(crate) fn pieces_near(legal: &Legal<'_>, within: f64, budget: &Budget) -> Result<Vec<Piece>, Interrupt> {
    let mut edges = Vec::new();
    let mut pieces = Vec::new();
    let barriers = legal.barriers;
    let mitred = matches!(barriers.scene.corner_style, CornerStyle::Miter { .. });
    for owner in barriers.owners().filter(|owner| !legal.left_out.contains(owner)) {
        budget.check(0)?;
        let around = legal.is_inside(owner);
        if !around && within.is_infinite() {
            continue;
        }
        for outline in barriers.outlines(owner) {
            let reach = within + outline.clearance.planned();
            if !around && !mitred && !outline.ring.bounds().grown(reach).contains(legal.point) {
                continue;
            }
            add_border(&outline, &mut edges, budget)?;
        }
        for edge in edges.drain(..) {
            let distance = edge.distance_to_point(legal.point);
            if distance <= within {
                pieces.push(Piece { edge, distance, around });
            }
        }
    }
    Ok(pieces)
}

/// Adds the border of one ring's barrier at the clearance that is asked for; at 0 the ring itself.
///
/// # Errors
/// The budget ended.
pub(crate) fn barrier_border(
    outline: &Outline<'_>,
    edges: &mut Vec<Edge>,
    budget: &Budget,
) -> Result<(), Interrupt> {
    if outline.clearance.asked == 0.0 {
        edges.extend(outline.ring.edges());
        return Ok(());
    }
    add_border(outline, edges, budget)
}

/// Adds the border of one ring's barrier: parallels of its edges, and what lies round its corners.
fn add_border(outline: &Outline<'_>, edges: &mut Vec<Edge>, budget: &Budget) -> Result<(), Interrupt> {
    let clearance = outline.clearance;
    if matches!(clearance.style, CornerStyle::Miter { .. }) && clearance.asked > 0.0 {
        // Blockers of mitred barriers are their borders, one contact tolerance further in.
        let grown = Clearance { asked: clearance.asked + CONTACT_TOLERANCE_MM, ..clearance };
        let mut blockers = Vec::new();
        Outline { clearance: grown, ..*outline }.add_blockers(&mut blockers);
        edges.extend(blockers.iter().map(|blocker| blocker.edge));
        return Ok(());
    }
    let mut features = Vec::new();
    outline.add_features(&mut features, budget)?;
    for (i, circle) in features.iter().enumerate() {
        if i.is_multiple_of(EDGES_BETWEEN_CHECKS) {
            budget.check(0)?;
        }
        let sweep = circle.sweep.min(TAU);
        edges.push(Edge::Arc(Arc::from_angles(circle.center, circle.plan_radius, circle.start_angle, sweep)));
    }
    let sides: &[f64] = if outline.ring.touches_itself() { &[-1.0, 1.0] } else { &[-1.0] };
    for (i, edge) in outline.ring.edges().enumerate() {
        if i.is_multiple_of(EDGES_BETWEEN_CHECKS) {
            budget.check(0)?;
        }
        edges.extend(sides.iter().filter_map(|side| beside(&edge, side * clearance.planned())));
    }
    Ok(())
}

/// The edge moved to its left by `by`, negative: to its right. None: an arc that shrank to nothing.
fn beside(edge: &Edge, by: f64) -> Option<Edge> {
    match edge {
        Edge::Segment(segment) => {
            let by = left_of(edge.direction_at(0.0)) * by;
            Some(Edge::Segment(Segment::new(segment.start + by, segment.end + by)))
        }
        Edge::Arc(arc) => {
            let radius = arc.radius - by * arc.sweep.signum();
            (radius > 0.0)
                .then(|| Edge::Arc(Arc::from_angles(arc.center, radius, arc.start_angle, arc.sweep)))
        }
    }
}

/// Adds how far along the ray from `from` it meets the edge's line or circle.
pub(crate) fn crossings_with_ray(edge: &Edge, from: Point, direction: Vector, ways: &mut Vec<f64>) {
    let mut add = |way: f64| {
        if way.is_finite() && way >= 0.0 {
            ways.push(way);
        }
    };
    match edge {
        Edge::Segment(segment) => {
            let along = segment.vector();
            let sine = cross(direction, along);
            if sine != 0.0 {
                add(cross(segment.start - from, along) / sine);
            } else {
                // The ray may run along the line.
                add((segment.start - from).dot(&direction));
                add((segment.end - from).dot(&direction));
            }
        }
        Edge::Arc(arc) => {
            let to_center = arc.center - from;
            let foot = to_center.dot(&direction);
            let offset = cross(direction, to_center);
            let half_square = (arc.radius - offset) * (arc.radius + offset);
            if half_square >= 0.0 {
                let half = half_square.sqrt();
                add(foot - half);
                add(foot + half);
            }
        }
    }
}

/// Adds where the lines or circles of two edges cross, and their ends.
pub(crate) fn crossings(one: &Edge, other: &Edge, found: &mut Vec<Point>) {
    match (one, other) {
        (Edge::Segment(a), b) | (b, Edge::Segment(a)) => {
            let Some(direction) = a.vector().try_normalize(0.0) else { return };
            let mut ways = Vec::new();
            // Both ways along the line.
            for (from, direction) in [(a.start, direction), (a.start, -direction)] {
                ways.clear();
                crossings_with_ray(b, from, direction, &mut ways);
                found.extend(ways.iter().map(|way| from + direction * *way));
            }
        }
        (Edge::Arc(a), Edge::Arc(b)) => {
            let axis = b.center - a.center;
            let distance = axis.norm();
            if distance == 0.0 {
                return;
            }
            let along = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2.0;
            let half_square = (a.radius - along) * (a.radius + along);
            if half_square >= 0.0 {
                let foot = a.center + axis * (along / distance);
                let half = left_of(axis) * (half_square.sqrt() / distance);
                found.extend([foot + half, foot - half]);
            }
        }
    }
}

/// The two directions from `from` that touch a circle; none from inside.
pub(crate) fn tangents(from: Point, center: Point, radius: f64) -> Option<[Vector; 2]> {
    let to_center = center - from;
    let distance = to_center.norm();
    if distance < radius * (1.0 - 1e-9) || distance == 0.0 {
        return None;
    }
    let angle = to_center.y.atan2(to_center.x);
    let half = (radius / distance).min(1.0).asin();
    Some([unit(angle - half), unit(angle + half)])
}
