//! Random cases and brute force for tests.

use crate::cost::{Costs, FORBIDDEN};
use crate::specification::{Shape, TourSpecification};
use crate::{CostMatrix, precedence::Precedence};
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::ops::RangeInclusive;

pub(crate) fn random_matrix(
    size: usize,
    costs: RangeInclusive<i64>,
    forbidden: f64,
    chance: &mut Xoshiro256PlusPlus,
) -> CostMatrix {
    let entries = (0..size * size)
        .map(|_| if chance.random_bool(forbidden) { FORBIDDEN } else { chance.random_range(costs.clone()) })
        .collect();
    CostMatrix::new(size, entries).expect("small costs")
}

pub(crate) fn permutations(size: usize) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for _ in 0..size {
        let longer = |prefix: &Vec<usize>| {
            let left = (0..size).filter(|at| !prefix.contains(at)).collect::<Vec<_>>();
            left.into_iter().map(|at| [prefix.as_slice(), &[at]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

/// The least cost of all orders of visits, by trying them.
pub(crate) fn brute_force(specification: &TourSpecification) -> Option<i64> {
    let size = specification.costs.size();
    let mut left: Vec<u32> = (0..size).map(|node| specification.quantity(node)).collect();
    let mut best = None;
    extend(specification, &mut vec![], &mut left, &mut best);
    best
}

fn extend(
    specification: &TourSpecification,
    visits: &mut Vec<usize>,
    left: &mut [u32],
    best: &mut Option<i64>,
) {
    if left.iter().all(|&count| count == 0) {
        *best = [*best, cost_of(specification, visits)].into_iter().flatten().min();
        return;
    }
    for node in 0..left.len() {
        if left[node] == 0 {
            continue;
        }
        let arc = visits.last().map_or(0, |&last| specification.costs.cost(last, node));
        if arc == FORBIDDEN {
            continue;
        }
        left[node] -= 1;
        visits.push(node);
        extend(specification, visits, left, best);
        visits.pop();
        left[node] += 1;
    }
}

/// What an order of visits costs, nothing when it breaks a rule.
pub(crate) fn cost_of(specification: &TourSpecification, visits: &[usize]) -> Option<i64> {
    let size = specification.costs.size();
    let mut counts = vec![0; size];
    visits.iter().for_each(|&node| counts[node] += 1);
    let (first, last) = (*visits.first()?, *visits.last()?);
    let right = (0..size).all(|node| counts[node] == specification.quantity(node))
        && specification.first.is_none_or(|node| node == first)
        && specification.last.is_none_or(|node| node == last)
        && Precedence::closure(size, &specification.precedence).expect("no circle").is_kept_by(visits);
    if !right {
        return None;
    }
    let mut arcs: Vec<(usize, usize)> = visits.windows(2).map(|pair| (pair[0], pair[1])).collect();
    if specification.shape == Shape::Cycle && visits.len() > 1 {
        arcs.push((last, first));
    }
    let costs = arcs.into_iter().map(|(from, to)| specification.costs.cost(from, to));
    costs.clone().all(|cost| cost != FORBIDDEN).then(|| costs.sum())
}
