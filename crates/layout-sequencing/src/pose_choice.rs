//! The poses that make a given order of kinds shortest by neighbours: a program over positions (Viterbi 1967), exact for
//! the sum of offsets, O(copies · poses²).

use crate::instance::Instance;
use traverse_solve::{Budget, Interrupt};

/// Items for an order of kinds.
pub(crate) fn choose_poses(
    instance: &Instance,
    kinds: &[usize],
    budget: &Budget,
) -> Result<Vec<usize>, Interrupt> {
    let Some((&first, rest)) = kinds.split_first() else { return Ok(vec![]) };
    // For each item at a position: the least sum so far, and the item before it.
    let begin = instance.kinds[first].items.clone();
    let mut least: Vec<(usize, i64)> = begin.map(|item| (item, 0)).collect();
    let mut chosen: Vec<Vec<(usize, usize)>> = vec![];
    for &kind in rest {
        budget.check(0)?;
        let step = |item: usize| {
            let reached =
                least.iter().map(|&(before, sum)| (before, sum + instance.offset(before, item).max(0)));
            let (before, sum) = reached.min_by_key(|reached| reached.1).unwrap_or((item, 0));
            ((item, before), (item, sum))
        };
        let (links, sums) = instance.kinds[kind].items.clone().map(step).unzip();
        chosen.push(links);
        least = sums;
    }
    let mut at = least.iter().min_by_key(|reached| reached.1).map_or(0, |reached| reached.0);
    let mut items = vec![at];
    for links in chosen.iter().rev() {
        at = links.iter().find(|link| link.0 == at).map_or(at, |link| link.1);
        items.push(at);
    }
    items.reverse();
    Ok(items)
}
