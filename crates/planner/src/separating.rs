//! Which obstacles part start from target.

use crate::Stats;
use crate::barriers::{Barriers, WORK_AREA};
use crate::search::{End, Known, Search};
use std::collections::BTreeSet;
use traverse_solve::{Budget, Interrupt, Silent};

/// Leaves out of `parting`, which parts start from target, every owner without which the others still do; the
/// work area's border is left out of the answer. What remains is in the order of the scene, and none of it can be
/// left out. Cost: one search per owner.
///
/// # Errors
/// The budget ended.
pub(crate) fn separating(
    barriers: &Barriers<'_>,
    parting: BTreeSet<usize>,
    start: &End,
    target: &End,
    budget: &Budget,
    stats: &mut Stats,
) -> Result<Vec<usize>, Interrupt> {
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
