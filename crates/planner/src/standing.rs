//! Where start and target stand: outside every barrier, or how far inside which.

use crate::barrier::{Blocker, miter_gauge};
use crate::barriers::Barriers;
use crate::search::End;
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, CornerStyle, Edge, Location, Point, Segment, left_of, positive_angle, unit,
};
use traverse_solve::{Budget, Interrupt};

/// An edge's end nearer than this to the point that it touches gives no direction, in contact tolerances.
const SHORT_EDGE: f64 = 10.0;

/// Sine of half the opening below which a wedge is too narrow to stand in: 0.01 degrees.
const NARROW_WEDGE: f64 = 1e-4;

/// Every barrier that `point` lies inside of: owner and depth, millimetres. `left_out` is taken for not there.
///
/// # Errors
/// The budget ended. Cost: linear in the barriers that it may lie in; in a prepared scene mostly constant.
pub(crate) fn depths(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    point: Point,
    budget: &Budget,
) -> Result<Vec<(usize, f64)>, Interrupt> {
    if left_out.is_empty() && is_known_clear(barriers, point, budget) {
        return Ok(Vec::new());
    }
    depths_one_by_one(barriers, left_out, point, budget)
}

/// Whether `point` is known to lie clear of every barrier; says nothing where it is not.
fn is_known_clear(barriers: &Barriers<'_>, point: Point, budget: &Budget) -> bool {
    let none = BTreeSet::new();
    barriers.is_known_clear(point, |middle| {
        let depths = depths_one_by_one(barriers, &none, middle, budget).ok()?;
        Some(depths.is_empty() && is_clear(barriers, &none, middle))
    })
}

fn depths_one_by_one(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    point: Point,
    budget: &Budget,
) -> Result<Vec<(usize, f64)>, Interrupt> {
    let mut found = Vec::new();
    let near = near(barriers, left_out, point);
    // On the border of what keeps no distance: no deeper than contact.
    let is_on_border = |owner: usize| {
        let mut blockers = near.iter().filter(|blocker| blocker.owner == owner);
        barriers.clearance(owner).asked == 0.0
            && blockers.any(|blocker| blocker.edge.distance_to_point(point) <= CONTACT_TOLERANCE_MM / 2.0)
    };
    for owner in barriers.owners_at(point).into_iter().filter(|owner| !left_out.contains(owner)) {
        budget.check(0)?;
        if is_on_border(owner) {
            continue;
        }
        found.extend(depth(barriers, owner, point).map(|depth| (owner, depth)));
    }
    Ok(found)
}

/// An end at `point`, which lies inside no barrier, as the search sees it.
///
/// # Errors
/// The budget ended. Cost: as that of [`depths`].
pub(crate) fn stand(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    point: Point,
    budget: &Budget,
) -> Result<End, Interrupt> {
    if left_out.is_empty() && is_known_clear(barriers, point, budget) {
        return Ok(End { point, places: vec![point], shut_in_by: Vec::new() });
    }
    let places = places(barriers, left_out, point, budget)?;
    let mut shut_in_by = Vec::new();
    if places.is_empty() {
        shut_in_by.extend(near(barriers, left_out, point).iter().map(|blocker| blocker.owner));
        shut_in_by.sort_unstable();
        shut_in_by.dedup();
    }
    Ok(End { point, places, shut_in_by })
}

