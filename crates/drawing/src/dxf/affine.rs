//! Where a block's coordinates come to lie: affine maps of the plane.

use traverse_geometry::{Point, Vector};

/// A map may be taken for a similarity when lengths differ by no more than this share.
const SIMILARITY_TOLERANCE: f64 = 1e-12;

/// An affine map of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    /// Where the vector (1, 0) goes.
    x_axis: Vector,
    /// Where the vector (0, 1) goes.
    y_axis: Vector,
    /// Where the origin goes.
    origin: Vector,
}

impl Affine {
    /// Stretches both axes about the origin.
    pub(super) fn scaling(x: f64, y: f64) -> Self {
        Self { x_axis: Vector::new(x, 0.0), y_axis: Vector::new(0.0, y), origin: Vector::zeros() }
    }

    /// Moves by a vector.
    pub(super) fn shift(by: Vector) -> Self {
        Self { origin: by, ..Self::scaling(1.0, 1.0) }
    }

    /// Turns about the origin, degrees counter-clockwise; exact for quarter turns.
    pub(super) fn rotation_deg(angle: f64) -> Self {
        let turned = angle.rem_euclid(360.0);
        let (sin, cos) = match turned {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            _ => turned.to_radians().sin_cos(),
        };
        Self { x_axis: Vector::new(cos, sin), y_axis: Vector::new(-sin, cos), origin: Vector::zeros() }
    }

    /// First `inner`, then this one.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self {
            x_axis: self.vector(inner.x_axis),
            y_axis: self.vector(inner.y_axis),
            origin: self.vector(inner.origin) + self.origin,
        }
    }

    /// Where a point goes.
    pub(super) fn point(&self, p: Point) -> Point {
        Point::from(self.vector(p.coords) + self.origin)
    }

    /// Where a vector goes.
    pub(super) fn vector(&self, v: Vector) -> Vector {
        // A part of 0 must not spoil the other one when a coordinate is not finite.
        let along = |axis: Vector, length: f64| {
            Vector::new(
                if axis.x == 0.0 { 0.0 } else { axis.x * length },
                if axis.y == 0.0 { 0.0 } else { axis.y * length },
            )
        };
        along(self.x_axis, v.x) + along(self.y_axis, v.y)
    }

    /// 1 when counter-clockwise stays so, −1 when it becomes clockwise: then bulges change sign.
    pub(super) fn handedness(&self) -> f64 {
        if self.x_axis.perp(&self.y_axis) < 0.0 { -1.0 } else { 1.0 }
    }

    /// Whether circles stay circles.
    pub(super) fn is_similarity(&self) -> bool {
        are_equal_and_square(self.x_axis, self.y_axis)
    }
}

/// Whether two half axes are those of a circle.
pub(super) fn are_equal_and_square(first: Vector, second: Vector) -> bool {
    let (a, b) = (first.norm_squared(), second.norm_squared());
    let allowed = SIMILARITY_TOLERANCE * a.max(b);
    (a - b).abs() <= allowed && first.dot(&second).abs() <= allowed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_follow_one_another() {
        let map = Affine::shift(Vector::new(5.0, -1.0))
            .after(&Affine::rotation_deg(-270.0))
            .after(&Affine::scaling(2.0, -3.0));
        // (1, 1) is stretched to (2, −3), turned to (3, 2) and moved.
        assert_eq!(map.point(Point::new(1.0, 1.0)), Point::new(8.0, 1.0));
        assert_eq!(map.handedness(), -1.0);
        assert!(!map.is_similarity());
        assert!(Affine::rotation_deg(33.3).after(&Affine::scaling(-7.1, 7.1)).is_similarity());
    }
}
