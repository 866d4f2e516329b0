//! A shape of a file as a curve in millimetres.

use super::affine::{Affine, are_equal_and_square};
use super::budget::VertexBudget;
use super::chain::Chain;
use super::entity::{Line, Shape};
use super::nurbs::pieces;
use super::polyline::Polyline;
use super::round::Round;
use super::spline::Spline;
use crate::fit::{EllipticArc, Smooth};
use crate::{Curve, ReadError};
use std::f64::consts::{FRAC_PI_2, TAU};
use traverse_geometry::{CONTACT_TOLERANCE_MM, COORDINATE_LIMIT_MM, Point, RADIUS_LIMIT_MM, Vector};

/// Largest absolute value of an angle in a file, degrees.
const ANGLE_LIMIT_DEG: f64 = 1e6;

/// Largest absolute value of a bulge in a file: an arc that lacks 0.04 µrad to a full turn.
const BULGE_LIMIT: f64 = 1e8;

/// Makes curves of shapes that come to lie at one place.
pub(super) struct Outline<'a> {
    /// From the coordinates of the shape to the drawing, millimetres.
    pub(super) map: &'a Affine,
    /// Type of the entity.
    pub(super) entity: &'static str,
    /// Line that says its type, counted from 1; 0 in a binary file.
    pub(super) line: usize,
    /// Name of its layer.
    pub(super) layer: &'a str,
    /// How far arcs may run from ellipses and splines, millimetres.
    pub(super) tolerance_mm: f64,
    /// Vertices that may still be made.
    pub(super) budget: &'a mut VertexBudget,
}

impl Outline<'_> {
    /// The shape as a curve; none when it has no length.
    ///
    /// Where circles stay circles, arcs are arcs with the vertices that were drawn. Where they become ellipses, and for
    /// ellipses and splines, arcs and segments are fitted to each quarter turn and to each stretch between knots.
    pub(super) fn curve(&mut self, shape: &Shape) -> Result<Option<Curve>, ReadError> {
        match shape {
            Shape::Line(Line { ends: [start, end], .. }) => {
                let (start, end) = (self.point(*start)?, self.point(*end)?);
                self.chain(start).edge(0.0, end)?.open()
            }
            Shape::Round(round) => self.round(round),
            Shape::Polyline(polyline) => self.polyline(polyline),
            Shape::Spline(spline) => self.spline(spline),
        }
    }

    fn round(&mut self, round: &Round) -> Result<Option<Curve>, ReadError> {
        let center = self.point(round.center)?;
        let (first, second) = (self.half_axis(round.first)?, self.half_axis(round.second)?);
        let start = self.within("start angle", round.start.to_degrees(), ANGLE_LIMIT_DEG)?.to_radians();
        self.within("end angle", round.end.to_degrees(), ANGLE_LIMIT_DEG)?;
        if first == Vector::zeros() || second == Vector::zeros() {
            return Ok(None);
        }
        let arc = EllipticArc { center, first, second, start, sweep: round.sweep() };
        let full = arc.sweep == TAU;
        let from = arc.point(0.0);
        if are_equal_and_square(first, second) {
            let turn = if first.perp(&second) < 0.0 { -1.0 } else { 1.0 };
            if full {
                // Opposite points to the last bit, so that both halves have one centre.
                let spoke = from - center;
                let half = self.chain(center + spoke).edge(turn, center - spoke)?;
                return half.edge(turn, center + spoke)?.closed();
            }
            let bulge = turn * (arc.sweep / 4.0).tan();
            return self.chain(from).edge(bulge, arc.point(1.0))?.open();
        }
        let mut chain = self.chain(from);
        let count = (arc.sweep / FRAC_PI_2 - 1e-9).ceil().max(1.0);
        for i in 0..count as u32 {
            let step = arc.sweep / count;
            let piece = EllipticArc { start: start + step * f64::from(i), sweep: step, ..arc };
            let closes = full && f64::from(i) + 1.0 == count;
            chain = chain.smooth(&piece, if closes { from } else { piece.point(1.0) })?;
        }
        if full { chain.closed() } else { chain.open() }
    }

    fn polyline(&mut self, polyline: &Polyline) -> Result<Option<Curve>, ReadError> {
        let (map, turn) = (*self.map, self.map.handedness());
        let keeps_circles = map.is_similarity();
        for &(p, bulge) in &polyline.vertices {
            self.point(p)?;
            self.within("bulge", bulge, BULGE_LIMIT)?;
        }
        let Some(&(first, _)) = polyline.vertices.first() else { return Ok(None) };
        let last = polyline.closed.then_some(&polyline.vertices[0]);
        let mut chain = self.chain(map.point(first));
        let ends = polyline.vertices.iter().skip(1).chain(last);
        for (&(start, bulge), &(end, _)) in polyline.vertices.iter().zip(ends) {
            if keeps_circles || bulge == 0.0 {
                chain = chain.edge(turn * bulge, map.point(end))?;
            } else {
                chain = chain.mapped_arc(start, end, bulge, &map)?;
            }
        }
        if polyline.closed { chain.closed() } else { chain.open() }
    }

    fn spline(&mut self, spline: &Spline) -> Result<Option<Curve>, ReadError> {
        let points = spline.points.iter().map(|&p| self.point(p)).collect::<Result<Vec<_>, _>>()?;
        let spline = Spline { points, ..spline.clone() };
        let (Some(first), Some(last)) = (pieces(&spline).next(), pieces(&spline).last()) else {
            return Ok(None);
        };
        let (start, end) = (first.point(0.0), last.point(1.0));
        let gap = (end - start).norm();
        let closes = gap == 0.0 || spline.closed && gap <= CONTACT_TOLERANCE_MM;
        let mut chain = self.chain(start);
        let mut pieces = pieces(&spline).peekable();
        while let Some(piece) = pieces.next() {
            let is_last = pieces.peek().is_none();
            let end = if is_last && closes { start } else { piece.point(1.0) };
            chain = match piece.as_cubic() {
                Some(cubic) => chain.smooth(&cubic, end)?,
                None => chain.smooth(&piece, end)?,
            };
        }
        if closes { chain.closed() } else { chain.open() }
    }

    fn chain(&mut self, start: Point) -> Chain<'_> {
        Chain::from(start, self.tolerance_mm, self.budget)
    }

    fn point(&self, p: Point) -> Result<Point, ReadError> {
        let mapped = self.map.point(p);
        self.within("x", mapped.x, COORDINATE_LIMIT_MM)?;
        self.within("y", mapped.y, COORDINATE_LIMIT_MM)?;
        Ok(mapped)
    }

    fn half_axis(&self, v: Vector) -> Result<Vector, ReadError> {
        let mapped = self.map.vector(v);
        self.within("radius", mapped.norm(), RADIUS_LIMIT_MM)?;
        Ok(mapped)
    }

    fn within(&self, field: &'static str, value: f64, limit: f64) -> Result<f64, ReadError> {
        if value.abs() <= limit {
            return Ok(value);
        }
        let layer = self.layer.to_owned();
        let (line, entity) = (self.line, self.entity);
        Err(ReadError::NumberOutOfRange { line, entity, layer, field, value, limit })
    }
}
