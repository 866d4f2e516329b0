//! Whether two edges, at least one of them circular, cross deeper than [`CONTACT_TOLERANCE_MM`].
//!
//! Floating point, and on the side of the caller: what touches within the tolerance is contact. Between their ends
//! two edges cross where both lie deeper than the tolerance on either side of the other's line or circle. At a
//! vertex they cross where the four ways out leave a disc round it in turns: then they have to cross within that
//! disc. Cost: constant.

use crate::chain_crossing::Visit;
use crate::loops::Loops;
use crate::{Arc, CONTACT_TOLERANCE_MM, Edge, Point, Segment, Vector, cross, left_of, positive_angle, unit};
use std::f64::consts::PI;

/// Discs smaller than this share of the tolerance say nothing about sides.
const SMALLEST_DISC_MM: f64 = 100.0 * CONTACT_TOLERANCE_MM;

/// Where the lines or circles of both edges cross, as far as both edges reach there.
pub(crate) fn common_points(a: &Edge, b: &Edge) -> Vec<Point> {
    let mut points = curve_points(a, b);
    points.retain(|&p| [a, b].into_iter().all(|edge| (0.0..=1.0).contains(&fraction(edge, p))));
    points
}

/// Where both edges cross between their ends, deeper than the tolerance on all sides.
pub(crate) fn deep_crossing(a: &Edge, b: &Edge) -> Option<Point> {
    // Beyond its end a curve still parts the pieces of the other edge.
    let cuts = curve_points(a, b);
    common_points(a, b).into_iter().find(|&p| changes_side(a, b, &cuts, p) && changes_side(b, a, &cuts, p))
}

/// Where the lines or circles of both edges cross, at least one of them circular.
fn curve_points(a: &Edge, b: &Edge) -> Vec<Point> {
    match (a, b) {
        (Edge::Segment(_), Edge::Segment(_)) => Vec::new(),
        (Edge::Segment(segment), Edge::Arc(arc)) | (Edge::Arc(arc), Edge::Segment(segment)) => {
            line_circle(segment, arc)
        }
        (Edge::Arc(a), Edge::Arc(b)) => circle_circle(a, b),
    }
}

/// Whether `edge` lies deeper than the tolerance on different sides of the curve of `other` before and after `p`.
fn changes_side(edge: &Edge, other: &Edge, cuts: &[Point], p: Point) -> bool {
    let at = fraction(edge, p);
    let cuts: Vec<f64> = cuts.iter().map(|&cut| fraction(edge, cut)).collect();
    let before = cuts.iter().copied().filter(|&cut| cut < at).fold(0.0, f64::max);
    let after = cuts.iter().copied().filter(|&cut| cut > at).fold(1.0, f64::min);
    let extremes = extreme_fractions(edge, other);
    let depth = |from: f64, to: f64| {
        let inner = extremes.iter().copied().filter(|t| (from..=to).contains(t));
        [from, to].into_iter().chain(inner).map(|t| height(other, edge.point_at(t))).fold(
            0.0,
            |deepest: f64, height| {
                if height.abs() > deepest.abs() { height } else { deepest }
            },
        )
    };
    let (before, after) = (depth(before, at), depth(at, after));
    before.abs() > CONTACT_TOLERANCE_MM
        && after.abs() > CONTACT_TOLERANCE_MM
        && (before > 0.0) != (after > 0.0)
}

/// Where on `edge` its distance to the curve of `other` may be extreme, apart from its ends.
fn extreme_fractions(edge: &Edge, other: &Edge) -> Vec<f64> {
    let axis = match (edge, other) {
        (Edge::Segment(segment), Edge::Arc(arc)) => {
            return vec![fraction(edge, segment.nearest_point(arc.center))];
        }
        (Edge::Segment(_), Edge::Segment(_)) => return Vec::new(),
        (Edge::Arc(_), Edge::Segment(segment)) => left_of(segment.vector()),
        (Edge::Arc(arc), Edge::Arc(other)) => other.center - arc.center,
    };
    let (Edge::Arc(arc), Some(axis)) = (edge, axis.try_normalize(0.0)) else { return Vec::new() };
    [axis, -axis].into_iter().map(|direction| fraction(edge, arc.center + direction * arc.radius)).collect()
}

/// How far `p` lies from the line or circle of `edge`, with different signs on its two sides.
fn height(edge: &Edge, p: Point) -> f64 {
    match edge {
        Edge::Segment(segment) => cross(segment.vector(), p - segment.start) / segment.length(),
        Edge::Arc(arc) => (p - arc.center).norm() - arc.radius,
    }
}

/// Where along `edge` the point `p` of its line or circle lies: 0 at the start, 1 at the end. Arcs up to half a turn.
fn fraction(edge: &Edge, p: Point) -> f64 {
    match edge {
        Edge::Segment(segment) => {
            let along = segment.vector();
            (p - segment.start).dot(&along) / along.norm_squared()
        }
        Edge::Arc(arc) => {
            let (from, to) = (arc.start - arc.center, p - arc.center);
            cross(from, to).atan2(from.dot(&to)) / arc.sweep
        }
    }
}

fn line_circle(segment: &Segment, arc: &Arc) -> Vec<Point> {
    let Some(along) = segment.vector().try_normalize(0.0) else { return Vec::new() };
    let to_center = arc.center - segment.start;
    let (foot, offset) = (to_center.dot(&along), cross(along, to_center));
    let half_square = (arc.radius - offset) * (arc.radius + offset);
    if half_square < 0.0 {
        return Vec::new();
    }
    let half = half_square.sqrt();
    vec![segment.start + along * (foot - half), segment.start + along * (foot + half)]
}

