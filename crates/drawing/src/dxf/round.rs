//! CIRCLE, ARC and ELLIPSE.

use super::entity::{Shape, ShapeOrWhy};
use super::record::Record;
use crate::{ReadError, WhyUnused};
use std::f64::consts::TAU;
use traverse_geometry::{Point, Vector, left_of, positive_angle};

/// An arc that lacks less than this to a full turn is a full circle, radians.
const FULL_CIRCLE: f64 = 1e-12;

/// The same for an ellipse, radians: its ends are often written with six decimals.
const FULL_ELLIPSE: f64 = 1e-6;

/// A circle, an ellipse or an arc of one: centre + first · cos θ + second · sin θ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    /// Centre.
    pub(super) center: Point,
    /// From the centre to the point of θ = 0.
    pub(super) first: Vector,
    /// From the centre to the point of θ = π/2.
    pub(super) second: Vector,
    /// θ where it begins, radians.
    pub(super) start: f64,
    /// θ where it ends, radians. Equal angles are a full turn.
    pub(super) end: f64,
    /// Whether it is an ELLIPSE: given in world coordinates whatever its extrusion.
    is_ellipse: bool,
}

impl Round {
    /// How far θ rises, radians; exactly 2π for a full turn.
    pub(super) fn sweep(&self) -> f64 {
        let missing = if self.is_ellipse { FULL_ELLIPSE } else { FULL_CIRCLE };
        let sweep = positive_angle(self.end - self.start);
        let full =
            sweep == 0.0 || TAU - sweep < missing || ((self.end - self.start).abs() - TAU).abs() < missing;
        if full { TAU } else { sweep }
    }

    /// The same in a plane that is seen from below.
    pub(super) fn facing_down(mut self) -> Self {
        if self.is_ellipse {
            // The normal tells the way round only.
            self.second = -self.second;
        } else {
            for x in [&mut self.center.x, &mut self.first.x, &mut self.second.x] {
                *x = -*x;
            }
        }
        self
    }
}

/// Reads a CIRCLE: centre and radius. A negative radius is [`WhyUnused::Inconsistent`].
pub(super) fn read_circle(record: &mut Record<'_, '_>) -> Result<ShapeOrWhy, ReadError> {
    let round = read_circular(record)?;
    Ok(round.map(|round| Shape::Round(Round { start: 0.0, end: 0.0, ..round })))
}

/// Reads an ARC: a CIRCLE with angles in degrees, counter-clockwise. Equal angles are a full circle.
pub(super) fn read_arc(record: &mut Record<'_, '_>) -> Result<ShapeOrWhy, ReadError> {
    Ok(read_circular(record)?.map(Shape::Round))
}

fn read_circular(record: &mut Record<'_, '_>) -> Result<Result<Round, WhyUnused>, ReadError> {
    let (mut center, mut radius, mut start, mut end) = (Point::origin(), 0.0, 0.0_f64, 0.0_f64);
    while let Some(group) = record.next_group()? {
        match group.code {
            10 => center.x = group.real()?,
            20 => center.y = group.real()?,
            40 => radius = group.real()?,
            50 => start = group.real()?,
            51 => end = group.real()?,
            _ => {}
        }
    }
    if radius < 0.0 {
        return Ok(Err(WhyUnused::Inconsistent));
    }
    Ok(Ok(Round {
        center,
        first: Vector::new(radius, 0.0),
        second: Vector::new(0.0, radius),
        start: start.to_radians(),
        end: end.to_radians(),
        is_ellipse: false,
    }))
}

/// Reads an ELLIPSE: centre, long half axis, the short one's share of it, and where θ begins and ends.
pub(super) fn read_ellipse(record: &mut Record<'_, '_>) -> Result<Shape, ReadError> {
    let (mut center, mut first) = (Point::origin(), Vector::zeros());
    let (mut ratio, mut start, mut end) = (1.0, 0.0, TAU);
    while let Some(group) = record.next_group()? {
        match group.code {
            10 => center.x = group.real()?,
            20 => center.y = group.real()?,
            11 => first.x = group.real()?,
            21 => first.y = group.real()?,
            40 => ratio = group.real()?,
            41 => start = group.real()?,
            42 => end = group.real()?,
            _ => {}
        }
    }
    let second = left_of(first) * ratio;
    Ok(Shape::Round(Round { center, first, second, start, end, is_ellipse: true }))
}
