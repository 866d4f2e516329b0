//! A line of an element in its own coordinates, before all transforms.

use crate::fit::{CubicBezier, EllipticArc};
use traverse_geometry::Point;

/// A chain of pieces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    pub(super) start: Point,
    pub(super) pieces: Vec<Piece>,
    /// Whether a straight edge leads back to the start, if it is not there already.
    pub(super) closed: bool,
}

/// What leads from one point to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// Straight to there.
    Line(Point),
    /// Along a Bézier curve.
    Cubic(CubicBezier),
    /// Along an ellipse to a point that is on it.
    Arc(EllipticArc, Point),
}

impl Outline {
    pub(super) fn from(start: Point) -> Self {
        Self { start, pieces: Vec::new(), closed: false }
    }

    /// Straight through these points.
    pub(super) fn through(points: &[Point], closed: bool) -> Option<Self> {
        let (&start, rest) = points.split_first()?;
        Some(Self { start, pieces: rest.iter().copied().map(Piece::Line).collect(), closed })
    }
}

impl Piece {
    pub(super) fn end(&self) -> Point {
        match self {
            Self::Line(end) | Self::Arc(_, end) => *end,
            Self::Cubic(cubic) => cubic.points[3],
        }
    }
}
