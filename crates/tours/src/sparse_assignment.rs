//! The assignment problem for thousands of nodes: shortest augmenting paths as in `assignment`, with a heap, on few
//! arcs of each row; then a look at every pair finds the arcs that were missed, and their rows are matched anew
//! (Volgenant 1996). Every look, O(n²), gives a bound; the last, when nothing was missed, the assignment's.

use crate::assignment::sum_of;
use crate::cheapest_arcs::cheapest_arcs;
use crate::cost::{Costs, FORBIDDEN};
use crate::work::Work;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_solve::Interrupt;

/// Bids for each row, at most, before the rows that are left search for paths.
const MOST_BIDS: usize = 30;

/// No partner.
const FREE: usize = usize::MAX;

/// An assignment of most rows, and duals that are feasible on the lists.
#[derive(Clone, Debug)]
pub(crate) struct SparseAssignment {
    /// The successor of each node, if it has one.
    successor: Vec<usize>,
    predecessor: Vec<usize>,
    pub(crate) row: Vec<i64>,
    pub(crate) column: Vec<i64>,
    /// The arcs of each row that were looked at so far.
    lists: Vec<Vec<Arc>>,
}

/// An arc of a row: where it leads, and what it costs.
pub(crate) type Arc = (usize, i64);

/// What a look at every pair has found.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    /// No tour costs less.
    pub(crate) bound: i64,
    /// Rows for which a cheaper arc was missed.
    pub(crate) missed: usize,
    /// The arcs out of each node that are cheapest beyond the duals.
    pub(crate) cheapest: Vec<Vec<usize>>,
}

/// Room for one search: only what was touched is reset.
struct Scratch {
    distance: Vec<i64>,
    came_from: Vec<usize>,
    done: Vec<bool>,
    touched: Vec<usize>,
    heap: BinaryHeap<Reverse<(i64, usize)>>,
}

impl SparseAssignment {
    /// The cheapest assignment of as many rows as the lists can match one after the other.
    pub(crate) fn solve(lists: Vec<Vec<Arc>>, work: &Work<'_>) -> Result<Self, Interrupt> {
        let size = lists.len();
        let mut column = vec![FORBIDDEN; size];
        for &(to, cost) in lists.iter().flatten() {
            column[to] = column[to].min(cost);
        }
        column.iter_mut().filter(|dual| **dual == FORBIDDEN).for_each(|dual| *dual = 0);
        let (successor, predecessor) = (vec![FREE; size], vec![FREE; size]);
        let mut assignment = Self { successor, predecessor, row: vec![0; size], column, lists };
        assignment.bid(work)?;
        assignment.rematch(work)?;
        Ok(assignment)
    }

    /// Matches most free rows at once: each takes the column that is cheapest for it, whose dual falls until it is no
    /// cheaper than the second, and the row that had the column bids again (Jonker and Volgenant 1987: augmenting row
    /// reduction). Bounded, as rows may outbid one another for long.
    fn bid(&mut self, work: &Work<'_>) -> Result<(), Interrupt> {
        let size = self.lists.len();
        let mut free: Vec<usize> = (0..size).rev().filter(|&from| self.successor[from] == FREE).collect();
        for bids in 0..MOST_BIDS * size {
            if bids.is_multiple_of(1024) {
                work.breathe()?;
            }
            let Some(from) = free.pop() else { break };
            let mut least = [(FORBIDDEN, FREE); 2];
            for &(to, cost) in &self.lists[from] {
                let reduced = cost - self.column[to];
                if reduced < least[0].0 {
                    least = [(reduced, to), least[0]];
                } else if reduced < least[1].0 {
                    least[1] = (reduced, to);
                }
            }
            let [(cheapest, to), (second, _)] = least;
            if second == FORBIDDEN || (cheapest == second && self.predecessor[to] != FREE) {
                continue;
            }
            self.column[to] -= second - cheapest;
            self.row[from] = second;
            let before = std::mem::replace(&mut self.predecessor[to], from);
            self.successor[from] = to;
            if before != FREE {
                self.successor[before] = FREE;
                free.push(before);
            }
        }
        Ok(())
    }

    /// Matches all rows that are free, as far as the lists can.
    pub(crate) fn rematch(&mut self, work: &Work<'_>) -> Result<(), Interrupt> {
        let size = self.lists.len();
        let mut scratch = Scratch {
            distance: vec![FORBIDDEN; size],
            came_from: vec![FREE; size],
            done: vec![false; size],
            touched: vec![],
            heap: BinaryHeap::new(),
        };
        for from in (0..size).filter(|&from| self.successor[from] == FREE).collect::<Vec<_>>() {
            work.breathe()?;
            let reduced = self.lists[from].iter().map(|&(to, cost)| cost - self.column[to]);
            self.row[from] = reduced.min().unwrap_or(0);
            self.augment(from, &mut scratch, work)?;
        }
        Ok(())
    }

