//! Where start and target stand: outside every barrier, or how far inside which.

use crate::barrier::miter_gauge;
use crate::barriers::Barriers;
use crate::places::{is_clear, places, touching};
use crate::search::End;
use std::collections::BTreeSet;
use traverse_geometry::{CONTACT_TOLERANCE_MM, CornerStyle, Location, Point};
use traverse_solve::{Budget, Interrupt};

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
pub(crate) fn is_known_clear(barriers: &Barriers<'_>, point: Point, budget: &Budget) -> bool {
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
    let touching = touching(barriers, left_out, point);
    // On the border of what keeps no distance: no deeper than contact.
    let is_on_border = |owner: usize| {
        let mut blockers = touching.iter().filter(|blocker| blocker.owner == owner);
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
    let places = places(barriers, left_out, point, budget)?;
    let mut shut_in_by = Vec::new();
    if places.is_empty() {
        shut_in_by.extend(touching(barriers, left_out, point).iter().map(|blocker| blocker.owner));
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
