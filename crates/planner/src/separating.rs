//! Which obstacles part start from target.

use crate::Stats;
use crate::barriers::Barriers;
use crate::search::{End, Relaxation, shortest};
use std::collections::BTreeSet;
use traverse_solve::{Budget, Interrupt};

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
    let mut needed = parting.clone();
    let obstacles = barriers.scene.obstacles.len();
    for owner in parting.into_iter().filter(|&owner| owner < obstacles) {
        needed.remove(&owner);
        let (blockers, features) = barriers.parts(needed.iter().copied());
        let mut relaxation = Relaxation::default();
        relaxation.add(&blockers, &features, budget)?;
        if shortest(&relaxation, start, target, budget, &mut stats.expanded_nodes)?.is_some() {
            needed.insert(owner);
        }
    }
    Ok(needed.into_iter().filter(|&owner| owner < obstacles).collect())
}
