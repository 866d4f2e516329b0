//! Which obstacles part start from target.

use crate::Stats;
use crate::barriers::{Barriers, WORK_AREA};
use crate::search::{End, Known, Search};
use std::collections::BTreeSet;
use traverse_solve::{Budget, Interrupt, Silent};

/// Obstacles that part start from target where `passed_over` are not there, in the order of the scene; with the work
/// area's border, none of them can be left out. Cost: one search, and one for each barrier that it meets.
///
/// # Errors
/// The budget ended.
pub(crate) fn separating(
    barriers: &Barriers<'_>,
    passed_over: &BTreeSet<usize>,
    start: &End,
    target: &End,
    budget: &Budget,
    stats: &mut Stats,
) -> Result<Vec<usize>, Interrupt> {
    let mut search = Search::new(Known::new(barriers, passed_over), start, target);
    search.run(budget, &mut stats.expanded_nodes, &mut Silent)?;
    let parting: BTreeSet<usize> = search.known.met().collect();
    drop(search);
    let mut left_out: BTreeSet<usize> = barriers.owners().filter(|owner| !parting.contains(owner)).collect();
    for &owner in parting.iter().filter(|&&owner| owner != WORK_AREA) {
        left_out.insert(owner);
        let mut search = Search::new(Known::new(barriers, &left_out), start, target);
        if search.run(budget, &mut stats.expanded_nodes, &mut Silent)?.is_some() {
            left_out.remove(&owner);
        }
    }
    Ok(parting.into_iter().filter(|owner| *owner != WORK_AREA && !left_out.contains(owner)).collect())
}
