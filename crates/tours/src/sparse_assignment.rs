//! The assignment problem on neighbour lists, for thousands of nodes: shortest augmenting paths as in `assignment`,
//! with a heap and only the arcs of the lists. Rows that the lists can't match stay free. O(rows · arcs met · log).
//!
//! The duals are feasible on the lists; `repair` lowers row duals until they are feasible everywhere, one look at
//! every pair, and what is left is a bound for all tours.

use crate::cost::{Costs, FORBIDDEN};
use crate::neighbours::Neighbours;
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
        neighbours: &Neighbours,
        work: &Work<'_>,
    ) -> Result<Self, Interrupt> {
        let size = costs.size();
        let mut assignment = Self {
            successor: vec![FREE; size],
            predecessor: vec![FREE; size],
            row: vec![0; size],
            column: vec![FORBIDDEN; size],
        };
        for from in 0..size {
            for &to in neighbours.of(from) {
                assignment.column[to] = assignment.column[to].min(costs.cost(from, to));
            }
        }
        assignment.column.iter_mut().filter(|dual| **dual == FORBIDDEN).for_each(|dual| *dual = 0);
        let mut scratch = Scratch {
            distance: vec![FORBIDDEN; size],
            came_from: vec![FREE; size],
            done: vec![false; size],
            touched: vec![],
            heap: BinaryHeap::new(),
        };
        for from in 0..size {
            work.breathe()?;
            let reduced = |to: usize| costs.cost(from, to) - assignment.column[to];
            assignment.row[from] = neighbours.of(from).iter().map(|&to| reduced(to)).min().unwrap_or(0);
            assignment.augment(costs, neighbours, from, &mut scratch, work)?;
        }
        Ok(assignment)
    }

    fn augment(
        &mut self,
        costs: &impl Costs,
        neighbours: &Neighbours,
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
            for &to in neighbours.of(from) {
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

    /// Lowers row duals until they are feasible for every pair, and gives the bound.
    pub(crate) fn repair(&mut self, costs: &impl Costs, work: &Work<'_>) -> Result<i64, Interrupt> {
        for from in 0..costs.size() {
            work.breathe()?;
            let floors = (0..costs.size()).filter(|&to| to != from).map(|to| (costs.floor(from, to), to));
            let allowed = floors.filter(|&(floor, _)| floor != FORBIDDEN);
            let most = allowed.map(|(floor, to)| floor - self.column[to]).min();
            self.row[from] = most.unwrap_or(0).min(self.row[from]);
        }
        Ok(self.row.iter().sum::<i64>() + self.column.iter().sum::<i64>())
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
