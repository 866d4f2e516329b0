//! What keeps start or target from every place at which a tool may be changed.

use crate::Stats;
use crate::barriers::Barriers;
use crate::prepared::LinksAtLast;
use crate::search::End;
use crate::separating::separating;
use crate::shortest_route::ShortestRoute;
use crate::standing::stand;
use std::collections::BTreeSet;
use traverse_geometry::Point;
use traverse_solve::{Budget, Interrupt, Silent};

/// Owners of the barriers that part start from the spot nearest to it, and target from the one nearest to that; where
/// both are reached, those that part start from target. `left_out`: what the moves to the place and on pass over.
///
/// # Errors
/// The budget ended.
pub(super) fn parted(
    barriers: &Barriers<'_>,
    left_out: &[BTreeSet<usize>; 2],
    clear: [Point; 2],
    spots: &[Point],
    budget: &Budget,
    stats: &mut Stats,
) -> Result<BTreeSet<usize>, Interrupt> {
    let mut owners = BTreeSet::new();
    for side in 0..2 {
        let end = stand(barriers, &left_out[side], clear[side], budget)?;
        let distance = |p: &Point| (p - clear[side]).norm();
        let Some(&nearest) = spots.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
            continue;
        };
        let spot = stand(barriers, &left_out[side], nearest, budget)?;
        owners.extend(between(barriers, &left_out[side], [&end, &spot], budget, stats)?);
    }
    if owners.is_empty() {
        // What both moves pass over is in neither's way.
        let both: BTreeSet<usize> = left_out[0].intersection(&left_out[1]).copied().collect();
        let start = stand(barriers, &both, clear[0], budget)?;
        let target = stand(barriers, &both, clear[1], budget)?;
        owners.extend(between(barriers, &both, [&start, &target], budget, stats)?);
    }
    Ok(owners)
}

/// Owners that part two ends; none where a path leads from one to the other.
fn between(
    barriers: &Barriers<'_>,
    left_out: &BTreeSet<usize>,
    ends: [&End; 2],
    budget: &Budget,
    stats: &mut Stats,
) -> Result<Vec<usize>, Interrupt> {
    for end in ends {
        if end.places.is_empty() {
            return Ok(end.shut_in_by.clone());
        }
    }
    if ends[0].point == ends[1].point {
        return Ok(Vec::new());
    }
    let (found, _) = LinksAtLast.shortest(barriers, left_out, ends, stats, budget, &mut Silent);
    if found?.is_some() {
        return Ok(Vec::new());
    }
    separating(barriers, left_out, ends[0], ends[1], budget, stats)
}
