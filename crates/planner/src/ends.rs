//! Ends of a move: where they are clear of every barrier at their own heights.

use crate::barriers::Barriers;
use crate::level::passed_over;
use crate::standing::depths;
use crate::way_out::{ShutIn, way_out};
use crate::{RapidMove, Refusal};
use std::collections::BTreeSet;
use traverse_geometry::{EndRule, Point, RapidRules};
use traverse_solve::{Budget, Interrupt};

/// Where a move begins and ends once it is clear of barriers.
pub(crate) type ClearEnds = [Point; 2];

/// Where start and target are clear: themselves, or where their ways out end.
///
/// # Errors
/// The budget ended; within, every end that is not clear and has no way out.
pub(crate) fn clear_ends(
    barriers: &Barriers<'_>,
    query: &RapidMove,
    budget: &Budget,
) -> Result<Result<ClearEnds, Vec<Refusal>>, Interrupt> {
    let heights = query.rules.heights;
    let start_z = heights.map_or(0.0, |rule| rule.start_z_mm);
    let target_z = heights.map_or(0.0, |rule| rule.target_z_mm);
    let rules = &query.rules;
    let end = |field, point, z_mm, rule| clear_end(barriers, rules, field, point, z_mm, rule, budget);
    let start = end("start", query.start, start_z, &rules.leave)?;
    let target = end("target", query.target, target_z, &rules.enter)?;
    Ok(match (start, target) {
        (Ok(start), Ok(target)) => Ok([start, target]),
        (start, target) => Err([start.err(), target.err()].into_iter().flatten().flatten().collect()),
    })
}

/// Where one end, which the planner's refusals call `field`, is clear.
///
/// # Errors
/// As [`clear_ends`].
pub(crate) fn clear_end(
    barriers: &Barriers<'_>,
    rules: &RapidRules,
    field: &'static str,
    point: Point,
    z_mm: f64,
    rule: &EndRule,
    budget: &Budget,
) -> Result<Result<Point, Vec<Refusal>>, Interrupt> {
    let left_out = passed_over(barriers, rules.heights, z_mm);
    let inside = depths(barriers, &left_out, point, budget)?;
    if inside.is_empty() {
        return Ok(Ok(point));
    }
    let name = |owner: usize| barriers.id(owner).to_owned();
    if *rule == EndRule::Refuse {
        let refusal = |(owner, depth_mm)| {
            let obstacle = name(owner);
            Refusal::EndInsideBarrier { field, obstacle, depth_mm }
        };
        return Ok(Err(inside.into_iter().map(refusal).collect()));
    }
    let found = match rules.dog_leg() {
        Some(speeds) if *rule == EndRule::Nearest => {
            let rules = speeds.straight_directions().map(EndRule::Direction);
            shortest_of(barriers, &left_out, &inside, point, &rules, budget)?
        }
        _ => way_out(barriers, &left_out, &inside, point, rule, budget)?,
    };
    Ok(found.map_err(|shut| vec![Refusal::EndShutIn { field, obstacle: name(shut.by), why: shut.why }]))
}

/// The shortest of the ways out by several rules, the first of equals.
fn shortest_of(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    inside: &[(usize, f64)],
    point: Point,
    rules: &[EndRule],
    budget: &Budget,
) -> Result<Result<Point, ShutIn>, Interrupt> {
    let mut best: Option<Result<Point, ShutIn>> = None;
    for rule in rules {
        let found = way_out(barriers, left_out, inside, point, rule, budget)?;
        let is_better = match (&best, &found) {
            (None, _) | (Some(Err(_)), Ok(_)) => true,
            (Some(Ok(best)), Ok(found)) => (found - point).norm() < (best - point).norm(),
            (Some(_), Err(_)) => false,
        };
        if is_better {
            best = Some(found);
        }
    }
    best.map_or_else(|| way_out(barriers, left_out, inside, point, &EndRule::Nearest, budget), Ok)
}
