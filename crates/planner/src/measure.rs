//! How a search measures the way: by length, or by a norm of the plane.
//!
//! **Tangents stay exact for every norm.** Take any path, and the shortest one by length that can be pulled tight from it
//! without crossing an obstacle. Pulling tight replaces parts by straight ones, again and again, and by the triangle
//! inequality no norm gets longer by that. So among the paths that length can't shorten, those that the search looks at,
//! there is one that is the shortest by the norm. Where a lane is settled, what an estimate is and which tangents are left
//! out stays as it is too: labels are compared in the same place, the norm of what is missing is a bound, and sectors
//! know no lengths. An ellipse of lengths would leave out too much; only the search by length has one.

use crate::barrier::{Feature, Side};
use std::f64::consts::FRAC_PI_2;
use traverse_geometry::{AxisSpeeds, Point, Vector};

/// How a search measures the way.
pub(crate) trait Measure: Copy {
    /// What a straight move costs that is `length` long and has `normal` on its left.
    fn straight(self, normal: Vector, length: f64) -> f64;

    /// No way along `by` costs less, and the straight one costs as much.
    fn along(self, by: Vector) -> f64;

    /// No way along a vector that differs from `by` by at most `radius` millimetres costs less.
    fn near(self, by: Vector, radius: f64) -> f64;

    /// No straight way of `length` millimetres costs less.
    fn fastest(self, length: f64) -> f64;

    /// How the cost of a straight way along the unit vector `direction` grows with where it ends, per millimetre; where that
    /// jumps, one of both.
    fn gradient(self, direction: Vector) -> Vector;

    /// Outward directions in which ways leave a circle that they turn round counter-clockwise and along which the
    /// gradient jumps, radians; between two of them it is the same for all directions. None: it turns with the direction.
    fn kinks(self) -> Option<[f64; 4]> {
        None
    }

    /// What the answered path's arc of `radius` costs from the outward direction `from`, radians, over `sweep` (positive
    /// counter-clockwise).
    fn arc(self, radius: f64, from: f64, sweep: f64) -> f64;

    /// The same from the outward direction `spoke`.
    fn turn(self, radius: f64, spoke: Vector, sweep: f64) -> f64 {
        self.arc(radius, spoke.y.atan2(spoke.x), sweep)
    }

    /// The same on a feature's circle between two offsets.
    fn between(self, circle: &Feature, from: f64, to: f64) -> f64 {
        self.arc(circle.price_radius, circle.start_angle + from, to - from)
    }

    /// Whether a way may bend round the barriers of `owner` on that side.
    fn admits(self, _owner: usize, _side: Side) -> bool {
        true
    }

    /// Whose barriers leave a straight move that nothing blocks too little room for the machine to run it; none: it can.
    fn cramped_by(self, _from: Point, _to: Point) -> Option<Vec<usize>> {
        None
    }
}

/// Length, millimetres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Length;

impl Measure for Length {
    fn straight(self, _normal: Vector, length: f64) -> f64 {
        length
    }

    fn along(self, by: Vector) -> f64 {
        by.norm()
    }

    fn near(self, by: Vector, radius: f64) -> f64 {
        (by.norm() - radius).max(0.0)
    }

    fn fastest(self, length: f64) -> f64 {
        length
    }

    fn gradient(self, direction: Vector) -> Vector {
        direction
    }

    fn arc(self, radius: f64, _from: f64, sweep: f64) -> f64 {
        radius * sweep.abs()
    }

    fn turn(self, radius: f64, _spoke: Vector, sweep: f64) -> f64 {
        radius * sweep.abs()
    }
}

/// Seconds of the slower axis, a norm whose unit ball is a rectangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisTime {
    x_mm_per_s: f64,
    y_mm_per_s: f64,
    /// Outward directions up to this one from the X axis have the Y axis slower, radians.
    kink: f64,
    /// What a quarter turn costs at radius 1.
    quarter: f64,
}

impl AxisTime {
    pub(crate) fn new(speeds: &AxisSpeeds) -> Self {
        let AxisSpeeds { x_mm_per_s, y_mm_per_s, .. } = *speeds;
        let kink = x_mm_per_s.atan2(y_mm_per_s);
        let quarter = kink.sin() / y_mm_per_s + kink.cos() / x_mm_per_s;
        Self { x_mm_per_s, y_mm_per_s, kink, quarter }
    }

    /// What an arc of radius 1 costs from direction 0 counter-clockwise to `angle`.
    ///
    /// Along outward direction θ the X axis moves by |sin θ| dθ and the Y axis by |cos θ| dθ.
    fn up_to(self, angle: f64) -> f64 {
        let quarters = (angle / FRAC_PI_2).floor();
        let rest = angle - quarters * FRAC_PI_2;
        let is_odd = quarters.rem_euclid(2.0) == 1.0;
        let part = if is_odd {
            self.quarter - self.within_quarter(FRAC_PI_2 - rest)
        } else {
            self.within_quarter(rest)
        };
        quarters * self.quarter + part
    }

