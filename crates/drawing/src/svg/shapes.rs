//! The elements that draw, each as outlines in its own coordinates.

use super::element::{Element, LengthContext};
use super::outline::{Outline, Piece};
use super::path_data::outlines_of_path;
use crate::ReadError;
use crate::fit::EllipticArc;
use std::f64::consts::{FRAC_PI_2, TAU};
use svgtypes::NumberListParser;
use traverse_geometry::{Point, Vector};

/// Elements that are read.
pub(super) const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// The outlines of one of [`SHAPES`]; nothing when it draws nothing.
pub(super) fn outlines(element: &Element<'_>, context: &LengthContext) -> Result<Vec<Outline>, ReadError> {
    let length = |name| element.length(name, context);
    let outline = match element.tag() {
        "path" => {
            let data = element.attribute("d").unwrap_or_default();
            return outlines_of_path(data).map_err(|error| element.bad("d", data, error));
        }
        "rect" => rectangle(element, context)?,
        "circle" => ellipse(length("cx")?, length("cy")?, length("r")?, length("r")?),
        "ellipse" => {
            let (rx, ry) = radii(element, context)?;
            ellipse(length("cx")?, length("cy")?, rx, ry)
        }
        "line" => {
            let ends = [Point::new(length("x1")?, length("y1")?), Point::new(length("x2")?, length("y2")?)];
            Outline::through(&ends, false)
        }
        "polyline" => Outline::through(&points(element)?, false),
        "polygon" => Outline::through(&points(element)?, true),
        _ => None,
    };
    Ok(outline.into_iter().collect())
}

/// Both radii; one that is not given is as large as the other.
fn radii(element: &Element<'_>, context: &LengthContext) -> Result<(f64, f64), ReadError> {
    let (rx, ry) = (element.length_if_any("rx", context)?, element.length_if_any("ry", context)?);
    Ok((rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)))
}

fn ellipse(cx: f64, cy: f64, rx: f64, ry: f64) -> Option<Outline> {
    let center = Point::new(cx, cy);
    let first = Vector::new(rx, 0.0);
    let arc = EllipticArc { center, first, second: Vector::new(0.0, ry), start: 0.0, sweep: TAU };
    let start = center + first;
    (rx > 0.0 && ry > 0.0).then(|| Outline { start, pieces: vec![Piece::Arc(arc, start)], closed: true })
}

fn rectangle(element: &Element<'_>, context: &LengthContext) -> Result<Option<Outline>, ReadError> {
    let (x, y) = (element.length("x", context)?, element.length("y", context)?);
    let (width, height) = (element.length("width", context)?, element.length("height", context)?);
    if width <= 0.0 || height <= 0.0 {
        return Ok(None);
    }
    let (rx, ry) = radii(element, context)?;
    let (rx, ry) = (rx.clamp(0.0, width / 2.0), ry.clamp(0.0, height / 2.0));
    let (right, bottom) = (x + width, y + height);
    if rx == 0.0 || ry == 0.0 {
        let corners =
            [Point::new(x, y), Point::new(right, y), Point::new(right, bottom), Point::new(x, bottom)];
        return Ok(Outline::through(&corners, true));
    }
    let mut outline = Outline::from(Point::new(x + rx, y));
    let (first, second) = (Vector::new(rx, 0.0), Vector::new(0.0, ry));
    for (line_end, center, start, arc_end) in [
        ((right - rx, y), (right - rx, y + ry), -FRAC_PI_2, (right, y + ry)),
        ((right, bottom - ry), (right - rx, bottom - ry), 0.0, (right - rx, bottom)),
        ((x + rx, bottom), (x + rx, bottom - ry), FRAC_PI_2, (x, bottom - ry)),
        ((x, y + ry), (x + rx, y + ry), 2.0 * FRAC_PI_2, (x + rx, y)),
    ] {
        let center = Point::new(center.0, center.1);
        let arc = EllipticArc { center, first, second, start, sweep: FRAC_PI_2 };
        outline.pieces.push(Piece::Line(Point::new(line_end.0, line_end.1)));
        outline.pieces.push(Piece::Arc(arc, Point::new(arc_end.0, arc_end.1)));
    }
    outline.closed = true;
    Ok(Some(outline))
}

fn points(element: &Element<'_>) -> Result<Vec<Point>, ReadError> {
    let text = element.attribute("points").unwrap_or_default();
    let numbers: Result<Vec<f64>, _> = NumberListParser::from(text).collect();
    let numbers = numbers.map_err(|error| element.bad("points", text, error))?;
    if numbers.len() % 2 == 1 {
        return Err(element.bad("points", text, "a y is missing"));
    }
    Ok(numbers.chunks_exact(2).map(|pair| Point::new(pair[0], pair[1])).collect())
}
