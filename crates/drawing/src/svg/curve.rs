//! From an outline to a curve in millimetres.

use super::affine::Affine;
use super::budget::Budget;
use super::outline::{Outline, Piece};
use crate::curve::CurveBuilder;
use crate::fit::{CubicBezier, EllipticArc, Smooth, fitted_edges};
use crate::{Curve, ReadError};
use std::f64::consts::{PI, TAU};
use traverse_geometry::{COORDINATE_LIMIT_MM, Point, RADIUS_LIMIT_MM, cross};

/// Half axes of a circle differ by this share of its radius at most: rounding.
const CIRCLE_TOLERANCE: f64 = 1e-9;

/// An end nearer than this to the start of a closed outline is its start, millimetres.
const CLOSING_TOLERANCE_MM: f64 = 1e-6;

/// Why an outline can't become a curve.
pub(super) enum Refused {
    /// A coordinate is out of range, millimetres.
    OutOfRange(f64),
    Limit(ReadError),
}

/// The outline through `to_mm` as a curve; none when it has no length. Circular arcs that stay circular are exact, all
/// other curves are fitted within `tolerance_mm`.
pub(super) fn curve_of(
    outline: &Outline,
    to_mm: &Affine,
    tolerance_mm: f64,
    budget: &mut Budget,
) -> Result<Option<Curve>, Refused> {
    let start = in_range(to_mm.point(outline.start))?;
    let mut edges = Vec::with_capacity(outline.pieces.len() + 1);
    let mut deviation_mm = 0.0;
    for piece in &outline.pieces {
        let end = in_range(to_mm.point(piece.end()))?;
        let new = match piece {
            Piece::Line(_) => vec![(0.0, end)],
            Piece::Cubic(cubic) => {
                deviation_mm = tolerance_mm;
                fitted(&mapped_cubic(cubic, to_mm)?, tolerance_mm, budget, None)?
            }
            Piece::Arc(arc, _) => {
                let arc = mapped_arc(arc, to_mm);
                if is_circle(&arc) {
                    circle_edges(&arc, end)
                } else {
                    deviation_mm = tolerance_mm;
                    fitted(&arc, tolerance_mm, budget, Some(end))?
                }
            }
        };
        budget.vertices(new.len()).map_err(Refused::Limit)?;
        edges.extend(new);
    }
    for (_, end) in &edges {
        in_range(*end)?;
    }
    if outline.closed {
        match edges.last_mut() {
            Some((_, end)) if (*end - start).norm() <= CLOSING_TOLERANCE_MM => *end = start,
            _ => edges.push((0.0, start)),
        }
    }
    budget.vertices(1).map_err(Refused::Limit)?;
    let builder =
        edges.into_iter().fold(CurveBuilder::from(start), |builder, (bulge, end)| builder.edge(bulge, end));
    let curve = if outline.closed { builder.closed() } else { builder.open() };
    Ok(curve.map(|curve| Curve { deviation_mm, ..curve }))
}

type Edges = Vec<(f64, Point)>;

fn in_range(point: Point) -> Result<Point, Refused> {
    let within = |value: f64| value.abs() <= COORDINATE_LIMIT_MM;
    match [point.x, point.y].into_iter().find(|&value| !within(value)) {
        Some(value) => Err(Refused::OutOfRange(value)),
        None => Ok(point),
    }
}

fn mapped_cubic(cubic: &CubicBezier, to_mm: &Affine) -> Result<CubicBezier, Refused> {
    let [a, b, c, d] = cubic.points.map(|point| to_mm.point(point));
    Ok(CubicBezier::new(in_range(a)?, in_range(b)?, in_range(c)?, in_range(d)?))
}

fn mapped_arc(arc: &EllipticArc, to_mm: &Affine) -> EllipticArc {
    EllipticArc {
        center: to_mm.point(arc.center),
        first: to_mm.vector(arc.first),
        second: to_mm.vector(arc.second),
        ..*arc
    }
}

fn fitted(
    curve: &impl Smooth,
    tolerance_mm: f64,
    budget: &Budget,
    exact_end: Option<Point>,
) -> Result<Edges, Refused> {
    for i in 0..=8 {
        in_range(curve.point(f64::from(i) / 8.0))?;
    }
    let mut edges = fitted_edges(curve, tolerance_mm, budget.vertices_left())
        .ok_or_else(|| Refused::Limit(budget.too_many_vertices()))?;
    if let (Some(end), Some(last)) = (exact_end, edges.last_mut()) {
        last.1 = end;
    }
    Ok(edges)
}

fn is_circle(arc: &EllipticArc) -> bool {
    let (first, second) = (arc.first.norm(), arc.second.norm());
    let allowed = CIRCLE_TOLERANCE * first;
    first > 0.0
        && first <= RADIUS_LIMIT_MM
        && arc.sweep != 0.0
        && (first - second).abs() <= allowed
        && arc.first.dot(&arc.second).abs() <= allowed * first
}

/// An arc of a circle as exact edges of half a turn at most.
fn circle_edges(arc: &EllipticArc, end: Point) -> Edges {
    let sweep = arc.sweep * cross(arc.first, arc.second).signum();
    if sweep.abs() >= TAU {
        // Opposite to the last bit, so that both halves have one centre.
        let opposite = arc.center - (arc.point(0.0) - arc.center);
        return vec![(sweep.signum(), opposite), (sweep.signum(), end)];
    }
    let count = if sweep.abs() > PI + 1e-9 { 2 } else { 1 };
    let bulge = (sweep / f64::from(count) / 4.0).tan().clamp(-1.0, 1.0);
    let middle = (count == 2).then(|| (bulge, arc.point(0.5)));
    middle.into_iter().chain([(bulge, end)]).collect()
}