    fn within_quarter(self, angle: f64) -> f64 {
        let by_y = angle.min(self.kink).sin() / self.y_mm_per_s;
        let by_x = (self.kink.cos() - angle.max(self.kink).cos()) / self.x_mm_per_s;
        by_y + by_x
    }
}

impl Measure for AxisTime {
    fn straight(self, normal: Vector, length: f64) -> f64 {
        self.along(Vector::new(normal.y, normal.x) * length)
    }

    fn along(self, by: Vector) -> f64 {
        (by.x.abs() / self.x_mm_per_s).max(by.y.abs() / self.y_mm_per_s)
    }

    fn near(self, by: Vector, radius: f64) -> f64 {
        let [x, y] = [by.x, by.y].map(|along| (along.abs() - radius).max(0.0));
        self.along(Vector::new(x, y))
    }

    fn fastest(self, length: f64) -> f64 {
        length / self.x_mm_per_s.hypot(self.y_mm_per_s)
    }

    fn gradient(self, direction: Vector) -> Vector {
        let (x, y) = (direction.x.abs() / self.x_mm_per_s, direction.y.abs() / self.y_mm_per_s);
        if direction == Vector::zeros() {
            Vector::zeros()
        } else if x > y {
            Vector::new(direction.x.signum() / self.x_mm_per_s, 0.0)
        } else {
            Vector::new(0.0, direction.y.signum() / self.y_mm_per_s)
        }
    }

    /// Where both axes are equally slow.
    fn kinks(self) -> Option<[f64; 4]> {
        let half = std::f64::consts::PI;
        Some([self.kink, half - self.kink, half + self.kink, -self.kink])
    }

    fn arc(self, radius: f64, from: f64, sweep: f64) -> f64 {
        radius * (self.up_to(from + sweep) - self.up_to(from)).abs()
    }
}

/// Another measure, where no way bends round some owners' barriers on some sides: other ways round.
#[derive(Clone, Copy)]
pub(crate) struct Barred<'a, M> {
    pub(crate) measure: M,
    pub(crate) barred: &'a [(usize, Side)],
}

impl<M: Measure> Measure for Barred<'_, M> {
    fn straight(self, normal: Vector, length: f64) -> f64 {
        self.measure.straight(normal, length)
    }

    fn along(self, by: Vector) -> f64 {
        self.measure.along(by)
    }

    fn near(self, by: Vector, radius: f64) -> f64 {
        self.measure.near(by, radius)
    }

    fn fastest(self, length: f64) -> f64 {
        self.measure.fastest(length)
    }

    fn gradient(self, direction: Vector) -> Vector {
        self.measure.gradient(direction)
    }

    fn kinks(self) -> Option<[f64; 4]> {
        self.measure.kinks()
    }

    fn arc(self, radius: f64, from: f64, sweep: f64) -> f64 {
        self.measure.arc(radius, from, sweep)
    }

    fn admits(self, owner: usize, side: Side) -> bool {
        !self.barred.contains(&(owner, side))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::unit;

    #[test]
    fn arcs_are_the_limit_of_their_chords() {
        for (x, y) in [(100.0, 100.0), (200.0, 50.0), (3.0, 70.0)] {
            let speeds = AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 0.0 };
            let time = AxisTime::new(&speeds);
            for case in 0..80 {
                let from = f64::from(case) * 0.37 - 9.0;
                let sweep = f64::from(case % 13) * 0.5 - 3.0;
                let count = 20_000;
                let at = |k: i32| unit(from + sweep * f64::from(k) / f64::from(count)) * 7.0;
                let chords: f64 = (0..count).map(|k| time.along(at(k + 1) - at(k))).sum();
                let arc = time.arc(7.0, from, sweep);
                assert!(
                    (arc - chords).abs() <= 1e-6 * arc.max(1e-3),
                    "{x} {y} {from} {sweep}: {arc} {chords}"
                );
            }
        }
    }

    #[test]
    fn costs_of_parts_add_up_and_are_no_less_than_the_straight_way() {
        let time = AxisTime::new(&AxisSpeeds { x_mm_per_s: 30.0, y_mm_per_s: 80.0, z_mm_per_s: 0.0 });
        for case in 0..200 {
            let (from, first, second) = (f64::from(case) * 0.1 - 7.0, f64::from(case % 7) * 0.3, 1.1);
            let (one, other) = (time.arc(2.0, from, first), time.arc(2.0, from + first, second));
            let both = time.arc(2.0, from, first + second);
            assert!((one + other - both).abs() < 1e-14);
            let back = time.arc(2.0, from + first + second, -first - second);
            assert!((back - both).abs() < 1e-15);
            let straight = time.along((unit(from + first + second) - unit(from)) * 2.0);
            assert!(straight <= both + 1e-15);
        }
    }
}
