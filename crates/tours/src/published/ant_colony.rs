//! An ant colony (Dorigo, Maniezzo, Colorni 1996): ants build tours arc by arc, drawn to cheap arcs and to those that
//! good tours of earlier ants have used; what was laid evaporates. O(n²) for an ant.

use crate::assignment_search::Incumbent;
use crate::cost::Costs;
use crate::local_search::cycle_cost;
use crate::work::Work;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use traverse_solve::{Interrupt, Seed};

/// Ants of one round, and rounds until the colony rests.
const ANTS: usize = 20;
const ROUNDS: usize = 500;
/// What of the trail is left after a round.
const STAYS: f64 = 0.9;
/// How much cheapness counts beside the trail.
const CHEAPNESS: i32 = 3;

/// Lets a colony work; every tour is offered.
pub(super) fn search(
    costs: &impl Costs,
    seed: Seed,
    incumbent: &mut dyn Incumbent,
    work: &mut Work<'_>,
) -> Result<(), Interrupt> {
    let size = costs.size();
    let mut chance = seed.stream();
    let mean = (0..size * size)
        .map(|at| costs.cost(at / size, at % size) as f64 / (size * size) as f64)
        .sum::<f64>();
    let cheap =
        |from: usize, to: usize| (1.0 / (1.0 + costs.cost(from, to) as f64 / (mean + 1.0))).powi(CHEAPNESS);
    let mut trail = vec![1.0; size * size];
    let mut best: Option<(Vec<usize>, i64)> = None;
    for _ in 0..ROUNDS {
        for _ in 0..ANTS {
            work.step()?;
            let tour = walk(size, |from, to| trail[from * size + to] * cheap(from, to), &mut chance, work)?;
            let cost = cycle_cost(costs, &tour);
            incumbent.offer(&tour, 0);
            if best.as_ref().is_none_or(|best| cost < best.1) {
                best = Some((tour, cost));
            }
        }
        trail.iter_mut().for_each(|trail| *trail = (*trail * STAYS).max(0.01));
        if let Some((tour, _)) = &best {
            for (at, &from) in tour.iter().enumerate() {
                trail[from * size + tour[(at + 1) % size]] += 1.0 - STAYS;
            }
        }
    }
    Ok(())
}

/// One ant's tour.
fn walk(
    size: usize,
    pull: impl Fn(usize, usize) -> f64,
    chance: &mut Xoshiro256PlusPlus,
    work: &Work<'_>,
) -> Result<Vec<usize>, Interrupt> {
    let mut left: Vec<usize> = (0..size).collect();
    let mut at = left.swap_remove(chance.random_range(0..size));
    let mut tour = vec![at];
    let mut pulls = vec![];
    while !left.is_empty() {
        work.breathe()?;
        pulls.clear();
        pulls.extend(left.iter().map(|&to| pull(at, to)));
        let mut drawn = chance.random_range(0.0..1.0) * pulls.iter().sum::<f64>();
        let chosen = pulls.iter().position(|pull| {
            drawn -= pull;
            drawn <= 0.0
        });
        at = left.swap_remove(chosen.unwrap_or(left.len() - 1));
        tour.push(at);
    }
    Ok(tour)
}