    fn augment(&mut self, row: usize, scratch: &mut Scratch, work: &Work<'_>) -> Result<(), Interrupt> {
        for to in scratch.touched.drain(..) {
            scratch.distance[to] = FORBIDDEN;
            scratch.done[to] = false;
        }
        scratch.heap.clear();
        let mut from = row;
        let mut reached = 0;
        let mut looked = 0_u32;
        let end = loop {
            looked += 1;
            if looked.is_multiple_of(256) {
                work.breathe()?;
            }
            for &(to, cost) in &self.lists[from] {
                let length = reached + cost - self.row[from] - self.column[to];
                if !scratch.done[to] && length < scratch.distance[to] {
                    if scratch.distance[to] == FORBIDDEN {
                        scratch.touched.push(to);
                    }
                    scratch.distance[to] = length;
                    scratch.came_from[to] = from;
                    scratch.heap.push(Reverse((length, to)));
                }
            }
            let next = loop {
                match scratch.heap.pop() {
                    None => return Ok(()),
                    Some(Reverse((_, to))) if scratch.done[to] => {}
                    Some(Reverse(nearest)) => break nearest,
                }
            };
            scratch.done[next.1] = true;
            reached = next.0;
            if self.predecessor[next.1] == FREE {
                break next.1;
            }
            from = self.predecessor[next.1];
        };
        for &to in scratch.touched.iter().filter(|&&to| scratch.done[to]) {
            let slack = reached - scratch.distance[to];
            self.column[to] -= slack;
            if self.predecessor[to] != FREE {
                self.row[self.predecessor[to]] += slack;
            }
        }
        self.row[row] += reached;
        let mut to = end;
        loop {
            let from = scratch.came_from[to];
            self.predecessor[to] = from;
            std::mem::swap(&mut self.successor[from], &mut to);
            if from == row {
                return Ok(());
            }
        }
    }

    /// Looks at every pair: lowers row duals until they are feasible everywhere, and lists what was missed.
    pub(crate) fn look(
        &mut self,
        costs: &impl Costs,
        width: usize,
        threads: usize,
        work: &Work<'_>,
    ) -> Result<Look, Interrupt> {
        let mut look = Look { bound: 0, missed: 0, cheapest: Vec::with_capacity(self.lists.len()) };
        for (from, row) in cheapest_arcs(costs, &self.column, width, threads, work)?.iter().enumerate() {
            let least = row.first().map_or(0, |first| first.0);
            if least < self.row[from] || self.successor[from] == FREE {
                look.missed += 1;
                for &(reduced, to) in row.iter().take_while(|&&(reduced, _)| reduced <= self.row[from]) {
                    if self.lists[from].iter().all(|arc| arc.0 != to) {
                        self.lists[from].push((to, reduced + self.column[to]));
                    }
                }
                // No longer tight: the row is matched anew.
                self.row[from] = least;
                let to = std::mem::replace(&mut self.successor[from], FREE);
                if to != FREE {
                    self.predecessor[to] = FREE;
                }
            }
            look.cheapest.push(row.iter().map(|&(_, to)| to).collect());
        }
        look.bound = sum_of(self.row.iter().chain(&self.column));
        Ok(look)
    }

    /// The chains and circles of the assignment, one behind the other.
    pub(crate) fn order(&self) -> Vec<usize> {
        let size = self.successor.len();
        let mut order = Vec::with_capacity(size);
        let mut met = vec![false; size];
        // Chains begin where nothing leads to; what is left are circles.
        let chains = (0..size).filter(|&node| self.predecessor[node] == FREE);
        for begin in chains.chain(0..size) {
            let mut node = begin;
            while node != FREE && !std::mem::replace(&mut met[node], true) {
                order.push(node);
                node = self.successor[node];
            }
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assignment::{Assignment, Matched};
    use crate::test_support::random_matrix;
    use traverse_solve::{Budget, Seed};

    #[test]
    fn looks_end_at_the_assignment_and_every_bound_is_proven_by_its_duals() {
        let budget = Budget::unlimited();
        let work = Work::new(&budget);
        let mut chance = Seed(12).stream();
        let mut ended = 0;
        for round in 0..200 {
            let size = 2 + round % 40;
            let mut costs = random_matrix(size, -50..=50, 0.1, &mut chance);
            let mut entries = costs.entries().to_vec();
            (0..size).for_each(|node| entries[node * size + node] = FORBIDDEN);
            costs = crate::CostMatrix::new(size, entries).expect("small");
            let (dense, matched) = Assignment::solve(&costs, &work).expect("no limit");
            if matched == Matched::None {
                continue;
            }
            let width = 1 + round % 4;
            let first = |from: usize| {
                let arcs = (0..size).map(|to| (to, costs.cost(from, to)));
                arcs.filter(|arc| arc.1 != FORBIDDEN).take(width).collect()
            };
            let lists = (0..size).map(first).collect();
            let mut sparse = SparseAssignment::solve(lists, &work).expect("no limit");
            for _ in 0..50 {
                let look = sparse.look(&costs, width, 1 + round % 2, &work).expect("no limit");
                let sum: i64 = sparse.row.iter().sum::<i64>() + sparse.column.iter().sum::<i64>();
                assert_eq!(look.bound, sum);
                assert!(look.bound <= dense.bound(), "{round}");
                for from in 0..size {
                    for to in 0..size {
                        assert!(sparse.row[from].saturating_add(sparse.column[to]) <= costs.cost(from, to));
                    }
                }
                if look.missed == 0 {
                    assert_eq!(look.bound, dense.bound(), "{round}");
                    ended += 1;
                    break;
                }
                sparse.rematch(&work).expect("no limit");
            }
        }
        assert!(ended > 150, "{ended}");
    }
}
