//! Rigid motions of the plane, with or without a mirror.

use crate::{Arc, Edge, Path, PathArc, PathStep, Point, Polygon, Polyline, Ring, Segment, Vector, unit};

/// A rigid motion: a mirror that turns x into −x if there is one, then a rotation about the origin, then a
/// translation. Quarter turns and mirrors are exact; everything else rounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    mirrored: bool,
    /// Cosine and sine of the rotation.
    direction: Vector,
    translation: Vector,
}

impl Motion {
    /// Leaves everything where it is.
    pub const IDENTITY: Self =
        Self { mirrored: false, direction: Vector::new(1.0, 0.0), translation: Vector::new(0.0, 0.0) };

    /// Moves by `by`, millimetres.
    #[must_use]
    pub fn translation(by: Vector) -> Self {
        Self { translation: by, ..Self::IDENTITY }
    }

    /// Turns by `angle` radians, counter-clockwise, about the origin.
    #[must_use]
    pub fn rotation(angle: f64) -> Self {
        Self { direction: unit(angle), ..Self::IDENTITY }
    }

    /// Turns by `turns` quarter turns, counter-clockwise, about the origin. Exact.
    #[must_use]
    pub fn quarter_turns(turns: i32) -> Self {
        let (x, y) = match turns.rem_euclid(4) {
            0 => (1.0, 0.0),
            1 => (0.0, 1.0),
            2 => (-1.0, 0.0),
            _ => (0.0, -1.0),
        };
        Self { direction: Vector::new(x, y), ..Self::IDENTITY }
    }

    /// Mirrors in the y axis: x becomes −x. Exact.
    #[must_use]
    pub fn mirror_x() -> Self {
        Self { mirrored: true, ..Self::IDENTITY }
    }

    /// The same motion, seen from `center` as its origin.
    #[must_use]
    pub fn about(self, center: Point) -> Self {
        Self::translation(-center.coords).then(&self).then(&Self::translation(center.coords))
    }

    /// This motion first, then `next`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let first = if next.mirrored { mirrored_turn(self.direction) } else { self.direction };
        Self {
            mirrored: self.mirrored != next.mirrored,
            direction: turned(first, next.direction),
            translation: next.vector(self.translation) + next.translation,
        }
    }

    /// The motion that takes everything back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let direction = if self.mirrored { self.direction } else { mirrored_turn(self.direction) };
        let back = Self { mirrored: self.mirrored, direction, translation: Vector::zeros() };
        Self { translation: -back.vector(self.translation), ..back }
    }

    /// Whether the motion exchanges left and right.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.mirrored
    }

    /// Where `p` comes to lie.
    #[must_use]
    pub fn point(&self, p: Point) -> Point {
        Point::from(self.vector(p.coords) + self.translation)
    }

    /// Where the displacement `v` comes to point; translations leave it alone.
    #[must_use]
    pub fn vector(&self, v: Vector) -> Vector {
        turned(if self.mirrored { Vector::new(-v.x, v.y) } else { v }, self.direction)
    }

    /// The turned angle `sweep`, or a bulge, after the motion.
    fn turn(&self, sweep: f64) -> f64 {
        if self.mirrored { -sweep } else { sweep }
    }

    fn vertices(&self, vertices: &[Point]) -> Vec<Point> {
        // Adding 0 turns −0.0 into 0.0, as validation does.
        vertices.iter().map(|&vertex| self.point(vertex) + Vector::zeros()).collect()
    }

    fn bulges(&self, bulges: &[f64]) -> Vec<f64> {
        bulges.iter().map(|&bulge| self.turn(bulge) + 0.0).collect()
    }
}

/// `v` turned by the angle of the unit vector `direction`.
fn turned(v: Vector, direction: Vector) -> Vector {
    Vector::new(v.x * direction.x - v.y * direction.y, v.x * direction.y + v.y * direction.x)
}

/// The opposite turn.
fn mirrored_turn(direction: Vector) -> Vector {
    Vector::new(direction.x, -direction.y)
}

impl Segment {
    /// The edge after `motion`.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        Self::new(motion.point(self.start), motion.point(self.end))
    }
}

impl Arc {
    /// The arc after `motion`.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        let (start, end, center) =
            (motion.point(self.start), motion.point(self.end), motion.point(self.center));
        let spoke = motion.vector(unit(self.start_angle));
        Self {
            center,
            radius: self.radius,
            start,
            end,
            start_angle: spoke.y.atan2(spoke.x),
            sweep: motion.turn(self.sweep),
        }
    }
}

