//! An edge of a ring, chain or path: straight or circular.

use crate::{Arc, Bounds, Point, Segment, Vector};

/// A straight or circular edge, directed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edge {
    /// Straight.
    Segment(Segment),
    /// Circular.
    Arc(Arc),
}

impl Edge {
    /// The edge from `start` to `end` with the given bulge: 0 is straight.
    #[must_use]
    pub fn from_bulge(start: Point, end: Point, bulge: f64) -> Self {
        if bulge == 0.0 || start == end {
            Self::Segment(Segment::new(start, end))
        } else {
            Self::Arc(Arc::from_bulge(start, end, bulge))
        }
    }

    /// Where it begins.
    #[must_use]
    pub fn start(&self) -> Point {
        match self {
            Self::Segment(segment) => segment.start,
            Self::Arc(arc) => arc.start,
        }
    }

    /// Where it ends.
    #[must_use]
    pub fn end(&self) -> Point {
        match self {
            Self::Segment(segment) => segment.end,
            Self::Arc(arc) => arc.end,
        }
    }

    /// Millimetres.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Segment(segment) => segment.length(),
            Self::Arc(arc) => arc.length(),
        }
    }

    /// The point at `fraction` of the way, 0 at the start, 1 at the end.
    #[must_use]
    pub fn point_at(&self, fraction: f64) -> Point {
        match self {
            Self::Segment(segment) => segment.point_at(fraction),
            Self::Arc(arc) => arc.point_at(fraction),
        }
    }

    /// Unit direction of travel at `fraction` of the way; zero for an edge of length 0.
    #[must_use]
    pub fn direction_at(&self, fraction: f64) -> Vector {
        match self {
            Self::Segment(segment) => segment.vector().try_normalize(0.0).unwrap_or_default(),
            Self::Arc(arc) => arc.direction_at(fraction),
        }
    }

    /// The point of the edge nearest to `p`.
    #[must_use]
    pub fn nearest_point(&self, p: Point) -> Point {
        match self {
            Self::Segment(segment) => segment.nearest_point(p),
            Self::Arc(arc) => arc.nearest_point(p),
        }
    }

    /// Distance from `p` to the nearest point of the edge.
    #[must_use]
    pub fn distance_to_point(&self, p: Point) -> f64 {
        match self {
            Self::Segment(segment) => segment.distance_to_point(p),
            Self::Arc(arc) => arc.distance_to_point(p),
        }
    }

    /// The same way, run from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match self {
            Self::Segment(segment) => Self::Segment(Segment::new(segment.end, segment.start)),
            Self::Arc(arc) => Self::Arc(arc.reversed()),
        }
    }

    /// Bounding box.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Segment(segment) => segment.bounds(),
            Self::Arc(arc) => arc.bounds(),
        }
    }
}
