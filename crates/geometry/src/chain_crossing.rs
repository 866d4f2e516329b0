//! Whether two straight chains that meet in a point pass through each other there. Exact.
//!
//! Where chains meet without a proper crossing of two edges, the sides on which they come and go decide: round a
//! common point the four ways out interleave, or, where they share a way, the chains part to the other side than
//! they came from. A chain that turns back on itself within a shared way (an antenna) has no side; it is taken
//! as touching. Cost: constant, and linear in the count of edges that the chains share.

use crate::box_tree::Work;
use crate::loops::Loops;
use crate::{Orientation, Point, orientation};

/// One passage of a chain through a point: on edge `edge`, at its start or between its ends.
#[derive(Clone, Copy)]
pub(crate) struct Visit {
    pub(crate) edge: usize,
    pub(crate) at_start: bool,
}

impl Visit {
    /// The vertex that the chain comes from.
    fn back(self, loops: &Loops) -> Point {
        loops.vertex(if self.at_start { loops.previous(self.edge) } else { self.edge })
    }

    /// The vertex that the chain goes to.
    fn ahead(self, loops: &Loops) -> Point {
        loops.vertex(loops.next(self.edge))
    }

    /// The edge on which the chain arrives.
    pub(crate) fn incoming(self, loops: &Loops) -> usize {
        if self.at_start { loops.previous(self.edge) } else { self.edge }
    }
}

/// Whether the chains of visits `a` and `b` pass through each other at `p` or along the way that they share from
/// there. All edges at both visits are straight. A shared way counts at one of its ends only.
pub(crate) fn pass_through(loops: &Loops, p: Point, a: Visit, b: Visit, work: &mut Work<'_>) -> bool {
    let (a_back, a_ahead) = (a.back(loops), a.ahead(loops));
    let (b_back, b_ahead) = (b.back(loops), b.ahead(loops));
    if same_ray(p, a_back, a_ahead) || same_ray(p, b_back, b_ahead) {
        return false;
    }
    let (together_ahead, together_back) = (same_ray(p, a_ahead, b_ahead), same_ray(p, a_back, b_back));
    let (a_against_b, b_against_a) = (same_ray(p, a_ahead, b_back), same_ray(p, b_ahead, a_back));
    match (together_ahead, together_back, a_against_b, b_against_a) {
        (false, false, false, false) => {
            in_sector(p, a_ahead, b_back, a_back) != in_sector(p, a_ahead, b_ahead, a_back)
        }
        (true, false, ..) => parts_across(loops, p, a, b, Sense::Along, work),
        (_, _, true, false) => parts_across(loops, p, a, b, Sense::Against, work),
        (_, _, false, true) => parts_across(loops, p, b, a, Sense::Against, work),
        // In the middle of a shared way, or at its end.
        _ => false,
    }
}

/// How a chain runs on a shared way, as seen from the other one.
#[derive(Clone, Copy, PartialEq)]
enum Sense {
    Along,
    Against,
}

/// Whether `b` leaves the way that it shares with `a` from `start` on, in the direction of `a`, to the other side of
/// `a` than it has at `start`. A way that ends in an antenna has no sides.
fn parts_across(loops: &Loops, start: Point, a: Visit, b: Visit, sense: Sense, work: &mut Work<'_>) -> bool {
    // Where an edge of `b` leads to, and what follows it, in the direction of `a`.
    let b_target = |edge: usize| if sense == Sense::Along { loops.next(edge) } else { edge };
    let b_after = |vertex: usize| if sense == Sense::Along { vertex } else { loops.previous(vertex) };
    let b_from = if sense == Sense::Along { b.back(loops) } else { b.ahead(loops) };
    let starts_left = in_sector(start, a.ahead(loops), b_from, a.back(loops));
    let first_visits = (a.edge.min(b.edge), a.edge.max(b.edge));
    let (mut p, mut a) = (start, a.edge);
    let mut b = if sense == Sense::Along { b.edge } else { b.incoming(loops) };
    for _ in 0..=2 * loops.len() {
        if work.spend(1).is_break() {
            return false;
        }
        let (a_vertex, b_vertex) = (loops.next(a), b_target(b));
        let (to_a, to_b) = (loops.vertex(a_vertex), loops.vertex(b_vertex));
        let (a_arrives, b_arrives) = (is_between(p, to_a, to_b), is_between(p, to_b, to_a));
        if a_arrives && b_arrives && a_vertex == b_vertex {
            return false;
        }
        let (back, mut b_visit) = (p, b);
        if a_arrives {
            p = to_a;
            a = a_vertex;
        }
        if b_arrives {
            p = to_b;
            b = b_after(b_vertex);
            b_visit = b_vertex;
        }
        let (a_ahead, b_ahead) = (loops.vertex(loops.next(a)), loops.vertex(b_target(b)));
        if same_ray(p, a_ahead, back) || same_ray(p, b_ahead, back) {
            return false;
        }
        if !same_ray(p, a_ahead, b_ahead) {
            // Chains that run against each other begin to share at both ends of the way.
            let counts = sense == Sense::Along || first_visits <= (a.min(b_visit), a.max(b_visit));
            return counts && in_sector(p, a_ahead, b_ahead, back) != starts_left;
        }
    }
    false
}

/// Whether the rays from `p` through `u` and through `v` are the same.
fn same_ray(p: Point, u: Point, v: Point) -> bool {
    orientation(p, u, v) == Orientation::Straight
        && if u.x == p.x { (u.y > p.y) == (v.y > p.y) } else { v.x != p.x && (u.x > p.x) == (v.x > p.x) }
}

/// Whether `u`, on the ray from `p` through `v`, lies no further out than `v`.
fn is_between(p: Point, u: Point, v: Point) -> bool {
    let inside =
        |low: f64, value: f64, high: f64| (low <= value && value <= high) || (high <= value && value <= low);
    inside(p.x, u.x, v.x) && inside(p.y, u.y, v.y)
}

/// Whether the ray from `p` through `x` lies strictly within the sector that turns counter-clockwise from the ray
/// through `from` to the ray through `to`.
fn in_sector(p: Point, from: Point, x: Point, to: Point) -> bool {
    use Orientation::{Left, Right, Straight};
    let (after_from, before_to) = (orientation(p, from, x), orientation(p, x, to));
    match orientation(p, from, to) {
        Left => after_from == Left && before_to == Left,
        Straight => after_from == Left,
        Right => {
            let beyond = after_from == Right && before_to == Right;
            !(beyond || same_ray(p, from, x) || same_ray(p, x, to))
        }
    }
}