/// How far `point` lies inside the owner's barrier, if by more than half a contact tolerance.
pub(crate) fn depth(barriers: &Barriers<'_>, owner: usize, point: Point) -> Option<f64> {
    let clearance = barriers.clearance(owner);
    let shape = barriers.shape(owner)?;
    let reach = clearance.asked + CONTACT_TOLERANCE_MM;
    let mitred = matches!(clearance.style, CornerStyle::Miter { .. }) && clearance.asked > 0.0;
    let is_obstacle = barriers.obstacle(owner).is_some();
    if is_obstacle && !mitred && !shape.bounds().grown(reach).contains(point) {
        return None;
    }
    let inside = match shape.locate(point) {
        Location::Border => false,
        Location::Inside => is_obstacle,
        Location::Outside => !is_obstacle,
    };
    let distance = || {
        barriers
            .outlines(owner)
            .flat_map(|outline| outline.ring.edges())
            .map(|edge| edge.distance_to_point(point))
            .fold(f64::INFINITY, f64::min)
    };
    let depth = if inside {
        clearance.asked + distance()
    } else if mitred {
        let gauge = barriers.outlines(owner).filter_map(|outline| miter_gauge(&outline, point));
        clearance.asked - gauge.fold(clearance.asked, f64::min)
    } else {
        clearance.asked - distance()
    };
    (depth > CONTACT_TOLERANCE_MM / 2.0).then_some(depth)
}

/// The point itself; on the border of what is planned at one contact tolerance, the places that far out from it, in
/// every wedge between neighbouring edges that meet there: in its corner, or, where it is no corner, off either edge.
fn places(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    point: Point,
    budget: &Budget,
) -> Result<Vec<Point>, Interrupt> {
    if is_clear(barriers, left_out, point) {
        return Ok(vec![point]);
    }
    let rays = border_rays(barriers, left_out, point);
    let mut places: Vec<Point> = Vec::new();
    for (i, &ray) in rays.iter().enumerate() {
        let next = rays[(i + 1) % rays.len()];
        let opening = if rays.len() == 1 { TAU } else { positive_angle(next - ray) };
        let half_sine = (opening / 2.0).sin();
        let offsets = if opening >= PI {
            vec![unit(ray + PI / 2.0), unit(next - PI / 2.0)]
        } else if half_sine > NARROW_WEDGE {
            vec![unit(ray + opening / 2.0) / half_sine]
        } else {
            Vec::new()
        };
        for offset in offsets {
            let place = point + offset * CONTACT_TOLERANCE_MM;
            if is_clear(barriers, left_out, place) && is_beside(barriers, left_out, point, place, budget)? {
                places.push(place);
            }
        }
    }
    Ok(places)
}

/// Directions, ascending, in which edges run off from `point`, radians.
fn border_rays(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, point: Point) -> Vec<f64> {
    let mut rays: Vec<f64> = Vec::new();
    for blocker in near(barriers, left_out, point) {
        let edge = blocker.edge;
        for (end, sense) in [(edge.start(), -1.0), (edge.end(), 1.0)] {
            let away = end - point;
            if away.norm() > SHORT_EDGE * CONTACT_TOLERANCE_MM {
                let direction = match edge {
                    Edge::Segment(_) => away,
                    Edge::Arc(arc) => left_of(point - arc.center) * (arc.sweep.signum() * sense),
                };
                rays.push(positive_angle(direction.y.atan2(direction.x)));
            }
        }
    }
    rays.sort_by(f64::total_cmp);
    rays.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    rays
}

/// Blockers that `point` lies nearer to than a contact tolerance and that are planned at it.
fn near(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, point: Point) -> Vec<Blocker> {
    let here = Segment::new(point, point);
    let touches = |blocker: &Blocker| {
        blocker.limit <= CONTACT_TOLERANCE_MM
            && !left_out.contains(&blocker.owner)
            && blocker.edge.distance_to_point(point) < CONTACT_TOLERANCE_MM
    };
    barriers.near(&here).filter(touches).collect()
}

/// Whether a planned path may pass `place`.
fn is_clear(barriers: &Barriers<'_>, left_out: &BTreeSet<usize>, place: Point) -> bool {
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

/// Whether `place` lies beside `point` on the free side: outside of all material, with nothing between them but
/// what meets in `point` itself.
fn is_beside(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    point: Point,
    place: Point,
    budget: &Budget,
) -> Result<bool, Interrupt> {
    let line = Segment::new(point, place);
    let between = Edge::Segment(line);
    let parted = barriers.near(&line).any(|blocker| {
        !left_out.contains(&blocker.owner)
            && blocker.edge.distance_to_point(point) >= CONTACT_TOLERANCE_MM
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
    Ok(true)
}
