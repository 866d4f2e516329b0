//! A straight edge.

use crate::{Bounds, Orientation, Point, Vector, orientation};

/// A straight edge from `start` to `end`. May have length 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
}

impl Segment {
    /// The edge from `start` to `end`.
    #[must_use]
    pub fn new(start: Point, end: Point) -> Self {
        Self { start, end }
    }

    /// Start to end.
    #[must_use]
    pub fn vector(&self) -> Vector {
        self.end - self.start
    }

    /// Millimetres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.vector().norm()
    }

    /// The point at `fraction` of the way: exactly the start up to 0, exactly the end from 1 on.
    #[must_use]
    pub fn point_at(&self, fraction: f64) -> Point {
        if fraction <= 0.0 {
            self.start
        } else if fraction >= 1.0 {
            self.end
        } else {
            self.start + self.vector() * fraction
        }
    }

    /// The point of the edge nearest to `p`.
    #[must_use]
    pub fn nearest_point(&self, p: Point) -> Point {
        let v = self.vector();
        let square = v.norm_squared();
        if square == 0.0 {
            return self.start;
        }
        let fraction = (p - self.start).dot(&v) / square;
        if fraction <= 0.0 {
            self.start
        } else if fraction >= 1.0 {
            self.end
        } else {
            self.start + v * fraction
        }
    }

    /// Distance from `p` to the nearest point of the edge.
    #[must_use]
    pub fn distance_to_point(&self, p: Point) -> f64 {
        (p - self.nearest_point(p)).norm()
    }

    /// Whether the closed edges share a point. Exact.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        use Orientation::Straight;
        if !self.bounds().meets(&other.bounds()) {
            return false;
        }
        let other_start = orientation(self.start, self.end, other.start);
        let other_end = orientation(self.start, self.end, other.end);
        if other_start == other_end && other_start != Straight {
            return false;
        }
        let start = orientation(other.start, other.end, self.start);
        let end = orientation(other.start, other.end, self.end);
        if start == end && start != Straight {
            return false;
        }
        // Either they cross or touch, or all four points are collinear and the boxes decide.
        true
    }

    /// Bounding box.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::of([self.start, self.end])
    }
}
