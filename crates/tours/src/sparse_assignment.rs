//! The assignment problem for thousands of nodes: shortest augmenting paths as in `assignment`, with a heap, on few
//! arcs of each row; then a look at every pair finds the arcs that were missed, and their rows are matched anew
//! (Volgenant 1996). Every look, O(n²), gives a bound; the last, when nothing was missed, the assignment's.

use crate::cost::{Costs, FORBIDDEN};
use crate::work::Work;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_solve::Interrupt;

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
    lists: Vec<Vec<usize>>,
}

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
    pub(crate) fn solve(
        costs: &impl Costs,
        lists: Vec<Vec<usize>>,
        work: &Work<'_>,
    ) -> Result<Self, Interrupt> {
        let size = costs.size();
        let mut column = vec![FORBIDDEN; size];
        for (from, list) in lists.iter().enumerate() {
            for &to in list {
                column[to] = column[to].min(costs.cost(from, to));
            }
        }
        column.iter_mut().filter(|dual| **dual == FORBIDDEN).for_each(|dual| *dual = 0);
        let (successor, predecessor) = (vec![FREE; size], vec![FREE; size]);
        let mut assignment = Self { successor, predecessor, row: vec![0; size], column, lists };
        assignment.match_free_rows(costs, work)?;
        Ok(assignment)
    }

    /// Matches all rows that are free, as far as the lists can.
    fn match_free_rows(&mut self, costs: &impl Costs, work: &Work<'_>) -> Result<(), Interrupt> {
        let size = costs.size();
        let mut scratch = Scratch {
            distance: vec![FORBIDDEN; size],
            came_from: vec![FREE; size],
            done: vec![false; size],
            touched: vec![],
            heap: BinaryHeap::new(),
        };
        for from in (0..size).filter(|&from| self.successor[from] == FREE).collect::<Vec<_>>() {
            work.breathe()?;
            let reduced = |to: usize| costs.cost(from, to) - self.column[to];
            self.row[from] = self.lists[from].iter().map(|&to| reduced(to)).min().unwrap_or(0);
            self.augment(costs, from, &mut scratch, work)?;
        }
        Ok(())
    }

    fn augment(
        &mut self,
        costs: &impl Costs,
        row: usize,
        scratch: &mut Scratch,
        work: &Work<'_>,
    ) -> Result<(), Interrupt> {
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
            for &to in &self.lists[from] {
                let length = reached + costs.cost(from, to) - self.row[from] - self.column[to];
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
        work: &Work<'_>,
    ) -> Result<Look, Interrupt> {
        let size = costs.size();
        let mut look = Look { bound: 0, missed: 0, cheapest: Vec::with_capacity(size) };
        let mut row: Vec<(i64, usize)> = Vec::with_capacity(size);
        for from in 0..size {
            work.breathe()?;
            row.clear();
            let floors = (0..size).filter(|&to| to != from).map(|to| (costs.floor(from, to), to));
            let allowed = floors.filter(|&(floor, _)| floor != FORBIDDEN);
            row.extend(allowed.map(|(floor, to)| (floor - self.column[to], to)));
            if row.len() > width {
                row.select_nth_unstable(width - 1);
                row.truncate(width);
            }
            row.sort_unstable();
            let least = row.first().map_or(0, |first| first.0);
            if least < self.row[from] || self.successor[from] == FREE {
                look.missed += 1;
                for &(_, to) in row.iter().take_while(|&&(reduced, _)| reduced <= self.row[from]) {
                    if !self.lists[from].contains(&to) {
                        self.lists[from].push(to);
                    }
                }
                // No longer tight: the row is matched anew.
                self.row[from] = least;
                let to = std::mem::replace(&mut self.successor[from], FREE);
                if to != FREE {
                    self.predecessor[to] = FREE;
                }
            }
            look.bound += self.row[from] + self.column[from];
            look.cheapest.push(row.iter().map(|&(_, to)| to).collect());
        }
        Ok(look)
    }

    /// Matches the rows that the last look has freed.
    pub(crate) fn rematch(&mut self, costs: &impl Costs, work: &Work<'_>) -> Result<(), Interrupt> {
        self.match_free_rows(costs, work)
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
