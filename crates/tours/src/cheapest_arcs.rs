//! The few cheapest arcs out of a node beyond the duals of columns, exactly, from floors that are cheaper to come by
//! than costs: arcs are looked at in the order of their floors until no floor is below what was found. O(n) floors
//! and a selection for a node; how many costs depends on how near the floors are.

use crate::cost::{Costs, FORBIDDEN};
use crate::work::Work;
use std::collections::BinaryHeap;
use std::sync::Mutex;
use traverse_solve::Interrupt;

/// What arcs cost beyond the duals of their columns, and where they lead, the cheapest first.
pub(crate) type Cheapest = Vec<(i64, usize)>;

/// Nodes that a thread takes at a time.
const BLOCK: usize = 16;

/// The `width` cheapest allowed arcs, at least one, out of every node to other nodes, whatever the number of threads.
pub(crate) fn cheapest_arcs(
    costs: &impl Costs,
    column: &[i64],
    width: usize,
    threads: usize,
    work: &Work<'_>,
) -> Result<Vec<Cheapest>, Interrupt> {
    let mut lists = vec![vec![]; costs.size()];
    let blocks = Mutex::new(lists.chunks_mut(BLOCK).enumerate());
    let fill = || {
        let mut row = Row::new(width);
        loop {
            let Some((number, block)) = blocks.lock().ok().and_then(|mut blocks| blocks.next()) else {
                return Ok(());
            };
            for (from, list) in (number * BLOCK..).zip(block) {
                work.breathe()?;
                *list = row.cheapest(costs, from, column);
            }
        }
    };
    let results: Vec<Result<(), Interrupt>> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(fill)).collect();
        let own = fill();
        let joined = others.into_iter().map(|other| other.join().unwrap_or(Err(Interrupt::Cancelled)));
        std::iter::once(own).chain(joined).collect()
    });
    results.into_iter().collect::<Result<(), _>>()?;
    Ok(lists)
}

/// Room for one node after the other.
struct Row {
    width: usize,
    /// Floor beyond the dual of the column, column.
    floors: Vec<(i64, usize)>,
    /// Cost beyond the dual of the column, column: the dearest on top.
    kept: BinaryHeap<(i64, usize)>,
}

impl Row {
    fn new(width: usize) -> Self {
        Self { width: width.max(1), floors: vec![], kept: BinaryHeap::new() }
    }

    fn cheapest(&mut self, costs: &impl Costs, from: usize, column: &[i64]) -> Cheapest {
        let floors = (0..costs.size()).filter(|&to| to != from).map(|to| (costs.floor(from, to), to));
        let allowed = floors.filter(|&(floor, _)| floor != FORBIDDEN);
        self.floors.clear();
        self.floors.extend(allowed.map(|(floor, to)| (floor - column[to], to)));
        let (mut begin, mut length) = (0, 2 * self.width);
        'arcs: while begin < self.floors.len() {
            let open = &mut self.floors[begin..];
            if length < open.len() {
                open.select_nth_unstable(length);
            }
            let next = length.min(open.len());
            open[..next].sort_unstable();
            for &(floor, to) in &open[..next] {
                if self.kept.len() == self.width && self.kept.peek().is_some_and(|&worst| (floor, to) > worst)
                {
                    break 'arcs;
                }
                let cost = costs.cost(from, to);
                if cost != FORBIDDEN {
                    self.kept.push((cost - column[to], to));
                    if self.kept.len() > self.width {
                        self.kept.pop();
                    }
                }
            }
            begin += next;
            length *= 2;
        }
        let mut cheapest: Cheapest = self.kept.drain().collect();
        cheapest.sort_unstable();
        cheapest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_solve::{Budget, Seed};

    /// Costs with floors below them by up to the slack.
    struct Floored {
        size: usize,
        costs: Vec<i64>,
        below: Vec<i64>,
    }

    impl Costs for Floored {
        fn size(&self) -> usize {
            self.size
        }

        fn cost(&self, from: usize, to: usize) -> i64 {
            self.costs[from * self.size + to]
        }

        fn floor(&self, from: usize, to: usize) -> i64 {
            match self.cost(from, to) {
                FORBIDDEN => FORBIDDEN,
                cost => cost - self.below[from * self.size + to],
            }
        }
    }

    #[test]
    fn they_are_the_first_of_all_sorted_whatever_the_floors() {
        let mut chance = Seed(11).stream();
        let budget = Budget::unlimited();
        let work = Work::new(&budget);
        for round in 0..300 {
            let size = 1 + round % 40;
            let slack = [0, 3, 50][round % 3];
            let mut entry = || match chance.random_range(0..10) {
                0 => FORBIDDEN,
                _ => chance.random_range(-20..20),
            };
            let costs: Vec<i64> = (0..size * size).map(|_| entry()).collect();
            let below = (0..size * size).map(|_| chance.random_range(0..=slack)).collect();
            let column: Vec<i64> = (0..size).map(|_| chance.random_range(-9..9)).collect();
            let costs = Floored { size, costs, below };
            let width = 1 + round % 7;
            let found = cheapest_arcs(&costs, &column, width, 1 + round % 3, &work).expect("no limit");
            for (from, found) in found.iter().enumerate() {
                let mut all: Cheapest = (0..size)
                    .filter(|&to| to != from && costs.cost(from, to) != FORBIDDEN)
                    .map(|to| (costs.cost(from, to) - column[to], to))
                    .collect();
                all.sort_unstable();
                all.truncate(width);
                assert_eq!(found, &all, "{round} {from}");
            }
        }
    }
}
