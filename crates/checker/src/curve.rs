//! Straight and circular curves with the checker's own arithmetic.
//!
//! A circular curve is kept by the direction to its middle and half its sweep: whether a direction belongs to it
//! is one comparison of angles, for any sweep up to a full turn. Geometry decides the same by cross products.

use std::f64::consts::PI;
use traverse_geometry::{Bounds, PathArc, Point, Vector};

/// The z component of the cross product.
pub(crate) fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The vector turned a quarter turn clockwise: to the right of the direction of travel.
pub(crate) fn right_of(v: Vector) -> Vector {
    Vector::new(v.y, -v.x)
}

/// The vector turned counter-clockwise.
fn turned(v: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    Vector::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// The vector at length 1; zero stays zero.
pub(crate) fn normalized(v: Vector) -> Vector {
    let length = v.norm();
    if length > 0.0 { v / length } else { Vector::zeros() }
}

/// A step of a path or an edge of an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Curve {
    Straight(Straight),
    Circular(Circular),
}

/// From `a` to `b`. May have length 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Straight {
    pub(crate) a: Point,
    pub(crate) b: Point,
}

/// From `a` to `b` round `center`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circular {
    pub(crate) center: Point,
    pub(crate) radius: f64,
    pub(crate) a: Point,
    pub(crate) b: Point,
    /// Unit vector from the centre to the middle.
    pub(crate) middle: Vector,
    /// Half the turned angle, in (0, π].
    pub(crate) half: f64,
    /// 1 counter-clockwise, −1 clockwise.
    pub(crate) turn: f64,
}

impl Straight {
    pub(crate) fn direction(&self) -> Vector {
        normalized(self.b - self.a)
    }

    pub(crate) fn length(&self) -> f64 {
        (self.b - self.a).norm()
    }
}

impl Circular {
    /// Angle from the middle to a direction, positive with the direction of travel, in [−π, π].
    pub(crate) fn angle_of(&self, direction: Vector) -> f64 {
        self.turn * cross(self.middle, direction).atan2(self.middle.dot(&direction))
    }

    /// Where along the curve the ray from the centre meets it.
    pub(crate) fn fraction_of(&self, direction: Vector) -> Option<f64> {
        let angle = self.angle_of(direction);
        (angle.abs() <= self.half).then(|| (angle / self.half + 1.0) / 2.0)
    }

    fn is_full_turn(&self) -> bool {
        self.half >= PI
    }
}

impl Curve {
    /// The straight curve from `a` to `b`.
    pub(crate) fn straight(a: Point, b: Point) -> Self {
        Self::Straight(Straight { a, b })
    }

    /// An edge of a ring: bulge is tan(sweep / 4).
    pub(crate) fn from_bulge(a: Point, b: Point, bulge: f64) -> Self {
        let chord = b - a;
        let width = chord.norm();
        if bulge == 0.0 || width == 0.0 {
            return Self::straight(a, b);
        }
        let half = 2.0 * bulge.abs().atan();
        let turn = bulge.signum();
        // The middle of a counter-clockwise arc lies right of its chord.
        let middle = right_of(chord) / width * turn;
        let radius = width / (2.0 * half.sin());
        let center = a + chord / 2.0 - middle * (width / (2.0 * half.tan()));
        Self::Circular(Circular { center, radius, a, b, middle, half, turn })
    }

    /// A circular step. The radius is the mean of both distances from the centre.
    pub(crate) fn from_center(a: Point, b: Point, arc: PathArc) -> Self {
        let (from, to) = (a - arc.center, b - arc.center);
        let radius = (from.norm() + to.norm()) / 2.0;
        let middle =
            normalized(turned(normalized(from), arc.sweep / 2.0) + turned(normalized(to), -arc.sweep / 2.0));
        let half = (arc.sweep.abs() / 2.0).min(PI);
        Self::Circular(Circular { center: arc.center, radius, a, b, middle, half, turn: arc.sweep.signum() })
    }

    pub(crate) fn start(&self) -> Point {
        match self {
            Self::Straight(straight) => straight.a,
            Self::Circular(circular) => circular.a,
        }
    }

    pub(crate) fn end(&self) -> Point {
        match self {
            Self::Straight(straight) => straight.b,
            Self::Circular(circular) => circular.b,
        }
    }

    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Straight(straight) => straight.length(),
            Self::Circular(circular) => 2.0 * circular.half * circular.radius,
        }
    }

    pub(crate) fn point_at(&self, fraction: f64) -> Point {
        if fraction <= 0.0 {
            return self.start();
        }
        if fraction >= 1.0 {
            return self.end();
        }
        match self {
            // From the nearer end: half the rounding.
            Self::Straight(Straight { a, b }) if fraction <= 0.5 => a + (b - a) * fraction,
            Self::Straight(Straight { a, b }) => b + (a - b) * (1.0 - fraction),
            Self::Circular(circular) => {
                let angle = circular.turn * circular.half * (2.0 * fraction - 1.0);
                circular.center + turned(circular.middle, angle) * circular.radius
            }
        }
    }

    /// Unit direction of travel; zero where there is none.
    pub(crate) fn direction_at(&self, fraction: f64) -> Vector {
        match self {
            Self::Straight(straight) => straight.direction(),
            Self::Circular(circular) => {
                let angle = circular.turn * circular.half * (2.0 * fraction - 1.0);
                right_of(turned(circular.middle, angle)) * -circular.turn
            }
        }
    }

    /// Where along the curve the point nearest to `p` lies.
    pub(crate) fn nearest_fraction(&self, p: Point) -> f64 {
        match self {
            Self::Straight(Straight { a, b }) => {
                let v = b - a;
                let square = v.norm_squared();
                if square > 0.0 { ((p - a).dot(&v) / square).clamp(0.0, 1.0) } else { 0.0 }
            }
            Self::Circular(circular) => {
                let direction = p - circular.center;
                if let Some(fraction) = circular.fraction_of(direction) {
                    fraction
                } else if (p - circular.a).norm_squared() <= (p - circular.b).norm_squared() {
                    0.0
                } else {
                    1.0
                }
            }
        }
    }

    /// Distance from `p` to the nearest point.
    pub(crate) fn distance_to_point(&self, p: Point) -> f64 {
        match self {
            Self::Straight(straight) => {
                let Straight { a, b } = *straight;
                let (from, to) = (p - a, p - b);
                let along = straight.direction();
                if along.dot(&from) <= 0.0 {
                    from.norm()
                } else if along.dot(&to) >= 0.0 {
                    to.norm()
                } else {
                    let nearer = if from.norm_squared() <= to.norm_squared() { from } else { to };
                    cross(along, nearer).abs()
                }
            }
            Self::Circular(circular) => {
                let direction = p - circular.center;
                if circular.is_full_turn() || circular.angle_of(direction).abs() <= circular.half {
                    (direction.norm() - circular.radius).abs()
                } else {
                    (p - circular.a).norm().min((p - circular.b).norm())
                }
            }
        }
    }

    /// A box that holds the curve, rounding included.
    pub(crate) fn bounds(&self) -> Bounds {
        let ends = Bounds::of([self.start(), self.end()]);
        match self {
            Self::Straight(_) => ends,
            Self::Circular(circular) => [Vector::x(), Vector::y(), -Vector::x(), -Vector::y()]
                .into_iter()
                .filter(|&direction| circular.fraction_of(direction).is_some())
                .fold(ends, |bounds, direction| bounds.with(circular.center + direction * circular.radius))
                .grown(circular.radius * 1e-15),
        }
    }
}
