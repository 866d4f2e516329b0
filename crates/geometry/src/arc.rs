//! A circular edge.

use crate::{Bounds, Point, Vector, cross, left_of, positive_angle, unit};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A circular edge of at most one full turn.
///
/// `start` and `end` are kept as they were given, so that neighbouring edges share them bit for bit;
/// centre and radius are derived in floating point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Centre of the circle.
    pub center: Point,
    /// Radius, millimetres, positive.
    pub radius: f64,
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
    /// Direction from the centre to the start, radians.
    pub start_angle: f64,
    /// Turned angle, radians, positive counter-clockwise, within [−2π, 2π].
    pub sweep: f64,
}

impl Arc {
    /// The arc from `start` to `end` with the given bulge, tan(sweep / 4), as in DXF LWPOLYLINE.
    ///
    /// `bulge` must not be 0 and `start` must differ from `end`.
    #[must_use]
    pub fn from_bulge(start: Point, end: Point, bulge: f64) -> Self {
        debug_assert!(bulge != 0.0 && start != end, "a straight or empty edge has no centre");
        let chord = end - start;
        let middle = nalgebra::center(&start, &end);
        let center = middle + left_of(chord) * ((1.0 - bulge * bulge) / (4.0 * bulge));
        let radius = chord.norm() * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        let spoke = start - center;
        Self { center, radius, start, end, start_angle: spoke.y.atan2(spoke.x), sweep: 4.0 * bulge.atan() }
    }

    /// The arc on a circle, from `start_angle` on over `sweep`.
    #[must_use]
    pub fn from_angles(center: Point, radius: f64, start_angle: f64, sweep: f64) -> Self {
        let start = center + unit(start_angle) * radius;
        let end = if sweep.abs() >= TAU { start } else { center + unit(start_angle + sweep) * radius };
        Self { center, radius, start, end, start_angle, sweep }
    }

    /// The arc between two points about a centre. Equal points and a sweep of one turn are a circle.
    /// The radius is the mean of both distances.
    #[must_use]
    pub fn from_center(start: Point, end: Point, center: Point, sweep: f64) -> Self {
        let spoke = start - center;
        let radius = (spoke.norm() + (end - center).norm()) / 2.0;
        Self { center, radius, start, end, start_angle: spoke.y.atan2(spoke.x), sweep }
    }

