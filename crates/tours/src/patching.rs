//! A first tour from an assignment: its circles are joined two at a time, the cheapest way first for the two
//! largest (Karp 1979). O(n²) for each circle.

use crate::cost::Costs;
use crate::work::Work;
use traverse_solve::Interrupt;

/// A tour from the successors of an assignment. Every arc must have a cost that can be added.
pub(crate) fn patch(
    costs: &impl Costs,
    successor: &[usize],
    work: &Work<'_>,
) -> Result<Vec<usize>, Interrupt> {
    let mut next = successor.to_vec();
    let mut circles = circles_of(&next);
    circles.sort_by_key(Vec::len);
    let Some(mut tour) = circles.pop() else { return Ok(vec![]) };
    while let Some(circle) = circles.pop() {
        let mut best: Option<(i64, usize, usize)> = None;
        for &from in &tour {
            work.breathe()?;
            let kept = costs.cost(from, next[from]);
            for &other in &circle {
                let more = costs.cost(from, next[other]) + costs.cost(other, next[from])
                    - kept
                    - costs.cost(other, next[other]);
                if best.is_none_or(|(least, ..)| more < least) {
                    best = Some((more, from, other));
                }
            }
        }
        if let Some((_, from, other)) = best {
            next.swap(from, other);
        }
        tour.extend(circle);
    }
    Ok(circles_of(&next).into_iter().next().unwrap_or_default())
}

/// The circles of a permutation, each from its least node.
pub(crate) fn circles_of(next: &[usize]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; next.len()];
    let mut circles = vec![];
    for begin in 0..next.len() {
        let mut circle = vec![];
        let mut at = begin;
        while !std::mem::replace(&mut seen[at], true) {
            circle.push(at);
            at = next[at];
        }
        if !circle.is_empty() {
            circles.push(circle);
        }
    }
    circles
}
