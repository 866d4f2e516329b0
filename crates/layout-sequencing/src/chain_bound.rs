//! The bound of a chain through some sections: any two sections stand at least their own offset apart, whatever stands
//! between them, so a layout is no shorter than the shortest path through any of its sections, in any order.
//!
//! Leaving out sections that leave heights uncovered can raise the bound: those around them meet. The sections that reach
//! one height make a chain that is at least as long as their thicknesses. Where sections slide freely offsets count as
//! they are, below 0 too. Which sections to leave out is tried greedily, each trial a path proven by tours.

use crate::height_bound::{heights, least_thickness};
use crate::instance::Instance;
use crate::progress::Progress;
use traverse_solve::{Budget, Interrupt, Seed, Silent};
use traverse_tours::{CostMatrix, Ending, LARGEST_COST, Shape, SolveOptions, TourSpecification, solve};

/// The most kinds and copies for which it is tried.
const MOST_KINDS: usize = 40;
const MOST_COPIES: usize = 60;
/// Steps of tours for one path.
const STEPS: u64 = 2_000;
/// Heights at which chains begin.
const HEIGHTS: usize = 64;

/// Raises the bound by the best chain found. Which kinds are in it, when it is better than that through all.
pub(crate) fn chain_bound(
    instance: &Instance,
    seed: Seed,
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Option<Vec<bool>> {
    if instance.kinds.len() > MOST_KINDS || instance.copies > MOST_COPIES || instance.kinds.len() < 3 {
        return None;
    }
    let mut best = (vec![true; instance.kinds.len()], 0);
    // Interrupted or not, the best chain so far counts.
    let _ = improve(instance, seed, &mut best, progress, budget);
    progress.raise_bound(best.1);
    Some(best.0)
        .filter(|members| members.iter().any(|member| !member) && members.iter().any(|&member| member))
}

fn improve(
    instance: &Instance,
    seed: Seed,
    best: &mut (Vec<bool>, i64),
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<(), Interrupt> {
    let kinds = instance.kinds.len();
    best.1 = length(instance, &best.0, seed, progress, budget)?;
    for y in heights(instance, HEIGHTS) {
        let reach: Vec<bool> = (0..kinds).map(|kind| least_thickness(instance, kind, y).is_some()).collect();
        try_members(instance, reach, seed, best, progress, budget)?;
    }
    let mut better = true;
    while better {
        better = false;
        for kind in 0..kinds {
            let mut members = best.0.clone();
            members[kind] = !members[kind];
            better |= try_members(instance, members, seed, best, progress, budget)?;
        }
    }
    Ok(())
}

fn try_members(
    instance: &Instance,
    members: Vec<bool>,
    seed: Seed,
    best: &mut (Vec<bool>, i64),
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<bool, Interrupt> {
    if members == best.0 {
        return Ok(false);
    }
    let bound = length(instance, &members, seed, progress, budget)?;
    let better = bound > best.1;
    if better {
        *best = (members, bound);
    }
    Ok(better)
}

/// A bound of the shortest chain through the members.
fn length(
    instance: &Instance,
    members: &[bool],
    seed: Seed,
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<i64, Interrupt> {
    budget.check(progress.iterations())?;
    let kinds: Vec<usize> = (0..members.len()).filter(|&kind| members[kind]).collect();
    if kinds.is_empty() {
        return Ok(0);
    }
    let number = |kind: usize| kinds.iter().position(|&member| member == kind);
    let costs = kinds.iter().flat_map(|&left| kinds.iter().map(move |&right| (left, right)));
    let longest = progress.upper().min(instance.sum_of_reaches());
    let costs: Vec<i64> = costs.map(|(left, right)| instance.chain_cost(left, right, longest)).collect();
    // What tours can't take is counted in a coarser unit, rounded down.
    let largest = costs.iter().map(|cost| cost.unsigned_abs()).max().unwrap_or(0);
    let unit = largest.div_ceil(LARGEST_COST as u64).max(1) as i64;
    let costs = costs.into_iter().map(|cost| cost.div_euclid(unit)).collect();
    let Ok(costs) = CostMatrix::new(kinds.len(), costs) else { return Ok(0) };
    let pairs = instance.all_precedences().filter_map(|(a, b)| Some((number(a)?, number(b)?)));
    let mut precedence: Vec<(usize, usize)> = pairs.collect();
    precedence.sort_unstable();
    let specification = TourSpecification {
        costs,
        quantities: kinds.iter().map(|&kind| instance.quantity(kind) as u32).collect(),
        shape: Shape::Path,
        first: instance.first.and_then(number),
        last: instance.last.and_then(number),
        precedence,
    };
    // Where one kind is all that is left, it comes first and last.
    let options = SolveOptions { seed, threads: 1, ..SolveOptions::default() };
    let limited = Budget { iterations: Some(STEPS), ..budget.clone() };
    let width = |kind: usize| instance.items[instance.kinds[kind].items.start].width;
    let widths: i64 = kinds.iter().map(|&kind| width(kind) * instance.quantity(kind) as i64).sum();
    match solve(&specification, &options, &limited, &mut Silent) {
        Ok(answer) => {
            progress.add_iterations(answer.iterations + 1);
            if answer.ending == Ending::ProvenInfeasible {
                return Ok(0);
            }
            Ok(answer.lower_bound.saturating_mul(unit).saturating_add(widths))
        }
        Err(_) => Ok(0),
    }
}
