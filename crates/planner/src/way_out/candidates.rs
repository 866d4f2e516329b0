//! Where a shortest way out can end.

use super::ROUNDING_MM;
use super::border::{Piece, crossings, crossings_with_ray, tangents};
use super::legal::Legal;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Point, Vector, left_of};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many pairs.
const PAIRS_BETWEEN_CHECKS: usize = 8192;

/// Feet of perpendiculars from the end on the pieces around it, within `within`.
pub(crate) fn feet(point: Point, pieces: &[Piece], within: f64) -> Vec<Point> {
    let foot = |piece: &Piece| match &piece.edge {
        Edge::Segment(_) => Some(piece.edge.nearest_point(point)),
        Edge::Arc(arc) => {
            let spoke = (point - arc.center).try_normalize(0.0)?;
            Some(arc.center + spoke * arc.radius)
        }
    };
    let around = pieces.iter().filter(|piece| piece.around);
    around.filter_map(foot).filter(|foot| (foot - point).norm() <= within).collect()
}

/// Crossings of borders, and of borders with rays that touch what the way keeps away from, nearer than `limit`.
///
/// # Errors
/// The budget ended.
pub(crate) fn further(
    legal: &Legal<'_>,
    pieces: &[Piece],
    limit: f64,
    budget: &Budget,
) -> Result<Vec<Point>, Interrupt> {
    let near: Vec<&Piece> = pieces.iter().filter(|piece| piece.distance < limit + ROUNDING_MM).collect();
    let mut found: Vec<Point> = Vec::new();
    let mut pairs = 0_usize;
    let look = |pairs: &mut usize| {
        *pairs += 1;
        if pairs.is_multiple_of(PAIRS_BETWEEN_CHECKS) { budget.check(0) } else { Ok(()) }
    };
    let is_near = |p: &Point| (p - legal.point).norm() < limit;
    let mut crossed = Vec::new();
    for (i, one) in near.iter().enumerate() {
        for other in &near[..i] {
            look(&mut pairs)?;
            if one.around || other.around {
                crossed.clear();
                crossings(&one.edge, &other.edge, &mut crossed);
                found.extend(crossed.iter().filter(|p| is_near(p)));
            }
        }
    }
    let directions = touching_directions(legal, &near, limit, budget)?;
    let mut ways = Vec::new();
    for direction in directions {
        for piece in near.iter().filter(|piece| piece.around) {
            look(&mut pairs)?;
            ways.clear();
            crossings_with_ray(&piece.edge, legal.point, direction, &mut ways);
            found.extend(ways.iter().map(|way| legal.point + direction * *way).filter(|p| is_near(p)));
        }
    }
    Ok(found)
}

/// Directions of rays that touch a barrier within `limit`: the smaller ones of what the end lies in, and others.
fn touching_directions(
    legal: &Legal<'_>,
    near: &[&Piece],
    limit: f64,
    budget: &Budget,
) -> Result<Vec<Vector>, Interrupt> {
    let mut directions: Vec<Vector> = Vec::new();
    let point = legal.point;
    for (i, blocker) in legal.smaller.iter().enumerate() {
        if i.is_multiple_of(PAIRS_BETWEEN_CHECKS) {
            budget.check(0)?;
        }
        add_directions(
            point,
            &blocker.edge,
            blocker.limit + CONTACT_TOLERANCE_MM / 2.0,
            limit,
            &mut directions,
        );
    }
    for &owner in &legal.touched {
        for edge in legal.barriers.outlines(owner).flat_map(|outline| outline.ring.edges()) {
            add_directions(point, &edge, 0.0, limit, &mut directions);
        }
    }
    // Borders of other barriers are touched themselves.
    for piece in near.iter().filter(|piece| !piece.around) {
        add_directions(point, &piece.edge, 0.0, limit, &mut directions);
    }
    directions.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    directions.dedup();
    Ok(directions)
}

/// Directions that touch what lies within `radius` of `edge`.
fn add_directions(point: Point, edge: &Edge, radius: f64, limit: f64, directions: &mut Vec<Vector>) {
    let distance = edge.distance_to_point(point);
    if distance - radius > limit {
        return;
    }
    for end in [edge.start(), edge.end()] {
        directions.extend(tangents(point, end, radius).into_iter().flatten());
    }
    if let Edge::Arc(arc) = edge {
        directions.extend(tangents(point, arc.center, arc.radius + radius).into_iter().flatten());
    }
    // On its border: along it.
    if (distance - radius).abs() <= CONTACT_TOLERANCE_MM {
        let along = match edge {
            Edge::Segment(segment) => segment.vector().try_normalize(0.0),
            Edge::Arc(arc) => (point - arc.center).try_normalize(0.0).map(left_of),
        };
        directions.extend(along.into_iter().flat_map(|along| [along, -along]));
    }
}
