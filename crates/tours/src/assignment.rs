//! The assignment problem: every node gets one successor and is one node's successor, at least cost.
//!
//! Shortest augmenting paths over reduced costs (Jonker and Volgenant 1987, without their augmenting row
//! reduction): column and row reduction match most rows, each row left over takes one Dijkstra search over the
//! dense matrix. O(n³) at worst, O(n²) for every row that is matched again, which is what a branch and bound asks
//! after it has forbidden an arc. The duals prove the cost: u_i + v_j ≤ c_ij everywhere, equal where assigned.

use crate::cost::{Costs, FORBIDDEN};
use crate::work::Work;
use traverse_solve::Interrupt;

/// No partner.
const FREE: usize = usize::MAX;

/// An assignment and the duals that prove it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The successor of each node.
    pub successor: Vec<usize>,
    /// Whose successor each node is.
    pub predecessor: Vec<usize>,
    /// Dual of each row.
    pub row: Vec<i64>,
    /// Dual of each column.
    pub column: Vec<i64>,
}

/// The sum of duals: that of thousands may leave a machine word on the way, though it ends within one.
pub(crate) fn sum_of<'a>(duals: impl Iterator<Item = &'a i64>) -> i64 {
    let sum: i128 = duals.map(|&dual| i128::from(dual)).sum();
    sum.clamp(i128::from(i64::MIN), i128::from(i64::MAX - 1)) as i64
}

/// Whether every node found a successor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matched {
    /// Every one.
    All,
    /// Forbidden arcs leave no assignment, hence no tour.
    None,
}

impl Assignment {
    /// The cheapest assignment of a matrix.
    ///
    /// # Errors
    /// When the budget ends.
    pub fn solve(costs: &impl Costs, work: &Work<'_>) -> Result<(Self, Matched), Interrupt> {
        let size = costs.size();
        let mut assignment = Self::reduced(costs, work)?;
        for row in 0..size {
            if assignment.successor[row] == FREE
                && assignment.augment(costs, row, &mut Scratch::new(size), work)? == Matched::None
            {
                return Ok((assignment, Matched::None));
            }
        }
        Ok((assignment, Matched::All))
    }

    /// The sum of the duals: no assignment costs less.
    #[must_use]
    pub fn bound(&self) -> i64 {
        sum_of(self.row.iter().chain(&self.column))
    }

    /// Duals from column and row minima, and what they let match at once.
    fn reduced(costs: &impl Costs, work: &Work<'_>) -> Result<Self, Interrupt> {
        let size = costs.size();
        let mut column = vec![FORBIDDEN; size];
        for from in 0..size {
            work.breathe()?;
            for (to, least) in column.iter_mut().enumerate() {
                *least = (*least).min(costs.cost(from, to));
            }
        }
        for least in &mut column {
            if *least == FORBIDDEN {
                *least = 0;
            }
        }
        let mut assignment =
            Self { successor: vec![FREE; size], predecessor: vec![FREE; size], row: vec![0; size], column };
        for from in 0..size {
            work.breathe()?;
            let reduced = |to: usize| match costs.cost(from, to) {
                FORBIDDEN => FORBIDDEN,
                cost => cost - assignment.column[to],
            };
            let least = (0..size).map(reduced).min().unwrap_or(0);
            if least == FORBIDDEN {
                continue;
            }
            let free = (0..size).find(|&to| reduced(to) == least && assignment.predecessor[to] == FREE);
            assignment.row[from] = least;
            if let Some(to) = free {
                assignment.successor[from] = to;
                assignment.predecessor[to] = from;
            }
        }
        Ok(assignment)
    }

    /// Takes the row's successor away, so that it can be matched anew.
    pub(crate) fn release(&mut self, row: usize) {
        let to = std::mem::replace(&mut self.successor[row], FREE);
        if to != FREE {
            self.predecessor[to] = FREE;
        }
    }

