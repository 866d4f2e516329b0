//! Where rings cross themselves or each other, and whether they touch.
//!
//! Candidates are the pairs of edges whose boxes meet, found by a [`BoxTree`] in the frame that most edges run along;
//! straight edges are decided exactly, circular ones within [`CONTACT_TOLERANCE_MM`]. Cost: O(n log n) for rings
//! whose edges lie apart; bounded by [`CROSSING_WORK_LIMIT`] for all others.

use crate::arc_crossing::{common_points, deep_crossing, leave_in_turns};
use crate::box_tree::{BoxTree, Work};
use crate::chain_crossing::{Visit, pass_through};
use crate::loops::Loops;
use crate::{
    CONTACT_TOLERANCE_MM, CROSSING_WORK_LIMIT, Edge, FINDINGS_LIMIT, Orientation, Point, Segment, cross,
    orientation,
};
use std::ops::ControlFlow;

/// What an exact test of two edges costs, in box tests.
const PAIR_WORK: u64 = 16;

/// Boxes are grown by at least this, millimetres: more than turning a point within the coordinate limit loses.
const BOX_MARGIN_MM: f64 = 2e-9;

/// A tangent that turns back within this (sine of the angle) is a reversal.
const REVERSAL_SINE: f64 = 1e-9;

/// Which pairs of edges are looked at.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Between {
    /// Edges of the same ring.
    OneRing,
    /// Edges of different rings.
    Rings,
}

/// Two edges whose chains cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Edge numbers in the loops, the smaller one first.
    pub(crate) edges: (usize, usize),
    pub(crate) at: Point,
}

/// What the search found.
#[derive(Default)]
pub(crate) struct Crossings {
    /// By edge numbers; at most [`FINDINGS_LIMIT`].
    pub(crate) found: Vec<Crossing>,
    /// Whether the search was broken off because the list was full.
    pub(crate) list_full: bool,
    /// Whether the search was broken off because it took too much work.
    pub(crate) too_much_work: bool,
    /// Whether any two edges touch that do not follow each other, or a chain turns back on itself.
    pub(crate) contact: bool,
}

