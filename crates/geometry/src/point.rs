//! Points and vectors of the work plane, in millimetres, x to the right and y up.

/// A position in the work plane, millimetres.
pub type Point = nalgebra::Point2<f64>;

/// A displacement or direction in the work plane, millimetres.
pub type Vector = nalgebra::Vector2<f64>;

/// The vector turned a quarter turn counter-clockwise.
#[inline]
#[must_use]
pub fn left_of(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// The z component of the cross product: positive when `b` lies counter-clockwise of `a`.
#[inline]
#[must_use]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The unit vector at `angle` radians, counter-clockwise from the x axis.
#[inline]
#[must_use]
pub fn unit(angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    Vector::new(cos, sin)
}

/// An angle brought into `[0, 2π)`.
#[inline]
#[must_use]
pub fn positive_angle(angle: f64) -> f64 {
    let turned = angle.rem_euclid(std::f64::consts::TAU);
    // rem_euclid of a tiny negative angle rounds up to 2π itself.
    if turned >= std::f64::consts::TAU { 0.0 } else { turned }
}
