//! Whether two straight chains that meet in a point pass through each other there. Exact.
//!
//! Where chains meet without a proper crossing of two edges, the sides on which they come and go decide: round a
//! common point the four ways out interleave, or, where they share a way, the chains part to the other side than
//! they came from. A chain that turns back on itself within a shared way (an antenna) has no side; it is taken
//! as touching. Cost: constant, and linear in the count of edges that the chains share.

use crate::box_tree::Work;
use crate::loops::Loops;
use crate::{Orientation, Point, orientation};
use std::ops::ControlFlow;

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
/// there in the direction of `a`. All edges at both visits are straight.
pub(crate) fn pass_through(loops: &Loops, p: Point, a: Visit, b: Visit, work: &mut Work) -> bool {
    let (a_back, a_ahead) = (a.back(loops), a.ahead(loops));
    let (b_back, b_ahead) = (b.back(loops), b.ahead(loops));
    if same_ray(p, a_back, a_ahead) || same_ray(p, b_back, b_ahead) {
        return false;
    }
    let forth = same_ray(p, a_ahead, b_ahead);
    let against = same_ray(p, a_ahead, b_back);
    let behind = same_ray(p, a_back, b_back) || same_ray(p, a_back, b_ahead);
    match (forth || against, behind) {
        (false, false) => in_sector(p, a_ahead, b_back, a_back) != in_sector(p, a_ahead, b_ahead, a_back),
        // The shared way begins here, as seen by `a`.
        (true, false) => {
            let b_from = if forth { b_back } else { b_ahead };
            let starts_left = in_sector(p, a_ahead, b_from, a_back);
            ends_left(loops, p, a.edge, b, forth, work).is_some_and(|left| left != starts_left)
        }
        // In the middle of a shared way or at its end: decided from where it begins.
        (_, true) => false,
    }
}

/// Follows the shared way from `p` along edge `a` and says whether `b` leaves it to the left of `a`. None: it ends
/// in an antenna.
fn ends_left(
    loops: &Loops,
    mut p: Point,
    mut a: usize,
    b: Visit,
    forth: bool,
    work: &mut Work,
) -> Option<bool> {
    let mut b = if forth { b.edge } else { b.incoming(loops) };
    // `b` runs along its edge when `forth`, against it otherwise.
    let b_target = |edge: usize| if forth { loops.next(edge) } else { edge };
    for _ in 0..=2 * loops.len() {
        if let ControlFlow::Break(()) = work.spend(1) {
            return None;
        }
        let (a_vertex, b_vertex) = (loops.next(a), b_target(b));
        let (to_a, to_b) = (loops.vertex(a_vertex), loops.vertex(b_vertex));
        let (a_arrives, b_arrives) = (is_between(p, to_a, to_b), is_between(p, to_b, to_a));
        if a_arrives && b_arrives && a_vertex == b_vertex {
            return None;
        }
        let back = p;
        if a_arrives {
            p = to_a;
            a = a_vertex;
        }
        if b_arrives {
            p = to_b;
            b = if forth { b_vertex } else { loops.previous(b_vertex) };
        }
        let (a_ahead, b_ahead) = (loops.vertex(loops.next(a)), loops.vertex(b_target(b)));
        if same_ray(p, a_ahead, back) || same_ray(p, b_ahead, back) {
            return None;
        }
        if !same_ray(p, a_ahead, b_ahead) {
            return Some(in_sector(p, a_ahead, b_ahead, back));
        }
    }
    None
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
            let on_border = same_ray(p, from, x) || same_ray(p, x, to);
            !on_border && !(after_from == Right && before_to == Right)
        }
    }
}
