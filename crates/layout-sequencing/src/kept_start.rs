//! A start for sections that slide freely: the best order found while order is kept.
//!
//! Slid freely an order is never longer than kept, and local search is the faster where it is kept: what a change does
//! there is seen from what stands near.

use crate::improvement::Improvement;
use crate::instance::Instance;
use crate::places::Places;
use crate::placing::Placing;
use crate::progress::Progress;
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Interrupt, Seed, Silent};

/// Rounds without a shorter layout after which it rests.
const PATIENCE: u32 = 2;

/// What local search made of these items while order is kept, and its iterations. An interrupt ends it; the best so far
/// counts.
pub(crate) fn improve_kept(
    free: &Instance,
    items: &[usize],
    seed: Seed,
    budget: &Budget,
) -> Result<(Vec<usize>, u64), Interrupt> {
    let mut kept = free.clone();
    kept.rule = SlideRule::KeepOrder;
    let mut silent = Silent;
    let mut progress = Progress::new(&kept, None, &mut silent);
    progress.offer(items, Placing::of(&kept, items, budget)?.length());
    let mut improvement = Improvement::new(&kept, seed, budget)?;
    let mut places = Places::default();
    let mut idle = 0;
    while idle < PATIENCE {
        match improvement.round(&mut progress, &mut places, budget) {
            Ok(true) => idle = 0,
            Ok(false) => idle += 1,
            Err(_) => break,
        }
    }
    let best = progress.best().map_or(vec![], |(items, _)| items.to_vec());
    Ok((best, progress.iterations()))
}
