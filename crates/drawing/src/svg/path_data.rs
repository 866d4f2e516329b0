//! The `d` attribute of a path.

use super::arc_command::ArcCommand;
use super::outline::{Outline, Piece};
use crate::fit::CubicBezier;
use svgtypes::{PathParser, PathSegment};
use traverse_geometry::{Point, Vector};

/// The subpaths of path data.
pub(super) fn outlines_of_path(data: &str) -> Result<Vec<Outline>, svgtypes::Error> {
    let mut pen = Pen::default();
    if data.trim() != "none" {
        for segment in PathParser::from(data) {
            pen.draw(segment?);
        }
    }
    pen.lift();
    Ok(pen.done)
}

/// Where drawing has come to.
#[derive(Default)]
struct Pen {
    at: Point,
    open: Option<Outline>,
    done: Vec<Outline>,
    /// The last control point, for a curve that goes on smoothly: of a cubic or of a quadratic curve.
    cubic_control: Option<Point>,
    quadratic_control: Option<Point>,
}

impl Pen {
    fn draw(&mut self, segment: PathSegment) {
        let (cubic_control, quadratic_control) = (self.cubic_control.take(), self.quadratic_control.take());
        let at = self.at;
        let from = if segment.is_abs() { Vector::zeros() } else { at.coords };
        let place = |x: f64, y: f64| Point::new(x, y) + from;
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                self.lift();
                self.at = place(x, y);
                self.open = Some(Outline::from(self.at));
            }
            PathSegment::LineTo { x, y, .. } => self.add(Piece::Line(place(x, y))),
            PathSegment::HorizontalLineTo { x, .. } => self.add(Piece::Line(Point::new(x + from.x, at.y))),
            PathSegment::VerticalLineTo { y, .. } => self.add(Piece::Line(Point::new(at.x, y + from.y))),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                self.cubic(place(x1, y1), place(x2, y2), place(x, y));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = cubic_control.map_or(at, |control| at + (at - control));
                self.cubic(first, place(x2, y2), place(x, y));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => self.quadratic(place(x1, y1), place(x, y)),
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let control = quadratic_control.map_or(at, |control| at + (at - control));
                self.quadratic(control, place(x, y));
            }
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                let command =
                    ArcCommand { radii: (rx, ry), rotation_deg: x_axis_rotation, large: large_arc, sweep };
                if let Some(piece) = command.piece(at, place(x, y)) {
                    self.add(piece);
                }
            }
            PathSegment::ClosePath { .. } => {
                if let Some(mut outline) = self.open.take() {
                    self.at = outline.start;
                    outline.closed = true;
                    self.done.push(outline);
                }
            }
        }
    }

    fn cubic(&mut self, first: Point, second: Point, end: Point) {
        self.add(Piece::Cubic(CubicBezier::new(self.at, first, second, end)));
        self.cubic_control = Some(second);
    }

    fn quadratic(&mut self, control: Point, end: Point) {
        self.add(Piece::Cubic(CubicBezier::from_quadratic(self.at, control, end)));
        self.quadratic_control = Some(control);
    }

    fn add(&mut self, piece: Piece) {
        let at = self.at;
        self.at = piece.end();
        self.open.get_or_insert_with(|| Outline::from(at)).pieces.push(piece);
    }

    /// Ends a subpath that is left open.
    fn lift(&mut self) {
        self.done.extend(self.open.take());
    }
}
