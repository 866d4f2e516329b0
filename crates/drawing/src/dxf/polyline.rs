//! LWPOLYLINE and POLYLINE.

use super::budget::VertexBudget;
use super::entity::{Shape, ShapeOrWhy};
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
            _ => {}
        }
    }
    Ok(Ok(Shape::Polyline(polyline)))
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
    let mut flags = 0;
    while let Some(group) = record.next_group()? {
        if group.code == 70 {
            flags = group.integer()?;
        }
    }
    let mut polyline =
        Polyline { closed: flags & CLOSED != 0, in_space: flags & IN_SPACE != 0, ..Polyline::default() };
    let mut frame_vertices = 0;
    let head = record.finish_with(|mut vertex| {
        if flags & MESHES != 0 {
            return vertex.finish().map(|_| ());
        }
        polyline.push(budget)?;
        let mut vertex_flags = 0;
        while let Some(group) = vertex.next_group()? {
            let Some((p, bulge)) = polyline.vertices.last_mut() else { continue };
            match group.code {
                10 => p.x = group.real()?,
                20 => p.y = group.real()?,
                42 if !polyline.in_space => *bulge = group.real()?,
                70 => vertex_flags = group.integer()?,
                _ => {}
            }
        }
        if flags & SPLINE_FIT != 0 && vertex_flags & FRAME != 0 {
            polyline.vertices.pop();
            frame_vertices += 1;
        }
        Ok(())
    })?;
    let shape = if flags & MESHES != 0 {
        Err(WhyUnused::Body)
    } else if polyline.vertices.is_empty() && frame_vertices > 0 {
        Err(WhyUnused::Inconsistent)
    } else {
        Ok(Shape::Polyline(polyline))
    };
    Ok((head, shape))
}
