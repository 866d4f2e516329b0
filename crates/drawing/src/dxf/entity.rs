//! One entity of a file as it is kept until it is drawn out.

use super::blocks::Blocks;
use super::budget::VertexBudget;
use super::hatch::{Hatch, read_hatch};
use super::heights::{Heights, height};
use super::insert::{Insert, read_insert};
use super::layers::LayerId;
use super::polyline::{Polyline, read_lightweight, read_polyline};
use super::record::{ColorRule, Facing, Head, Record};
use super::round::{Round, read_arc, read_circle, read_ellipse};
use super::spline::{Spline, read_spline};
use super::text::TextCoding;
use super::types::why_not_read;
use crate::{ReadError, WhyUnused};
use std::num::NonZeroU64;
use std::rc::Rc;
use traverse_geometry::Point;

/// An entity and what it says of itself.
#[derive(Debug)]
pub(super) struct Entity {
    /// Its own layer.
    pub(super) layer: LayerId,
    /// Its own colour.
    pub(super) color: ColorRule,
    /// Line that says its type, counted from 1; 0 in a binary file.
    pub(super) line: usize,
    /// Its handle.
    pub(super) handle: Option<NonZeroU64>,
    /// What it is.
    pub(super) kind: Kind,
}

/// What an entity is.
#[derive(Debug)]
pub(super) enum Kind {
    /// A shape, with its type.
    Shape(&'static str, Shape),
    /// A block drawn here.
    Insert(Box<Insert>),
    /// A filling; settled when all of its surroundings are read.
    Hatch(Box<Hatch>),
    /// Something that is not used, by its type.
    Unused(Rc<str>, WhyUnused),
}

/// A shape in the coordinates of its block and the unit of the file.
#[derive(Debug)]
pub(super) enum Shape {
    /// A segment.
    Line(Line),
    /// A circle, an ellipse or an arc of one.
    Round(Round),
    /// Segments and arcs end to end.
    Polyline(Polyline),
    /// A spline.
    Spline(Box<Spline>),
}

/// A segment.
#[derive(Debug)]
pub(super) struct Line {
    /// From where to where.
    pub(super) ends: [Point; 2],
    /// Whether one end is higher.
    pub(super) climbs: bool,
}

impl Shape {
    /// What of it the curve does not show.
    pub(super) fn not_shown(&self) -> Option<WhyUnused> {
        let (has_width, climbs) = match self {
            Self::Line(line) => (false, line.climbs),
            Self::Round(_) => (false, false),
            Self::Polyline(polyline) => (polyline.has_width, polyline.climbs),
            Self::Spline(spline) => (false, spline.climbs),
        };
        // A band that climbs is a band first.
        if has_width { Some(WhyUnused::Width) } else { climbs.then_some(WhyUnused::Height) }
    }

    /// How many vertices it comes to at least.
    pub(super) fn vertex_count(&self) -> usize {
        match self {
            Self::Line(_) | Self::Round(_) => 2,
            Self::Polyline(polyline) => polyline.vertices.len(),
            Self::Spline(spline) => spline.points.len(),
        }
    }
}

/// An entity that was read, its layer still by name.
pub(super) struct Read<'a> {
    /// What it says of itself.
    pub(super) head: Head<'a>,
    /// What it is.
    pub(super) kind: Kind,
}

/// What a shape's own groups say; why it is not used otherwise.
pub(super) type ShapeOrWhy = Result<Shape, WhyUnused>;

/// Reads the rest of an entity of that type. Its vertices are taken from the budget.
pub(super) fn read_entity<'a>(
    name: &str,
    mut record: Record<'_, 'a>,
    blocks: &mut Blocks,
    coding: TextCoding,
    budget: &mut VertexBudget,
) -> Result<Read<'a>, ReadError> {
    let (name, shape) = match name {
        "LINE" => ("LINE", Ok(read_line(&mut record)?)),
        "ARC" => ("ARC", read_arc(&mut record)?),
        "CIRCLE" => ("CIRCLE", read_circle(&mut record)?),
        "ELLIPSE" => ("ELLIPSE", Ok(read_ellipse(&mut record)?)),
        "LWPOLYLINE" => ("LWPOLYLINE", read_lightweight(&mut record, budget)?),
        "SPLINE" => ("SPLINE", read_spline(&mut record, budget)?),
        "POLYLINE" => {
            // Its vertices are records of their own.
            let (head, shape) = read_polyline(record, budget)?;
            return Ok(Read { kind: settled("POLYLINE", shape, &head), head });
        }
        "INSERT" => {
            let insert = read_insert(&mut record, blocks, coding)?;
            let head = record.finish()?;
            let kind = match (head.paper_space, head.facing(), insert) {
                (true, ..) => Kind::Unused("INSERT".into(), WhyUnused::PaperSpace),
                (_, Facing::Aside, _) => Kind::Unused("INSERT".into(), WhyUnused::Extrusion),
                (_, facing, Ok(insert)) => Kind::Insert(Box::new(insert.facing(facing))),
                (.., Err(why)) => Kind::Unused("INSERT".into(), why),
            };
            return Ok(Read { head, kind });
        }
        "HATCH" => {
            let hatch = read_hatch(&mut record)?;
            let head = record.finish()?;
            let kind = if head.paper_space {
                Kind::Unused("HATCH".into(), WhyUnused::PaperSpace)
            } else {
                Kind::Hatch(Box::new(hatch))
            };
            return Ok(Read { head, kind });
        }
        _ => {
            let head = record.finish()?;
            let why = if head.paper_space { WhyUnused::PaperSpace } else { why_not_read(name) };
            return Ok(Read { head, kind: Kind::Unused(name.into(), why) });
        }
    };
    let head = record.finish()?;
    Ok(Read { kind: settled(name, shape, &head), head })
}

/// A shape as it lies in the plane.
fn settled(name: &'static str, shape: ShapeOrWhy, head: &Head<'_>) -> Kind {
    if head.paper_space {
        return Kind::Unused(name.into(), WhyUnused::PaperSpace);
    }
    let shape = match shape {
        Ok(shape) => shape,
        Err(why) => return Kind::Unused(name.into(), why),
    };
    match (shape, head.facing()) {
        // These are in world coordinates whatever their extrusion.
        (shape @ (Shape::Line(_) | Shape::Spline(_)), _) | (shape, Facing::Up) => Kind::Shape(name, shape),
        (Shape::Polyline(polyline), _) if polyline.in_space => Kind::Shape(name, Shape::Polyline(polyline)),
        (_, Facing::Aside) => Kind::Unused(name.into(), WhyUnused::Extrusion),
        (Shape::Round(round), Facing::Down) => Kind::Shape(name, Shape::Round(round.facing_down())),
        (Shape::Polyline(polyline), Facing::Down) => {
            Kind::Shape(name, Shape::Polyline(polyline.facing_down()))
        }
    }
}

fn read_line(record: &mut Record<'_, '_>) -> Result<Shape, ReadError> {
    let (mut ends, mut z) = ([Point::origin(); 2], [0.0; 2]);
    while let Some(group) = record.next_group()? {
        match group.code {
            10 => ends[0].x = group.real()?,
            20 => ends[0].y = group.real()?,
            11 => ends[1].x = group.real()?,
            21 => ends[1].y = group.real()?,
            30 => z[0] = height(&group),
            31 => z[1] = height(&group),
            _ => {}
        }
    }
    let mut heights = Heights::default();
    z.into_iter().for_each(|z| heights.note(z));
    Ok(Shape::Line(Line { ends, climbs: heights.vary() }))
}
