//! The one form that all kernels work on: a closed walk through types, each visited a given number of times.
//!
//! A path, and fixed ends that a cycle can't express by rotation, become a cycle through a *depot*: one more node,
//! visited once, whose arcs out lead to what may be first and whose arcs in come from what may be last. With
//! precedence every visit is a node of its own, and arcs that no order permits are forbidden. O(n²), with
//! precedence O(n³).

use crate::cost::{Costs, FORBIDDEN};
use crate::precedence::Precedence;
use crate::specification::{Shape, TourSpecification};

/// A closed walk through types is sought, each visited `counts` times.
#[derive(Clone, Debug)]
pub(crate) struct Network {
    pub(crate) size: usize,
    costs: Vec<i64>,
    pub(crate) counts: Vec<u32>,
    /// Where the walk begins and ends; not a node of the specification.
    pub(crate) depot: Option<usize>,
    pub(crate) precedence: Precedence,
    /// Nodes of the specification that a type stands for, one for each visit.
    pub(crate) members: Vec<Vec<usize>>,
}

impl Costs for Network {
    fn size(&self) -> usize {
        self.size
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        self.costs[from * self.size + to]
    }
}

impl Network {
    /// The network of a specification without findings.
    pub(crate) fn of(specification: &TourSpecification) -> Self {
        let ordered = !specification.precedence.is_empty();
        let nodes = specification.costs.size();
        let mut members: Vec<Vec<usize>> = vec![];
        for node in 0..nodes {
            let quantity = specification.quantity(node) as usize;
            if ordered {
                members.extend(std::iter::repeat_n(vec![node], quantity));
            } else {
                members.push(vec![node; quantity]);
            }
        }
        let ends = specification.first.is_some() && specification.last.is_some();
        // A single visit has no arcs, whatever its ends.
        let several = members.len() > 1 || members.first().is_some_and(|nodes| nodes.len() > 1);
        let anchored = several && (specification.shape == Shape::Path || ordered || ends);
        let inner = members.len();
        let size = inner + usize::from(anchored);
        let depot = anchored.then_some(inner);
        let mut pairs = vec![];
        for &(a, b) in &specification.precedence {
            for from in (0..inner).filter(|&at| members[at][0] == a) {
                pairs.extend((0..inner).filter(|&at| members[at][0] == b).map(|to| (from, to)));
            }
        }
        let precedence = Precedence::closure(size, &pairs).unwrap_or_else(|_| Precedence::none(size));
        let mut costs = vec![FORBIDDEN; size * size];
        for from in 0..inner {
            let row = &mut costs[from * size..][..inner];
            if ordered {
                for (to, cost) in row.iter_mut().enumerate().filter(|&(to, _)| to != from) {
                    if precedence.may_follow(from, to) {
                        *cost = specification.costs.cost(members[from][0], members[to][0]);
                    }
                }
            } else {
                row.copy_from_slice(&specification.costs.entries()[from * nodes..][..nodes]);
                if members[from].len() == 1 {
                    row[from] = FORBIDDEN;
                }
            }
        }
        let mut counts: Vec<u32> = members.iter().map(|nodes| nodes.len() as u32).collect();
        if let Some(depot) = depot {
            counts.push(1);
            members.push(vec![]);
            for at in 0..inner {
                let (out, back) = end_costs(specification, members[at][0]);
                if precedence.predecessors[at].is_empty() {
                    costs[depot * size + at] = out;
                }
                if precedence.successors[at].is_empty() {
                    costs[at * size + depot] = back;
                }
            }
        }
        Self { size, costs, counts, depot, precedence, members }
    }

    /// A network of the same kind with other types: `members_of[k]` are the types of this one that type k replaces,
    /// and `costs` is the new matrix.
    pub(crate) fn collapsed(&self, members_of: &[Vec<usize>], costs: Vec<i64>) -> Self {
        let gather = |types: &Vec<usize>| types.iter().flat_map(|&at| self.members[at].clone()).collect();
        Self {
            size: members_of.len(),
            costs,
            counts: members_of.iter().map(|types| types.iter().map(|&at| self.counts[at]).sum()).collect(),
            depot: self.depot.and_then(|depot| members_of.iter().position(|types| types == &[depot])),
            precedence: Precedence::none(members_of.len()),
            members: members_of.iter().map(gather).collect(),
        }
    }

    /// The costs, row by row.
    pub(crate) fn entries(&self) -> &[i64] {
        &self.costs
    }

    /// How many visits the walk makes.
    pub(crate) fn visits(&self) -> usize {
        self.counts.iter().map(|&count| count as usize).sum()
    }

    /// The cost of the closed walk, nothing when it uses a forbidden arc.
    pub(crate) fn walk_cost(&self, walk: &[usize]) -> Option<i64> {
        let Some(&last) = walk.last() else { return Some(0) };
        let mut from = last;
        let mut total = 0_i64;
        for &to in walk {
            let cost = self.cost(from, to);
            if cost == FORBIDDEN {
                return None;
            }
            total += cost;
            from = to;
        }
        Some(total)
    }

    /// The closed walk through the types, as visits of the specification's nodes from the first to the last.
    pub(crate) fn visits_of(&self, walk: &[usize], specification: &TourSpecification) -> Vec<usize> {
        let mut left: Vec<std::slice::Iter<'_, usize>> =
            self.members.iter().map(|nodes| nodes.iter()).collect();
        let begin = match self.depot {
            Some(depot) => walk.iter().position(|&at| at == depot).unwrap_or(0),
            None => 0,
        };
        let turned = walk[begin..].iter().chain(&walk[..begin]);
        let mut visits: Vec<usize> = turned.filter_map(|&at| left[at].next().copied()).collect();
        if self.depot.is_none() {
            if let Some(at) = specification.first.and_then(|node| visits.iter().position(|&v| v == node)) {
                visits.rotate_left(at);
            } else if let Some(at) =
                specification.last.and_then(|node| visits.iter().position(|&v| v == node))
            {
                visits.rotate_left(at + 1);
            }
        }
        visits
    }
}

/// What it costs to begin at a node, and to end there.
fn end_costs(specification: &TourSpecification, node: usize) -> (i64, i64) {
    let only = |end: Option<usize>, cost: i64| match end {
        Some(fixed) if fixed != node => FORBIDDEN,
        _ => cost,
    };
    if specification.shape == Shape::Path {
        return (only(specification.first, 0), only(specification.last, 0));
    }
    // A cycle pays for the way from its last visit to its first: with the first known on the way in, otherwise out.
    match (specification.first, specification.last) {
        (Some(first), last) => (only(Some(first), 0), only(last, specification.costs.cost(node, first))),
        (None, Some(last)) => (specification.costs.cost(last, node), only(Some(last), 0)),
        (None, None) => (0, 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CostMatrix;

    #[test]
    fn a_path_goes_through_the_depot() {
        let costs = CostMatrix::new(3, (0..9).collect()).expect("small");
        let specification = TourSpecification { last: Some(0), ..TourSpecification::path(costs) };
        let network = Network::of(&specification);
        assert_eq!((network.size, network.depot, network.visits()), (4, Some(3), 4));
        assert_eq!(network.walk_cost(&[1, 2, 0, 3]), Some(5 + 6));
        assert_eq!(network.walk_cost(&[0, 1, 2, 3]), None);
        assert_eq!(network.visits_of(&[0, 3, 1, 2], &specification), [1, 2, 0]);
    }
}