    /// Matches a row that has no successor, along the path that raises the cost least. Only costs that rose since
    /// the duals were valid are allowed.
    pub(crate) fn augment(
        &mut self,
        costs: &impl Costs,
        row: usize,
        scratch: &mut Scratch,
        work: &Work<'_>,
    ) -> Result<Matched, Interrupt> {
        let size = costs.size();
        scratch.reset();
        let mut from = row;
        let mut reached = 0_i64;
        let end = loop {
            work.breathe()?;
            let base = reached - self.row[from];
            let mut nearest = (FORBIDDEN, FREE);
            for at in scratch.scanned..size {
                let to = scratch.columns[at];
                let cost = costs.cost(from, to);
                if cost != FORBIDDEN {
                    let length = base + cost - self.column[to];
                    if length < scratch.distance[to] {
                        scratch.distance[to] = length;
                        scratch.came_from[to] = from;
                    }
                }
                let length = scratch.distance[to];
                // A free column among equals ends the search at once.
                if length < nearest.0
                    || (length == nearest.0 && length != FORBIDDEN && self.predecessor[to] == FREE)
                {
                    nearest = (length, at);
                }
            }
            if nearest.0 == FORBIDDEN {
                return Ok(Matched::None);
            }
            let to = scratch.columns[nearest.1];
            scratch.columns.swap(scratch.scanned, nearest.1);
            scratch.scanned += 1;
            reached = nearest.0;
            if self.predecessor[to] == FREE {
                break to;
            }
            from = self.predecessor[to];
        };
        for &to in &scratch.columns[..scratch.scanned] {
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
                return Ok(Matched::All);
            }
        }
    }
}

/// Room for one search, reused from search to search.
#[derive(Debug)]
pub(crate) struct Scratch {
    distance: Vec<i64>,
    came_from: Vec<usize>,
    /// Columns, those scanned first.
    columns: Vec<usize>,
    scanned: usize,
}

impl Scratch {
    pub(crate) fn new(size: usize) -> Self {
        Self {
            distance: vec![FORBIDDEN; size],
            came_from: vec![FREE; size],
            columns: (0..size).collect(),
            scanned: 0,
        }
    }

    fn reset(&mut self) {
        self.distance.fill(FORBIDDEN);
        self.scanned = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CostMatrix;
    use crate::test_support::{permutations, random_matrix};
    use traverse_solve::{Budget, Seed};

    fn check(costs: &CostMatrix, assignment: &Assignment) {
        for from in 0..costs.size() {
            for to in 0..costs.size() {
                let cost = costs.cost(from, to);
                let duals = assignment.row[from] + assignment.column[to];
                assert!(cost == FORBIDDEN || duals <= cost, "{from}→{to}: {duals} > {cost}");
                assert!(assignment.successor[from] != to || duals == cost);
            }
        }
    }

    #[test]
    fn the_least_of_all_permutations_is_found_and_found_again_after_an_arc_is_forbidden() {
        let budget = Budget::unlimited();
        let mut chance = Seed(1).stream();
        for round in 0..400 {
            let size = 1 + round % 6;
            let mut costs = random_matrix(size, -20..=20, 0.2, &mut chance);
            let work = Work::new(&budget);
            let (mut assignment, matched) = Assignment::solve(&costs, &work).expect("no limit");
            loop {
                let oracle = permutations(size)
                    .iter()
                    .filter_map(|to| {
                        let arcs = to.iter().enumerate().map(|(from, &to)| costs.cost(from, to));
                        arcs.clone().all(|cost| cost != FORBIDDEN).then(|| arcs.sum::<i64>())
                    })
                    .min();
                let Some(oracle) = oracle else {
                    assert_eq!(matched, Matched::None);
                    break;
                };
                assert_eq!(assignment.bound(), oracle);
                check(&costs, &assignment);
                let row = round % size;
                let mut entries = costs.entries().to_vec();
                entries[row * size + assignment.successor[row]] = FORBIDDEN;
                costs = CostMatrix::new(size, entries).expect("still small");
                assignment.release(row);
                let again =
                    assignment.augment(&costs, row, &mut Scratch::new(size), &work).expect("no limit");
                if again == Matched::None {
                    break;
                }
            }
        }
    }
}
