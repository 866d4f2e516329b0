//! Affine maps of the plane.

use svgtypes::{TransformListParser, TransformListToken};
use traverse_geometry::{Point, Vector};

/// An affine map: p ↦ origin + x · p.x + y · p.y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) x: Vector,
    pub(super) y: Vector,
    pub(super) origin: Point,
}

impl Affine {
    pub(super) const fn new(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64) -> Self {
        Self { x: Vector::new(a, b), y: Vector::new(c, d), origin: Point::new(e, f) }
    }

    pub(super) const fn translation(x: f64, y: f64) -> Self {
        Self::new(1.0, 0.0, 0.0, 1.0, x, y)
    }

    pub(super) const fn scaling(x: f64, y: f64) -> Self {
        Self::new(x, 0.0, 0.0, y, 0.0, 0.0)
    }

    /// The image of a displacement.
    pub(super) fn vector(&self, v: Vector) -> Vector {
        self.x * v.x + self.y * v.y
    }

    /// The image of a point.
    pub(super) fn point(&self, p: Point) -> Point {
        self.origin + self.vector(p.coords)
    }

    /// First `inner`, then this map.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self { x: self.vector(inner.x), y: self.vector(inner.y), origin: self.point(inner.origin) }
    }

    /// The map of a `transform` attribute.
    pub(super) fn parse(text: &str) -> Result<Self, svgtypes::Error> {
        let mut map = Self::translation(0.0, 0.0);
        for token in TransformListParser::from(text) {
            let step = match token? {
                TransformListToken::Matrix { a, b, c, d, e, f } => Self::new(a, b, c, d, e, f),
                TransformListToken::Translate { tx, ty } => Self::translation(tx, ty),
                TransformListToken::Scale { sx, sy } => Self::scaling(sx, sy),
                TransformListToken::Rotate { angle } => {
                    let (sin, cos) = exact_sin_cos(angle);
                    Self::new(cos, sin, -sin, cos, 0.0, 0.0)
                }
                TransformListToken::SkewX { angle } => {
                    Self::new(1.0, 0.0, angle.to_radians().tan(), 1.0, 0.0, 0.0)
                }
                TransformListToken::SkewY { angle } => {
                    Self::new(1.0, angle.to_radians().tan(), 0.0, 1.0, 0.0, 0.0)
                }
            };
            map = map.after(&step);
        }
        Ok(map)
    }
}

/// Sine and cosine of an angle in degrees, exact for quarter turns.
pub(super) fn exact_sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}