impl Edge {
    /// The edge after `motion`.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        match self {
            Self::Segment(segment) => Self::Segment(segment.moved(motion)),
            Self::Arc(arc) => Self::Arc(arc.moved(motion)),
        }
    }
}

impl Ring {
    /// The ring after `motion`. It stays the same shape up to rounding and is not validated again: straight edges that
    /// touch may come to lie a rounding error over each other, which [`Ring::new`] would refuse as a crossing. Keep it within the coordinate limit. Cost: linear.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        Self::trusted(motion.vertices(self.vertices()), motion.bulges(self.bulges()), self.touches_itself())
    }
}

impl Polygon {
    /// The polygon after `motion`; what holds for [`Ring::moved`] holds for its rings.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        let holes = self.holes().iter().map(|hole| hole.moved(motion)).collect();
        Self::trusted(self.outer().moved(motion), holes)
    }
}

impl Polyline {
    /// The chain after `motion`; what holds for [`Ring::moved`] holds here.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        Self::trusted(motion.vertices(self.vertices()), motion.bulges(self.bulges()))
    }
}

impl Path {
    /// The path after `motion`.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        let step = |step: &PathStep| PathStep {
            end: motion.point(step.end),
            arc: step
                .arc
                .map(|arc| PathArc { center: motion.point(arc.center), sweep: motion.turn(arc.sweep) }),
            z_mm: step.z_mm,
        };
        Self {
            start: motion.point(self.start),
            start_z_mm: self.start_z_mm,
            steps: self.steps.iter().map(step).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn motions() -> impl Strategy<Value = Motion> {
        (any::<bool>(), -7.0..7.0, -1e3..1e3, -1e3..1e3).prop_map(|(mirrored, angle, x, y)| {
            let first = if mirrored { Motion::mirror_x() } else { Motion::IDENTITY };
            first.then(&Motion::rotation(angle)).then(&Motion::translation(Vector::new(x, y)))
        })
    }

    fn near(p: Point, q: Point) -> bool {
        (p - q).norm() < 1e-9
    }

    proptest! {
        #[test]
        fn composition_and_inverse(a in motions(), b in motions(), x in -1e3..1e3, y in -1e3..1e3) {
            let p = Point::new(x, y);
            prop_assert!(near(a.then(&b).point(p), b.point(a.point(p))));
            prop_assert!(near(a.inverse().point(a.point(p)), p));
            prop_assert!(near(a.then(&a.inverse()).point(p), p));
            prop_assert!(near(a.about(p).point(p), p) || a.translation != Vector::zeros());
        }

        #[test]
        fn edges_move_with_their_points(motion in motions(), bulge in -1.0..1.0, share in 0.0..1.0) {
            let edge = Edge::from_bulge(Point::new(3.0, -2.0), Point::new(8.0, 5.0), bulge);
            let moved = edge.moved(&motion);
            prop_assert!(near(moved.point_at(share), motion.point(edge.point_at(share))));
            prop_assert!((moved.direction_at(share) - motion.vector(edge.direction_at(share))).norm() < 1e-9);
            prop_assert!((moved.length() - edge.length()).abs() < 1e-9);
        }

        #[test]
        fn paths_move_with_their_edges(motion in motions()) {
            let mut path = Path::at(Point::new(1.0, 2.0));
            path.line_to(Point::new(4.0, 2.0));
            path.arc_to(Point::new(4.0, 6.0), Point::new(4.0, 4.0), std::f64::consts::PI);
            let moved = path.moved(&motion);
            prop_assert!((moved.length() - path.length()).abs() < 1e-9);
            for (edge, other) in path.edges().zip(moved.edges()) {
                prop_assert!(near(motion.point(edge.point_at(0.3)), other.point_at(0.3)));
            }
        }
    }

    #[test]
    fn quarter_turns_and_mirrors_are_exact() {
        let p = Point::new(0.1, 0.7);
        assert_eq!(Motion::quarter_turns(1).point(p), Point::new(-0.7, 0.1));
        assert_eq!(Motion::quarter_turns(-6).point(p), Point::new(-0.1, -0.7));
        assert_eq!(Motion::mirror_x().point(p), Point::new(-0.1, 0.7));
        let ring = Ring::from_xy(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0], &[0.0, 0.3, 0.0]).unwrap();
        let mirrored = ring.moved(&Motion::mirror_x());
        assert_eq!(mirrored.signed_area(), -ring.signed_area());
        assert_eq!(mirrored.moved(&Motion::mirror_x()), ring);
    }
}
