//! Where start and target stand: outside every barrier, or how far inside which.

use crate::Refusal;
use crate::barrier::{Blocker, miter_gauge};
use crate::barriers::Barriers;
use crate::search::End;
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, CornerStyle, Edge, Location, Point, Polygon, Segment, Vector, left_of,
};

/// More edges than this meeting in one end give no more places to stand.
const MOST_NORMALS: usize = 16;

/// The end at `point` as the search sees it.
///
/// # Errors
/// Every barrier that it lies inside of. Cost: linear.
pub(crate) fn stand(barriers: &Barriers<'_>, field: &'static str, point: Point) -> Result<End, Vec<Refusal>> {
    let refusals: Vec<Refusal> = (0..barriers.owner_count())
        .filter_map(|owner| {
            let depth_mm = depth(barriers, owner, point)?;
            Some(Refusal::EndInsideBarrier { field, obstacle: barriers.id(owner).to_owned(), depth_mm })
        })
        .collect();
    if !refusals.is_empty() {
        return Err(refusals);
    }
    let places = places(barriers, point);
    let mut shut_in_by = Vec::new();
    if places.is_empty() {
        shut_in_by.extend(near(barriers, point).iter().map(|blocker| blocker.owner));
        shut_in_by.sort_unstable();
        shut_in_by.dedup();
    }
    Ok(End { point, places, shut_in_by })
}

/// How far `point` lies inside the owner's barrier, if by more than half a contact tolerance.
fn depth(barriers: &Barriers<'_>, owner: usize, point: Point) -> Option<f64> {
    let clearance = barriers.clearance(owner);
    let shape = shape(barriers, owner)?;
    let reach = clearance.asked + CONTACT_TOLERANCE_MM;
    let mitred = matches!(clearance.style, CornerStyle::Miter { .. }) && clearance.asked > 0.0;
    let is_obstacle = owner < barriers.scene.obstacles.len();
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
        let gauge =
            barriers.outlines(owner).filter_map(|outline| miter_gauge(outline.ring, point, clearance));
        clearance.asked - gauge.fold(clearance.asked, f64::min)
    } else {
        clearance.asked - distance()
    };
    (depth > CONTACT_TOLERANCE_MM / 2.0).then_some(depth)
}

fn shape<'a>(barriers: &Barriers<'a>, owner: usize) -> Option<&'a Polygon> {
    match barriers.scene.obstacles.get(owner) {
        Some(obstacle) => Some(&obstacle.shape),
        None => barriers.scene.work_area.as_ref(),
    }
}

/// The point itself; on the border of what is planned at one contact tolerance, the places that far out from it:
/// along the normals of the edges that meet there, and in the corners between two of them.
fn places(barriers: &Barriers<'_>, point: Point) -> Vec<Point> {
    if is_clear(barriers, point) {
        return vec![point];
    }
    let normals = border_normals(barriers, point);
    let corners = normals.iter().enumerate().flat_map(|(i, a)| {
        normals[i + 1..].iter().filter_map(move |b| {
            let opening = 1.0 + a.dot(b);
            (opening > 1e-6).then(|| (a + b) / opening)
        })
    });
    let mut places: Vec<Point> = Vec::new();
    for by in normals.iter().copied().chain(corners) {
        let place = point + by * CONTACT_TOLERANCE_MM;
        if !places.contains(&place) && is_clear(barriers, place) && is_beside(barriers, point, place) {
            places.push(place);
        }
    }
    places
}

/// Outward normals of the edges at `point`, without repeats.
fn border_normals(barriers: &Barriers<'_>, point: Point) -> Vec<Vector> {
    let mut normals: Vec<Vector> = Vec::new();
    let mut add = |normal: Vector| {
        if normals.len() < MOST_NORMALS && !normals.iter().any(|known| (known - normal).norm() < 1e-9) {
            normals.push(normal);
        }
    };
    for blocker in near(barriers, point) {
        match blocker.edge {
            Edge::Segment(_) => add(-left_of(blocker.edge.direction_at(0.0))),
            Edge::Arc(arc) => {
                if let Some(spoke) = (point - arc.center).try_normalize(0.0) {
                    add(spoke * arc.sweep.signum());
                }
            }
        }
    }
    normals
}

/// Blockers that `point` lies nearer to than a contact tolerance and that are planned at it.
fn near(barriers: &Barriers<'_>, point: Point) -> Vec<Blocker> {
    let here = Edge::Segment(Segment::new(point, point));
    let touches = |blocker: &&Blocker| {
        blocker.limit <= CONTACT_TOLERANCE_MM && blocker.edge.distance_to_point(point) < CONTACT_TOLERANCE_MM
    };
    barriers.whole.near(&here).filter(touches).copied().collect()
}

/// Whether a planned path may pass `place`.
fn is_clear(barriers: &Barriers<'_>, place: Point) -> bool {
    let here = Edge::Segment(Segment::new(place, place));
    barriers.whole.blocking(&here).next().is_none()
}

/// Whether `place` lies beside `point` on the free side: outside of all material, with nothing between them but
/// what meets in `point` itself.
fn is_beside(barriers: &Barriers<'_>, point: Point, place: Point) -> bool {
    let between = Edge::Segment(Segment::new(point, place));
    let parted = barriers.whole.near(&between).any(|blocker| {
        blocker.edge.distance_to_point(point) >= CONTACT_TOLERANCE_MM
            && blocker.edge.distance(&between) == 0.0
    });
    !parted && (0..barriers.owner_count()).all(|owner| depth(barriers, owner, place).is_none())
}
