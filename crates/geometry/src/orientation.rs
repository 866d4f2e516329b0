//! Exact orientation of three points: the predicate that decides topology.
//!
//! Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates, 1997, as implemented by the `robust` crate. Cost: a few nanoseconds unless nearly collinear.

use crate::Point;
use robust::{Coord, orient2d};

/// On which side of a directed line a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Orientation {
    /// Left: the three points turn counter-clockwise.
    Left,
    /// Exactly on the line.
    Straight,
    /// Right: the three points turn clockwise.
    Right,
}

/// Where `c` lies as seen along the line from `a` to `b`. Exact for finite input.
#[must_use]
pub fn orientation(a: Point, b: Point, c: Point) -> Orientation {
    let value = orient2d(coord(a), coord(b), coord(c));
    if value > 0.0 {
        Orientation::Left
    } else if value < 0.0 {
        Orientation::Right
    } else {
        Orientation::Straight
    }
}

fn coord(p: Point) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}
