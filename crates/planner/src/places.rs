//! Places: where a planned path may stand for an end.
//!
//! An end may lie nearer to a barrier's edge than paths are planned, by a contact tolerance at most: on the border of what is
//! planned at one contact tolerance, or inside a clearance by rounding of whoever sent it. Tangents from there would miss
//! corners by an angle above every rounding. So a path is planned from the nearest places that keep what is planned, and
//! priced from the end itself.

use crate::barrier::Blocker;
use crate::barriers::Barriers;
use crate::standing::{depth, is_known_clear};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Point, Segment, left_of, positive_angle, unit};
use traverse_solve::{Budget, Interrupt};

/// An edge's end nearer than this to the point that it touches gives no direction, in contact tolerances.
const SHORT_EDGE: f64 = 10.0;

/// Sine of half the opening below which a wedge is too narrow to stand in: 0.01 degrees.
const NARROW_WEDGE: f64 = 1e-4;

/// Directions nearer to each other than this are one, radians.
const SAME_RAY_RAD: f64 = 1e-9;

/// Two edges whose directions differ by less than this sine leave no corner to stand in between them.
const FLAT_CORNER: f64 = 1e-3;

/// The point itself where it keeps what is planned, otherwise the nearest places that do: off the border that it touches,
/// in every wedge between neighbouring edges that meet there, and out of the clearances that it lies in by rounding.
///
/// # Errors
/// The budget ended. Cost: about log n; where edges are touched linear, in a prepared scene mostly constant.
pub(crate) fn places(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    point: Point,
    budget: &Budget,
) -> Result<Vec<Point>, Interrupt> {
    let mut near = near(barriers, left_out, point);
    let mut close = near.iter().filter(|blocker| is_close(blocker, point)).peekable();
    if close.peek().is_none() {
        return Ok(vec![point]);
    }
    let beside = if close.any(is_contact) {
        near.retain(is_contact);
        beside_borders(&near, point)
    } else {
        vec![point]
    };
    // What is clear lies on one side of whatever is near.
    let meets_in_point = if is_clear(barriers, left_out, point) { 0.0 } else { CONTACT_TOLERANCE_MM };
    let mut places: Vec<Point> = Vec::new();
    for beside in beside {
        let place = out_of_clearances(barriers, left_out, beside);
        if is_clear(barriers, left_out, place)
            && is_free_side(barriers, left_out, [point, place], meets_in_point, budget)?
        {
            places.push(place);
        }
    }
    if places.is_empty() && is_clear(barriers, left_out, point) {
        places.push(point);
    }
    Ok(places)
}

/// Whether a planned path may pass `place`.
pub(crate) fn is_clear(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, place: Point) -> bool {
    let mut clear = true;
    barriers.blocking(&Segment::new(place, place), |blocker| {
        if left_out.contains(&blocker.owner) {
            return ControlFlow::Continue(());
        }
        clear = false;
        ControlFlow::Break(())
    });
    clear
}

/// Blockers that `point` lies nearer to than a contact tolerance and that are planned at it.
pub(crate) fn touching(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, point: Point) -> Vec<Blocker> {
    let mut touching = near(barriers, left_out, point);
    touching.retain(is_contact);
    touching
}

/// Whether a blocker is planned at one contact tolerance.
fn is_contact(blocker: &Blocker) -> bool {
    blocker.limit <= CONTACT_TOLERANCE_MM
}

/// The distance that is planned from a blocker's edge, millimetres.
fn planned(blocker: &Blocker) -> f64 {
    blocker.limit + CONTACT_TOLERANCE_MM / 2.0
}

/// Whether `point` lies nearer to a blocker than is planned, by more than rounding.
fn is_close(blocker: &Blocker, point: Point) -> bool {
    let rounding_mm = 16.0 * f64::EPSILON * point.coords.amax().max(1.0);
    blocker.edge.distance_to_point(point) < planned(blocker) - rounding_mm
}

/// Blockers that `point` lies nearer to than is planned.
fn near(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, point: Point) -> Vec<Blocker> {
    let mut found = Vec::new();
    barriers.round(point, CONTACT_TOLERANCE_MM / 2.0, |blocker| {
        if !left_out.contains(&blocker.owner) {
            found.push(*blocker);
        }
    });
    found
}

/// A direction in which edges run off from a point.
#[derive(Clone, Copy, Debug)]
struct Ray {
    angle: f64,
    /// How far to the left of the point these edges lie, the leftmost and the rightmost, millimetres.
    leftmost: f64,
    rightmost: f64,
}