    /// Millimetres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.radius * self.sweep.abs()
    }

    /// tan(sweep / 4): positive counter-clockwise, within [−1, 1] up to half a turn, huge for a full one.
    #[must_use]
    pub fn bulge(&self) -> f64 {
        (self.sweep / 4.0).tan()
    }

    /// The point at `fraction` of the way: exactly the start up to 0, exactly the end from 1 on.
    #[must_use]
    pub fn point_at(&self, fraction: f64) -> Point {
        if fraction <= 0.0 {
            self.start
        } else if fraction >= 1.0 {
            self.end
        } else {
            self.center + unit(self.start_angle + self.sweep * fraction) * self.radius
        }
    }

    /// Unit direction of travel at `fraction` of the way.
    #[must_use]
    pub fn direction_at(&self, fraction: f64) -> Vector {
        left_of(unit(self.start_angle + self.sweep * fraction)) * self.sweep.signum()
    }

    /// How far the circle that is computed here may lie from the one that its ends and bulge define, millimetres:
    /// some 1e-9 for ordinary arcs, 1e-7 at [`crate::RADIUS_LIMIT_MM`].
    #[must_use]
    pub fn rounding_mm(&self) -> f64 {
        8.0 * f64::EPSILON * (self.center.x.abs() + self.center.y.abs() + self.radius)
    }

    /// Whether the ray from the centre along `direction` meets the arc, ends included: the directions to `start` and
    /// `end` are always met. So is the direction 0.
    #[must_use]
    pub fn spans(&self, direction: Vector) -> bool {
        let turn = self.sweep.abs();
        if turn >= TAU {
            return true;
        }
        let (from, to) = if self.sweep > 0.0 {
            (self.start - self.center, self.end - self.center)
        } else {
            (self.end - self.center, self.start - self.center)
        };
        // Counter-clockwise from `from` to `to`. On either side of the middle the arc takes less than half a turn,
        // so one cross product decides there. The middle need only lie well within the arc.
        let middle = if turn < FRAC_PI_2 {
            from + to
        } else if turn < 3.0 * FRAC_PI_2 {
            -left_of(to - from)
        } else {
            -(from + to)
        };
        if turn < FRAC_PI_2 && middle.dot(&direction) < 0.0 {
            return false;
        }
        if cross(middle, direction) >= 0.0 {
            cross(direction, to) >= 0.0
        } else {
            cross(from, direction) >= 0.0
        }
    }

    /// The point of the arc nearest to `p`; its start when `p` is the centre.
    #[must_use]
    pub fn nearest_point(&self, p: Point) -> Point {
        let direction = p - self.center;
        let distance = direction.norm();
        if distance > 0.0 && self.spans(direction) {
            return self.center + direction * (self.radius / distance);
        }
        if (p - self.start).norm_squared() <= (p - self.end).norm_squared() { self.start } else { self.end }
    }

    /// Distance from `p` to the nearest point of the arc.
    #[must_use]
    pub fn distance_to_point(&self, p: Point) -> f64 {
        let direction = p - self.center;
        if self.spans(direction) {
            return (direction.norm() - self.radius).abs();
        }
        (p - self.start).norm().min((p - self.end).norm())
    }

    /// The same way, run from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            start: self.end,
            end: self.start,
            start_angle: positive_angle(self.start_angle + self.sweep),
            sweep: -self.sweep,
            ..*self
        }
    }

    /// Bounding box.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let ends = Bounds::of([self.start, self.end]);
        (0..4)
            .map(|quarter| unit(f64::from(quarter) * FRAC_PI_2))
            .filter(|&direction| self.spans(direction))
            .fold(ends, |bounds, direction| bounds.with(self.center + direction * self.radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn half_turns_span_their_ends() {
        for i in 0..1000 {
            let i = f64::from(i);
            let (start, end) = (Point::new(0.1 * i, 0.3), Point::new(-7.7, 0.013 * i * i));
            for bulge in [1.0, -1.0, 1.0 - 1e-15, 1.0 - 1e-9] {
                let arc = Arc::from_bulge(start, end, bulge);
                assert!(arc.spans(start - arc.center) && arc.spans(end - arc.center));
                assert!(
                    arc.spans(arc.point_at(0.5) - arc.center) && !arc.spans(arc.center - arc.point_at(0.5))
                );
            }
        }
    }

    #[test]
    fn any_sweep_spans_what_it_turns_over() {
        for i in 1..200 {
            for sign in [1.0, -1.0] {
                let sweep = sign * f64::from(i) * TAU / 200.0;
                let arc = Arc::from_angles(Point::new(3.0, -4.0), 2.0, 0.7, sweep);
                for j in 0..400 {
                    let turned = (f64::from(j) + 0.5) * TAU / 400.0;
                    assert_eq!(
                        arc.spans(unit(0.7 + sign * turned)),
                        turned < sweep.abs(),
                        "{sweep} {turned}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_tiny_arc_of_a_huge_circle_does_not_span_the_far_side() {
        let arc = Arc::from_bulge(Point::new(0.0, 0.0), Point::new(1.0, 0.0), 1e-6);
        assert!(!arc.spans(arc.center - arc.point_at(0.5)));
        assert!((arc.distance_to_point(Point::new(0.5, 3.0)) - 3.0).abs() < 1e-5);
    }

    #[test]
    fn a_circle_bounds_and_spans_everything() {
        let circle = Arc::from_angles(Point::new(1.0, 1.0), 2.0, PI / 3.0, -TAU);
        assert_eq!(circle.start, circle.end);
        assert!((circle.bounds().size() - Vector::repeat(4.0)).norm() < 1e-12);
        assert!((circle.length() - 4.0 * PI).abs() < 1e-12);
        assert_eq!(circle.nearest_point(circle.center), circle.start);
    }
}
