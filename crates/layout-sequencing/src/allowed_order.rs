//! An order that is allowed, as near to a wanted one as may be: of the copies that may come next, the one that was wanted
//! first (Kahn 1962, with a heap). Ends and precedence are always kept; with forbidden joins it can come to a stop though
//! there is an order, as that is a question of Hamiltonian paths.

use crate::instance::Instance;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The kinds of `wanted` in an allowed order; nothing where forbidden joins are in the way. Cost: O(n log n) for n copies
/// and precedences, and with forbidden joins what may not stand beside the last one each time.
pub(crate) fn allowed_order(instance: &Instance, wanted: &[usize]) -> Option<Vec<usize>> {
    let kinds = instance.kinds.len();
    let mut after: Vec<Vec<usize>> = vec![vec![]; kinds];
    // Copies that have to come before each kind and are not placed.
    let mut awaited = vec![0; kinds];
    for &(before, later) in &instance.precedences {
        after[before].push(later);
        awaited[later] += instance.quantity(before);
    }
    let mut waiting: Vec<Vec<usize>> = vec![vec![]; kinds];
    for (at, &kind) in wanted.iter().enumerate().rev() {
        waiting[kind].push(at);
    }
    // One copy is held back for each end; with a single section both are the same.
    let ends_at = |end: Option<usize>, kind: usize| end == Some(kind);
    let held_back = instance.last.filter(|_| wanted.len() > 1);
    if let Some(last) = held_back {
        // The copy wanted last: `waiting` has it in front.
        waiting[last].remove(0);
    }
    let mut ready: BinaryHeap<Reverse<usize>> = BinaryHeap::new();
    for kind in (0..kinds).filter(|&kind| awaited[kind] == 0) {
        ready.extend(waiting[kind].drain(..).map(Reverse));
    }
    let mut order: Vec<usize> = vec![];
    let mut passed_over = vec![];
    let middle = wanted.len() - usize::from(held_back.is_some());
    while order.len() < middle {
        let fits = |kind: usize| match order.last() {
            None => instance.first.is_none() || ends_at(instance.first, kind),
            Some(&before) => instance.may_join(before, kind),
        };
        let next = loop {
            let Reverse(at) = ready.pop()?;
            if fits(wanted[at]) {
                break wanted[at];
            }
            passed_over.push(Reverse(at));
        };
        ready.extend(passed_over.drain(..));
        order.push(next);
        for &later in &after[next] {
            awaited[later] -= 1;
            if awaited[later] == 0 {
                ready.extend(waiting[later].drain(..).map(Reverse));
            }
        }
    }
    order.extend(held_back);
    instance.is_allowed(&order).then_some(order)
}