/// Directions, ascending, in which edges run off from `point`.
fn border_rays(touching: &[Blocker], point: Point) -> Vec<Ray> {
    let mut rays: Vec<Ray> = Vec::new();
    for blocker in touching {
        let edge = blocker.edge;
        let on = edge.nearest_point(point) - point;
        for (end, sense) in [(edge.start(), -1.0), (edge.end(), 1.0)] {
            if (end - point).norm() <= SHORT_EDGE * CONTACT_TOLERANCE_MM {
                continue;
            }
            let direction = match edge {
                Edge::Segment(segment) => segment.vector() * sense,
                Edge::Arc(arc) => left_of(point - arc.center) * (arc.sweep.signum() * sense),
            };
            let Some(along) = direction.try_normalize(0.0) else { continue };
            // Beyond its end, an edge is as far to the side as its line.
            let left = match edge {
                Edge::Segment(segment) => left_of(along).dot(&(segment.start - point)),
                Edge::Arc(_) => left_of(along).dot(&on),
            };
            let angle = positive_angle(along.y.atan2(along.x));
            rays.push(Ray { angle, leftmost: left, rightmost: left });
        }
    }
    rays.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    rays.dedup_by(|next, kept| {
        let is_same = (next.angle - kept.angle).abs() < SAME_RAY_RAD;
        if is_same {
            kept.leftmost = kept.leftmost.max(next.leftmost);
            kept.rightmost = kept.rightmost.min(next.rightmost);
        }
        is_same
    });
    rays
}

/// The places one contact tolerance off the edges that `point` touches, in every wedge between neighbours: in its corner, or,
/// where it is no corner, off either edge.
fn beside_borders(touching: &[Blocker], point: Point) -> Vec<Point> {
    let rays = border_rays(touching, point);
    let mut places = Vec::new();
    for (i, &ray) in rays.iter().enumerate() {
        let next = rays[(i + 1) % rays.len()];
        let opening = if rays.len() == 1 { TAU } else { positive_angle(next.angle - ray.angle) };
        let (off_ray, off_next) =
            (CONTACT_TOLERANCE_MM + ray.leftmost, CONTACT_TOLERANCE_MM - next.rightmost);
        if opening >= PI {
            places.push(point + unit(ray.angle + PI / 2.0) * off_ray);
            places.push(point + unit(next.angle - PI / 2.0) * off_next);
            continue;
        }
        let half_sine = (opening / 2.0).sin();
        if half_sine > NARROW_WEDGE {
            places.push(point + unit(ray.angle + opening / 2.0) * (off_ray.max(off_next) / half_sine));
        }
    }
    places
}

/// The place itself, or moved out of the clearances that it lies in by rounding.
fn out_of_clearances(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, place: Point) -> Point {
    let outward = |place: Point| {
        let near = near(barriers, left_out, place).into_iter();
        let worst = near.filter(|blocker| !is_contact(blocker) && is_close(blocker, place));
        let needs = worst.filter_map(|blocker| {
            let away = place - blocker.edge.nearest_point(place);
            let need = planned(&blocker) - away.norm();
            (need <= CONTACT_TOLERANCE_MM).then_some((away.try_normalize(0.0)?, need))
        });
        needs.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let Some((first, need)) = outward(place) else { return place };
    let moved = place + first * need;
    let Some((second, rest)) = outward(moved) else { return moved };
    // In the corner between both: the first need stays met.
    let along = left_of(first);
    let slope = along.dot(&second);
    if slope.abs() < FLAT_CORNER { moved + second * rest } else { moved + along * (rest / slope) }
}

/// Whether `place` lies beside `point` on the free side: outside of all material, with nothing between them but
/// what lies nearer to the point than `meets_in_point`. Nothing blocks it.
fn is_free_side(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    [point, place]: [Point; 2],
    meets_in_point: f64,
    budget: &Budget,
) -> Result<bool, Interrupt> {
    let line = Segment::new(point, place);
    let between = Edge::Segment(line);
    let parted = barriers.near(&line).any(|blocker| {
        !left_out.contains(&blocker.owner)
            && blocker.edge.distance_to_point(point) >= meets_in_point
            && blocker.edge.distance(&between) == 0.0
    });
    if parted {
        return Ok(false);
    }
    if left_out.is_empty() && is_known_clear(barriers, place, budget) {
        return Ok(true);
    }
    for owner in barriers.owners_at(place).into_iter().filter(|owner| !left_out.contains(owner)) {
        budget.check(0)?;
        if depth(barriers, owner, place).is_some() {
            return Ok(false);
        }
    }
    if left_out.is_empty() {
        barriers.note_clear(place);
    }
    Ok(true)
}
