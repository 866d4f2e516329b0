//! SPLINE: a B-spline by its control points, or a curve through points.

use super::budget::VertexBudget;
use super::entity::{Shape, ShapeOrWhy};
use super::fit_points::curve_through;
use super::heights::{Heights, height};
use super::nurbs::{LARGEST_DEGREE, is_consistent, without_rounding};
use super::record::Record;
use crate::{ReadError, WhyUnused};
use traverse_geometry::{Point, Vector};

/// A B-spline, rational or not, from the knot of its degree to the one of its count of control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Spline {
    /// 1 to [`LARGEST_DEGREE`].
    pub(super) degree: usize,
    /// More than its degree.
    pub(super) points: Vec<Point>,
    /// Positive, one for each control point; empty when all are equal.
    pub(super) weights: Vec<f64>,
    /// Never falling; as many as control points, degree and one.
    pub(super) knots: Vec<f64>,
    /// Whether it is meant to come back to where it began.
    pub(super) closed: bool,
    /// Whether its points differ in height.
    pub(super) climbs: bool,
}

/// Reads a SPLINE.
///
/// Control points go before points to run through: programs write both for one curve. Without control points the
/// curve is the one that CAD programs draw: see [`curve_through`]. Without knots they are uniform, clamped at both
/// ends. What contradicts itself is [`WhyUnused::Inconsistent`].
pub(super) fn read_spline(
    record: &mut Record<'_, '_>,
    budget: &mut VertexBudget,
) -> Result<ShapeOrWhy, ReadError> {
    let (mut flags, mut degree) = (0, 3);
    let (mut controls, mut through): (Vec<Point>, Vec<Point>) = (Vec::new(), Vec::new());
    let (mut weights, mut knots) = (Vec::new(), Vec::new());
    let (mut tangents, mut heights) = ([Vector::zeros(); 2], Heights::default());
    while let Some(group) = record.next_group()? {
        match group.code {
            70 => flags = group.integer()?,
            71 => degree = group.integer()?,
            10 | 11 => {
                budget.take(1)?;
                let points = if group.code == 10 { &mut controls } else { &mut through };
                points.push(Point::new(group.real()?, 0.0));
            }
            20 | 21 => {
                let points = if group.code == 20 { &mut controls } else { &mut through };
                if let Some(point) = points.last_mut() {
                    point.y = group.real()?;
                }
            }
            30 | 31 => heights.note(height(&group)),
            40 => knots.push(group.real()?),
            41 => weights.push(group.real()?),
            12 => tangents[0].x = group.real()?,
            22 => tangents[0].y = group.real()?,
            13 => tangents[1].x = group.real()?,
            23 => tangents[1].y = group.real()?,
            _ => {}
        }
    }
    let closed = flags & 1 != 0;
    if controls.is_empty() {
        return Ok(match curve_through(&through, tangents, closed) {
            Some(spline) => Ok(Shape::Spline(Box::new(Spline { climbs: heights.vary(), ..spline }))),
            None => Err(WhyUnused::NoLength),
        });
    }
    let Some(degree) = usize::try_from(degree).ok().filter(|degree| (1..=LARGEST_DEGREE).contains(degree))
    else {
        return Ok(Err(WhyUnused::Inconsistent));
    };
    if knots.is_empty() {
        knots = clamped_uniform_knots(controls.len(), degree);
    }
    let knots = without_rounding(knots);
    let same = weights.windows(2).all(|pair| pair[0] == pair[1]);
    if same && weights.len() == controls.len() && weights.first().is_some_and(|&weight| weight > 0.0) {
        weights.clear();
    }
    let spline = Spline { degree, points: controls, weights, knots, closed, climbs: heights.vary() };
    Ok(if is_consistent(&spline) {
        Ok(Shape::Spline(Box::new(spline)))
    } else {
        Err(WhyUnused::Inconsistent)
    })
}

fn clamped_uniform_knots(points: usize, degree: usize) -> Vec<f64> {
    let last = points.saturating_sub(degree);
    (0..points + degree + 1).map(|i| i.saturating_sub(degree).min(last) as f64).collect()
}
