//! LWPOLYLINE and POLYLINE.

use super::budget::VertexBudget;
use super::entity::{Shape, ShapeOrWhy};
use super::groups::Group;
use super::heights::{Heights, height};
use super::record::{Head, Record};
use crate::{ReadError, WhyUnused};
use traverse_geometry::Point;

/// Segments and arcs end to end.
#[derive(Debug, Default)]
pub(super) struct Polyline {
    /// Each with the bulge, tan(sweep / 4), of the edge that leaves it.
    pub(super) vertices: Vec<(Point, f64)>,
    /// Whether the last one is joined to the first.
    pub(super) closed: bool,
    /// Whether it is given in world coordinates whatever its extrusion: a 3D polyline.
    pub(super) in_space: bool,
    /// Whether it is a band somewhere, of which the vertices are the centre line.
    pub(super) has_width: bool,
    /// Whether its vertices differ in height.
    pub(super) climbs: bool,
}

impl Polyline {
    /// The same in a plane that is seen from below.
    pub(super) fn facing_down(mut self) -> Self {
        for (p, bulge) in &mut self.vertices {
            (p.x, *bulge) = (-p.x, -*bulge);
        }
        self
    }

    fn push(&mut self, budget: &mut VertexBudget) -> Result<(), ReadError> {
        budget.take(1)?;
        self.vertices.push((Point::origin(), 0.0));
        Ok(())
    }
}

/// Reads an LWPOLYLINE.
pub(super) fn read_lightweight(
    record: &mut Record<'_, '_>,
    budget: &mut VertexBudget,
) -> Result<ShapeOrWhy, ReadError> {
    let mut polyline = Polyline::default();
    while let Some(group) = record.next_group()? {
        if group.code == 10 {
            polyline.push(budget)?;
        }
        match (group.code, polyline.vertices.last_mut()) {
            (70, _) => polyline.closed = group.integer()? & 1 != 0,
            (10, Some((p, _))) => p.x = group.real()?,
            (20, Some((p, _))) => p.y = group.real()?,
            (42, Some((_, bulge))) => *bulge = group.real()?,
            (40 | 41 | 43, _) => polyline.has_width |= is_width(&group),
            _ => {}
        }
    }
    Ok(Ok(Shape::Polyline(polyline)))
}

/// Whether a group says a width that shows. What is no number may be one.
fn is_width(group: &Group<'_>) -> bool {
    group.real().unwrap_or(f64::NAN) != 0.0
}

// Group 70 of a POLYLINE.
const CLOSED: i64 = 1;
const SPLINE_FIT: i64 = 4;
const IN_SPACE: i64 = 8;
const MESHES: i64 = 16 | 64;

/// Group 70 of a VERTEX: a control point of the spline that the other vertices run along.
const FRAME: i64 = 16;

/// Reads a POLYLINE with its VERTEX records up to SEQEND. Of a polyline that was smoothed the vertices of the
/// smooth line are taken; a 3D polyline is taken as seen from above.
pub(super) fn read_polyline<'a>(
    mut record: Record<'_, 'a>,
    budget: &mut VertexBudget,
) -> Result<(Head<'a>, ShapeOrWhy), ReadError> {
    let (mut flags, mut has_width) = (0, false);
    while let Some(group) = record.next_group()? {
        match group.code {
            70 => flags = group.integer()?,
            40 | 41 => has_width |= is_width(&group),
            _ => {}
        }
    }
    let (closed, in_space) = (flags & CLOSED != 0, flags & IN_SPACE != 0);
    let mut polyline = Polyline { closed, in_space, has_width, ..Polyline::default() };
    let (mut frame_vertices, mut heights) = (0, Heights::default());
    let head = record.finish_with(|mut vertex| {
        if flags & MESHES != 0 {
            return vertex.finish().map(|_| ());
        }
        polyline.push(budget)?;
        let (mut vertex_flags, mut z) = (0, 0.0);
        while let Some(group) = vertex.next_group()? {
            let Some((p, bulge)) = polyline.vertices.last_mut() else { continue };
            match group.code {
                10 => p.x = group.real()?,
                20 => p.y = group.real()?,
                30 => z = height(&group),
                40 | 41 => polyline.has_width |= is_width(&group),
                42 if !polyline.in_space => *bulge = group.real()?,
                70 => vertex_flags = group.integer()?,
                _ => {}
            }
        }
        if flags & SPLINE_FIT != 0 && vertex_flags & FRAME != 0 {
            polyline.vertices.pop();
            frame_vertices += 1;
        } else {
            heights.note(z);
        }
        Ok(())
    })?;
    // A line in space has no width, whatever its groups say.
    polyline.has_width &= !polyline.in_space;
    polyline.climbs = heights.vary();
    let shape = if flags & MESHES != 0 {
        Err(WhyUnused::Body)
    } else if polyline.vertices.is_empty() && frame_vertices > 0 {
        Err(WhyUnused::Inconsistent)
    } else {
        Ok(Shape::Polyline(polyline))
    };
    Ok((head, shape))
}
