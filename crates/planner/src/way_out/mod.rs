//! Straight ways out of the barriers that an end lies in, as after a cut along a contour.
//!
//! **What is a way out.** A straight segment from the end to where it is clear of every barrier. On the way it keeps
//! what the end has: it enters no barrier that the end lies outside of, and of each barrier that the end lies in it does
//! not enter the smaller one on whose border the end lies: it comes nearer to no obstacle than the end is. So it crosses
//! no obstacle, however thin.
//!
//! **The shortest one.** Let F be what is clear and V what straight legal segments reach. A point of F ∩ V that is
//! locally nearest to the end is (1) the foot of a perpendicular on a piece of a barrier's border, or (2) where two pieces
//! cross, if it lies inside V; on V's border it is (3) where a ray that touches a smaller barrier crosses a border, or
//! again (2), since what ends a ray is itself a barrier's border. All three kinds are listed as far as they lie within a
//! distance, nearest first, and the first that holds is the answer; if none does, the distance doubles. Candidates that
//! are none do no harm: each is tested.
//!
//! Cost: quadratic in the border's pieces that are nearer to the end than the answer; mostly a handful.

mod border;
mod candidates;
mod legal;

use crate::barriers::Barriers;
use border::pieces_near;
pub(crate) use border::{barrier_border, crossings, crossings_with_ray};
use candidates::{feet, further};
use legal::Legal;
use std::collections::BTreeSet;
use traverse_geometry::{CornerStyle, EndRule, MITER_RATIO_LIMIT, Point, Vector};
use traverse_solve::{Budget, Interrupt};

/// Ways out longer than a piece's distance by less than this go to it all the same, millimetres: rounding.
const ROUNDING_MM: f64 = 1e-9;

/// Why there is no way out.
pub(crate) struct ShutIn {
    /// Whose barrier the end lies in.
    pub(crate) by: usize,
    pub(crate) why: &'static str,
}

/// Where the way out of the barriers `inside` (owners and depths, at least one) ends that `rule` asks for.
///
/// # Errors
/// The budget ended; within, that there is none.
pub(crate) fn way_out(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    inside: &[(usize, f64)],
    point: Point,
    rule: &EndRule,
    budget: &Budget,
) -> Result<Result<Point, ShutIn>, Interrupt> {
    let buried = inside.iter().find(|&&(owner, depth)| depth > barriers.clearance(owner).asked + ROUNDING_MM);
    if let Some(&(by, _)) = buried {
        return Ok(Err(ShutIn { by, why: "it lies inside the obstacle itself, or outside the work area" }));
    }
    let legal = Legal::new(barriers, left_out, inside, point);
    let (found, why) = match rule {
        EndRule::Refuse => (None, "none is asked for"),
        EndRule::Nearest => {
            let why = "every straight way crosses an obstacle, enters another barrier or comes nearer to what it leaves";
            (nearest(&legal, budget)?, why)
        }
        EndRule::Direction(direction) => {
            let why = "the way in the direction given crosses an obstacle, enters another barrier or comes nearer to what \
                       it leaves";
            (along(&legal, direction.normalize(), budget)?, why)
        }
    };
    let deepest = inside.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |&(owner, _)| owner);
    Ok(found.ok_or(ShutIn { by: deepest, why }))
}

/// The end of the shortest way out.
fn nearest(legal: &Legal<'_>, budget: &Budget) -> Result<Option<Point>, Interrupt> {
    let farthest = farthest(legal);
    let mut within = legal.inside.iter().map(|&(_, depth)| 2.0 * depth).fold(0.0, f64::max);
    loop {
        let pieces = pieces_near(legal, within, budget)?;
        let by_foot = first(legal, feet(legal.point, &pieces, within), budget)?;
        let limit = by_foot.map_or(within, |foot| (foot - legal.point).norm());
        let further = further(legal, &pieces, limit, budget)?;
        if let Some(found) = first(legal, further, budget)?.or(by_foot) {
            return Ok(Some(found));
        }
        if within > farthest {
            return Ok(None);
        }
        within *= 2.0;
    }
}

/// The nearest of the candidates that a way out can end at.
fn first(legal: &Legal<'_>, mut candidates: Vec<Point>, budget: &Budget) -> Result<Option<Point>, Interrupt> {
    let distance = |p: &Point| (p - legal.point).norm();
    let place = |a: &Point, b: &Point| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    candidates.sort_by(|a, b| distance(a).total_cmp(&distance(b)).then_with(|| place(a, b)));
    for candidate in candidates {
        budget.check(0)?;
        if legal.is_clear(candidate) && legal.reaches(candidate) {
            return Ok(Some(candidate));
        }
    }
    Ok(None)
}

/// The end of the way out in a direction.
fn along(legal: &Legal<'_>, direction: Vector, budget: &Budget) -> Result<Option<Point>, Interrupt> {
    let pieces = pieces_near(legal, f64::INFINITY, budget)?;
    let mut ways: Vec<f64> = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        if i.is_multiple_of(4096) {
            budget.check(0)?;
        }
        crossings_with_ray(&piece.edge, legal.point, direction, &mut ways);
    }
    ways.sort_by(f64::total_cmp);
    for way in ways {
        budget.check(0)?;
        let end = legal.point + direction * way;
        if !legal.is_clear(end) {
            continue;
        }
        // What stops a way stops every longer one.
        return Ok(legal.reaches(end).then_some(end));
    }
    Ok(None)
}

/// No way out is longer than this, millimetres.
fn farthest(legal: &Legal<'_>) -> f64 {
    let scene = legal.barriers.scene;
    let ratio = match scene.corner_style {
        CornerStyle::Round => 1.0,
        CornerStyle::Miter { limit } => limit.unwrap_or(MITER_RATIO_LIMIT),
    };
    let reach = |&(owner, _): &(usize, f64)| {
        let bounds = legal.barriers.shape(owner).map(traverse_geometry::Polygon::bounds);
        let size = bounds.map_or(0.0, |bounds| (bounds.max - bounds.min).norm());
        size + 2.0 * ratio * legal.barriers.clearance(owner).asked
    };
    legal.inside.iter().map(reach).fold(0.0, f64::max)
}
