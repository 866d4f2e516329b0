//! One entity of the `dxf` crate as a curve in millimetres.

use crate::curve::CurveBuilder;
use crate::{Curve, ReadError, WhyUnused};
use dxf::entities::{Entity, EntityType};
use std::f64::consts::TAU;
use traverse_geometry::{COORDINATE_LIMIT_MM, Point, RADIUS_LIMIT_MM, positive_angle, unit};

/// What became of an entity, with its type.
pub(super) enum Taken {
    Curve(&'static str, Curve),
    Unusable(&'static str, WhyUnused),
    OtherType,
}

/// Components of a unit normal below this are rounding.
const NORMAL_TOLERANCE: f64 = 1e-9;

/// Largest absolute value of an angle in a file, degrees.
const ANGLE_LIMIT_DEG: f64 = 1e6;

/// Largest absolute value of a bulge in a file: an arc that lacks 0.04 µrad to a full turn.
const BULGE_LIMIT: f64 = 1e8;

/// The entity as a curve, its lengths multiplied by `scale`.
pub(super) fn take_entity(entity: &Entity, scale: f64) -> Result<Taken, ReadError> {
    let (name, normal) = match &entity.specific {
        EntityType::Line(line) => ("LINE", &line.extrusion_direction),
        EntityType::Arc(arc) => ("ARC", &arc.normal),
        EntityType::Circle(circle) => ("CIRCLE", &circle.normal),
        EntityType::LwPolyline(polyline) => ("LWPOLYLINE", &polyline.extrusion_direction),
        _ => return Ok(Taken::OtherType),
    };
    if entity.common.is_in_paper_space {
        return Ok(Taken::Unusable(name, WhyUnused::PaperSpace));
    }
    // Ends of a LINE are in world coordinates whatever its extrusion.
    let upright = normal.x.abs() <= NORMAL_TOLERANCE && normal.y.abs() <= NORMAL_TOLERANCE && normal.z > 0.0;
    if !upright && name != "LINE" {
        return Ok(Taken::Unusable(name, WhyUnused::Extrusion));
    }
    let numbers = Numbers { entity: name, layer: &entity.common.layer, scale };
    let curve = match &entity.specific {
        EntityType::Line(line) => {
            let start = numbers.point(&line.p1.x, &line.p1.y)?;
            let end = numbers.point(&line.p2.x, &line.p2.y)?;
            CurveBuilder::from(start).edge(0.0, end).open()
        }
        EntityType::Arc(arc) => {
            let center = numbers.point(&arc.center.x, &arc.center.y)?;
            let radius = numbers.radius(arc.radius)?;
            let start = numbers.within("start angle", arc.start_angle, ANGLE_LIMIT_DEG)?.to_radians();
            let end = numbers.within("end angle", arc.end_angle, ANGLE_LIMIT_DEG)?.to_radians();
            arc_curve(center, radius, start, end)
        }
        EntityType::Circle(circle) => {
            let center = numbers.point(&circle.center.x, &circle.center.y)?;
            arc_curve(center, numbers.radius(circle.radius)?, 0.0, 0.0)
        }
        EntityType::LwPolyline(polyline) => {
            let mut vertices = Vec::with_capacity(polyline.vertices.len());
            for vertex in &polyline.vertices {
                let bulge = numbers.within("bulge", vertex.bulge, BULGE_LIMIT)?;
                vertices.push((numbers.point(&vertex.x, &vertex.y)?, bulge));
            }
            polyline_curve(&vertices, polyline.is_closed())
        }
        _ => return Ok(Taken::OtherType),
    };
    Ok(curve.map_or(Taken::Unusable(name, WhyUnused::NoLength), |curve| Taken::Curve(name, curve)))
}

/// Counter-clockwise from `start` to `end`, radians; equal angles are a full circle.
fn arc_curve(center: Point, radius: f64, start: f64, end: f64) -> Option<Curve> {
    if radius <= 0.0 {
        return None;
    }
    let at = |angle: f64| center + unit(angle) * radius;
    let sweep = positive_angle(end - start);
    if sweep == 0.0 || TAU - sweep < 1e-12 {
        // Opposite points to the last bit, so that both halves have one centre.
        let spoke = unit(start) * radius;
        return CurveBuilder::from(center + spoke)
            .edge(1.0, center - spoke)
            .edge(1.0, center + spoke)
            .closed();
    }
    CurveBuilder::from(at(start)).edge((sweep / 4.0).tan(), at(start + sweep)).open()
}

fn polyline_curve(vertices: &[(Point, f64)], closed: bool) -> Option<Curve> {
    let (&(first, _), rest) = vertices.split_first()?;
    let mut builder = CurveBuilder::from(first);
    for (&(_, bulge), &(end, _)) in vertices.iter().zip(rest) {
        builder = builder.edge(bulge, end);
    }
    if closed { builder.edge(vertices.last()?.1, first).closed() } else { builder.open() }
}

/// Takes the numbers of an entity, refusing those out of range.
struct Numbers<'a> {
    entity: &'static str,
    layer: &'a str,
    scale: f64,
}

impl Numbers<'_> {
    fn point(&self, x: &f64, y: &f64) -> Result<Point, ReadError> {
        let limit = COORDINATE_LIMIT_MM;
        Ok(Point::new(self.within("x", x * self.scale, limit)?, self.within("y", y * self.scale, limit)?))
    }

    fn radius(&self, radius: f64) -> Result<f64, ReadError> {
        self.within("radius", radius * self.scale, RADIUS_LIMIT_MM)
    }

    fn within(&self, field: &'static str, value: f64, limit: f64) -> Result<f64, ReadError> {
        if value.abs() <= limit {
            return Ok(value);
        }
        let layer = self.layer.to_owned();
        Err(ReadError::NumberOutOfRange { entity: self.entity, layer, field, value, limit })
    }
}