impl Crossings {
    /// Every crossing `between` rings, as long as `go_on` says so.
    pub(crate) fn of(loops: &Loops, between: Between, go_on: &dyn Fn() -> bool) -> Self {
        let direction = loops.main_direction();
        let margin = if loops.has_arcs() { CONTACT_TOLERANCE_MM } else { BOX_MARGIN_MM };
        let boxes: Vec<_> = (0..loops.len()).map(|k| loops.bounds_along(k, direction, margin)).collect();
        let tree = BoxTree::new(&boxes, go_on);
        drop(boxes);
        let mut crossings = Self::default();
        let mut work = Work::new(CROSSING_WORK_LIMIT, go_on);
        let outcome = tree.pairs(&mut work, &mut |work, a, b| {
            if (loops.chain(a) == loops.chain(b)) != (between == Between::OneRing) {
                return ControlFlow::Continue(());
            }
            work.spend(PAIR_WORK)?;
            let (a, b) = (a.min(b), a.max(b));
            if let Some(at) = crossings.look_at(loops, a, b, work) {
                crossings.contact = true;
                crossings.found.push(Crossing { edges: (a, b), at });
                if crossings.found.len() >= FINDINGS_LIMIT {
                    crossings.list_full = true;
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        crossings.too_much_work = work.is_spent() || (outcome.is_break() && !crossings.list_full);
        crossings.found.sort_by_key(|crossing| crossing.edges);
        crossings
    }

    /// Where the chains of two edges cross on them; notes contact on the way.
    fn look_at(&mut self, loops: &Loops, a: usize, b: usize, work: &mut Work<'_>) -> Option<Point> {
        if loops.is_straight(a) && loops.is_straight(b) {
            self.look_at_straight(loops, a, b, work)
        } else {
            self.look_at_curved(loops, a, b)
        }
    }

    fn look_at_straight(&mut self, loops: &Loops, a: usize, b: usize, work: &mut Work<'_>) -> Option<Point> {
        use Orientation::Straight;
        let (p, q) = (loops.vertex(a), loops.vertex(loops.next(a)));
        let (r, s) = (loops.vertex(b), loops.vertex(loops.next(b)));
        let follows = loops.next(a) == b || loops.next(b) == a;
        let (at_r, at_s) = (orientation(p, q, r), orientation(p, q, s));
        if follows && (at_r != Straight || at_s != Straight) {
            return None;
        }
        if at_r == at_s && at_r != Straight {
            return None;
        }
        let (at_p, at_q) = (orientation(r, s, p), orientation(r, s, q));
        if at_p == at_q && at_p != Straight {
            return None;
        }
        if [at_p, at_q, at_r, at_s].iter().all(|&side| side != Straight) {
            return Some(straight_crossing(p, q, r, s));
        }
        let (first, second) = (Segment::new(p, q), Segment::new(r, s));
        if !first.bounds().meets(&second.bounds()) {
            return None;
        }
        let on = |segment: &Segment, point: Point, side: Orientation| {
            side == Straight
                && point != segment.start
                && point != segment.end
                && segment.bounds().contains(point)
        };
        let (p_on, r_on) = (on(&second, p, at_p), on(&first, r, at_r));
        self.contact |= !follows || p_on || r_on || on(&second, q, at_q) || on(&first, s, at_s) || q == s;
        let meetings = [
            (p == r).then_some((p, true, true)),
            p_on.then_some((p, true, false)),
            r_on.then_some((r, false, true)),
        ];
        meetings.into_iter().flatten().find_map(|(at, a_start, b_start)| {
            let visits = (Visit { edge: a, at_start: a_start }, Visit { edge: b, at_start: b_start });
            chains_cross(loops, at, visits.0, visits.1, work).then_some(at)
        })
    }

    fn look_at_curved(&mut self, loops: &Loops, a: usize, b: usize) -> Option<Point> {
        let (first, second) = (loops.edge(a), loops.edge(b));
        let near = |p: Point, q: Point| (p - q).norm() <= CONTACT_TOLERANCE_MM;
        let follows = loops.next(a) == b || loops.next(b) == a;
        if !follows {
            if first.distance(&second) > CONTACT_TOLERANCE_MM {
                return None;
            }
            self.contact = true;
        } else if !self.contact {
            self.contact = (loops.next(a) == b && touch_after_joint(&first, &second))
                || (loops.next(b) == a && touch_after_joint(&second, &first));
        }
        if let Some(at) = deep_crossing(&first, &second) {
            return Some(at);
        }
        let on = |edge: &Edge, p: Point| {
            !near(p, edge.start())
                && !near(p, edge.end())
                && edge.distance_to_point(p) <= CONTACT_TOLERANCE_MM
        };
        let (p, r) = (first.start(), second.start());
        let meetings = [
            near(p, r).then_some((p, true, true)),
            on(&second, p).then_some((p, true, false)),
            on(&first, r).then_some((r, false, true)),
        ];
        meetings.into_iter().flatten().find_map(|(at, a_start, b_start)| {
            let (a, b) = (Visit { edge: a, at_start: a_start }, Visit { edge: b, at_start: b_start });
            leave_in_turns(loops, at, a, b).then_some(at)
        })
    }
}

fn chains_cross(loops: &Loops, at: Point, a: Visit, b: Visit, work: &mut Work<'_>) -> bool {
    let straight = |visit: Visit| loops.is_straight(visit.edge) && loops.is_straight(visit.incoming(loops));
    if straight(a) && straight(b) {
        pass_through(loops, at, a, b, work)
    } else {
        leave_in_turns(loops, at, a, b)
    }
}

/// Whether `next`, which begins where `edge` ends, turns back along it or touches it anywhere else. At least one of
/// them is circular.
fn touch_after_joint(edge: &Edge, next: &Edge) -> bool {
    let (arriving, leaving) = (edge.direction_at(1.0), next.direction_at(0.0));
    if arriving.dot(&leaving) < 0.0 && cross(arriving, leaving).abs() <= REVERSAL_SINE {
        return true;
    }
    let joint = edge.end();
    let elsewhere = |p: Point| {
        let way = edge.nearest_point(nalgebra::center(&p, &joint));
        (p - joint).norm() > CONTACT_TOLERANCE_MM && next.distance_to_point(way) > CONTACT_TOLERANCE_MM
    };
    let ring_of_two = edge.start() == next.end();
    let ends = [(edge.start(), next), (next.end(), edge)];
    common_points(edge, next)
        .into_iter()
        .filter(|&p| !ring_of_two || (p - edge.start()).norm() > CONTACT_TOLERANCE_MM)
        .any(elsewhere)
        || (!ring_of_two
            && ends
                .into_iter()
                .any(|(p, other)| other.distance_to_point(p) <= CONTACT_TOLERANCE_MM && elsewhere(p)))
}

/// Where two straight edges cross that are known to cross properly.
fn straight_crossing(p: Point, q: Point, r: Point, s: Point) -> Point {
    let (along, across) = (q - p, s - r);
    let fraction = cross(r - p, across) / cross(along, across);
    if fraction.is_finite() { p + along * fraction.clamp(0.0, 1.0) } else { p }
}