fn circle_circle(a: &Arc, b: &Arc) -> Vec<Point> {
    let between = b.center - a.center;
    let distance = between.norm();
    if distance == 0.0 {
        return Vec::new();
    }
    let axis = between / distance;
    let along = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2.0;
    let half_square = (a.radius - along) * (a.radius + along);
    if half_square < 0.0 {
        return Vec::new();
    }
    let half = left_of(axis) * half_square.sqrt();
    vec![a.center + axis * along + half, a.center + axis * along - half]
}

/// Whether the chains of both visits leave discs round `p` in turns. `p` lies within the tolerance of both.
pub(crate) fn leave_in_turns(loops: &Loops, p: Point, a: Visit, b: Visit) -> bool {
    let ways = [a, b].map(|visit| Way::both(loops, visit, p));
    let reach = ways.iter().flatten().map(Way::reach).fold(f64::INFINITY, f64::min);
    [0.999, 0.25, 0.06].into_iter().map(|share| share * reach).any(|radius| {
        if radius < SMALLEST_DISC_MM {
            return false;
        }
        let angle = |way: &Way| {
            let out = way.point_at(radius) - p;
            out.y.atan2(out.x)
        };
        let [[a_back, a_ahead], [b_back, b_ahead]] = [0, 1].map(|i| [angle(&ways[i][0]), angle(&ways[i][1])]);
        let gap = 4.0 * CONTACT_TOLERANCE_MM / radius;
        let sector = positive_angle(a_back - a_ahead);
        let clear = |x: f64| {
            [a_back, a_ahead].into_iter().all(|side| {
                let turn = positive_angle(x - side);
                turn > gap && turn < 2.0 * PI - gap
            })
        };
        let inside = |x: f64| positive_angle(x - a_ahead) < sector;
        clear(b_back) && clear(b_ahead) && inside(b_back) != inside(b_ahead)
    })
}

/// One way out of a visited point: along an edge from `from`, in the edge's direction or against it.
struct Way {
    edge: Edge,
    from: Point,
}

impl Way {
    /// Back and ahead.
    fn both(loops: &Loops, visit: Visit, p: Point) -> [Self; 2] {
        let edge = loops.edge(visit.edge);
        if visit.at_start {
            let back = loops.edge(loops.previous(visit.edge)).reversed();
            let from = edge.start();
            [Self { edge: back, from }, Self { edge, from }]
        } else {
            let from = edge.nearest_point(p);
            [Self { edge: edge.reversed(), from }, Self { edge, from }]
        }
    }

    /// How far from its first point the way leads before its edge ends or turns back.
    fn reach(&self) -> f64 {
        (self.edge.end() - self.from).norm()
    }

    /// The point of the way at the given distance from its first point.
    fn point_at(&self, distance: f64) -> Point {
        match &self.edge {
            Edge::Segment(segment) => {
                self.from + segment.vector().try_normalize(0.0).unwrap_or_default() * distance
            }
            Edge::Arc(arc) => {
                let spoke: Vector = self.from - arc.center;
                let turn = 2.0 * (distance / (2.0 * arc.radius)).min(1.0).asin() * arc.sweep.signum();
                arc.center + unit(spoke.y.atan2(spoke.x) + turn) * arc.radius
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(from: (f64, f64), to: (f64, f64), bulge: f64) -> Edge {
        Edge::from_bulge(Point::new(from.0, from.1), Point::new(to.0, to.1), bulge)
    }

    #[track_caller]
    fn check(a: Edge, b: Edge, crosses: bool) {
        for (a, b) in [(a, b), (b, a), (a.reversed(), b), (a, b.reversed())] {
            assert_eq!(deep_crossing(&a, &b).is_some(), crosses);
        }
    }

    #[test]
    fn line_and_half_circle() {
        let half = edge((-1.0, 0.0), (1.0, 0.0), 1.0);
        check(half, edge((0.0, 0.0), (0.0, -2.0), 0.0), true);
        check(half, edge((0.0, 0.0), (0.0, 2.0), 0.0), false);
        // Tangent, nearly tangent on either side, and a secant.
        check(half, edge((-2.0, -1.0), (2.0, -1.0), 0.0), false);
        check(half, edge((-2.0, -1.0 + 0.5e-6), (2.0, -1.0 + 0.5e-6), 0.0), false);
        check(half, edge((-2.0, -1.0 - 0.5e-6), (2.0, -1.0 - 0.5e-6), 0.0), false);
        check(half, edge((-2.0, -1.0 + 2e-6), (2.0, -1.0 + 2e-6), 0.0), true);
        // Ending on it, and just past it.
        check(half, edge((0.0, 0.0), (0.0, -1.0), 0.0), false);
        check(half, edge((0.0, 0.0), (0.0, -1.0 - 0.5e-6), 0.0), false);
        check(half, edge((0.0, 0.0), (0.0, -1.0 - 2e-6), 0.0), true);
    }

    #[test]
    fn arcs_on_nearly_the_same_circle() {
        let half = edge((-1.0, 0.0), (1.0, 0.0), 1.0);
        check(half, half, false);
        check(half, edge((-1.0 + 3e-7, 0.0), (1.0 + 3e-7, 0.0), 1.0), false);
        check(half, edge((-1.0 + 3e-5, 0.0), (1.0 + 3e-5, 0.0), 1.0), true);
    }

    /// The second crossing of the two circles lies on one arc only. Found by generated rings.
    #[test]
    fn circles_that_cross_again_beyond_an_end() {
        let first = edge((0.0, 0.0), (-5.2284094211215075, 0.0), -0.6257064214448556);
        let second = edge(
            (-1.7424754011969246, -8.481160244558254),
            (-8.255834785467883, 7.228272689171268),
            0.14807926035987726,
        );
        check(first, second, true);
    }
}
