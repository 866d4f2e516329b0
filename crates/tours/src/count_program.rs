//! Dynamic programming over counts: for every multiset of visits made and every last type the least cost, after
//! Held and Karp (1962) with digits instead of bits. Exact, whatever the costs. O(states · types²) additions, which
//! run through rows of memory.

use crate::cost::FORBIDDEN;
use crate::precedence::Precedence;
use crate::work::Work;
use traverse_solve::Interrupt;

/// A total that fits a machine word; half its range stands for "can't be".
trait Total: Copy + Ord + std::ops::Add<Output = Self> {
    const NEVER: Self;
    const LIMIT: Self;
    const LARGEST: i64;
    fn of(cost: i64) -> Self;
}

impl Total for i32 {
    const NEVER: Self = 1 << 29;
    const LIMIT: Self = 1 << 28;
    const LARGEST: i64 = (1 << 27) - 1;
    fn of(cost: i64) -> Self {
        i32::try_from(cost).unwrap_or(Self::NEVER)
    }
}

impl Total for i64 {
    const NEVER: Self = 1 << 61;
    const LIMIT: Self = 1 << 60;
    const LARGEST: i64 = (1 << 59) - 1;
    fn of(cost: i64) -> Self {
        cost
    }
}

/// A closed walk to be found: costs row by row, visits of each type, the type to begin with.
#[derive(Clone, Debug)]
pub(crate) struct CountProgram<'a> {
    pub(crate) costs: &'a [i64],
    pub(crate) counts: &'a [u32],
    pub(crate) begin: usize,
    pub(crate) precedence: &'a Precedence,
}

/// What the program found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Walk {
    /// The cheapest walk.
    Cheapest(Vec<usize>, i64),
    /// There is none.
    None,
}

impl CountProgram<'_> {
    /// How many bytes the table takes.
    pub(crate) fn bytes(&self) -> u64 {
        let states = self.radices().iter().try_fold(1_u64, |product, &radix| product.checked_mul(radix));
        let width = if self.largest_total() <= i32::LARGEST { 4 } else { 8 };
        states.and_then(|states| states.checked_mul(self.counts.len() as u64 * width)).unwrap_or(u64::MAX)
    }

    /// The cheapest closed walk.
    pub(crate) fn solve(&self, work: &Work<'_>) -> Result<Walk, Interrupt> {
        if self.largest_total() <= i32::LARGEST { self.run::<i32>(work) } else { self.run::<i64>(work) }
    }

    fn radices(&self) -> Vec<u64> {
        let digit = |(node, &count): (usize, &u32)| u64::from(count) + u64::from(node != self.begin);
        self.counts.iter().enumerate().map(digit).collect()
    }

    fn largest_total(&self) -> i64 {
        let costs = self.costs.iter().filter(|&&cost| cost != FORBIDDEN);
        let largest = costs.map(|cost| cost.abs()).max().unwrap_or(0);
        largest.saturating_mul(self.counts.iter().map(|&count| i64::from(count)).sum::<i64>() + 1)
    }

    fn run<T: Total>(&self, work: &Work<'_>) -> Result<Walk, Interrupt> {
        let size = self.counts.len();
        let radices = self.radices();
        let mut weights = vec![1_usize; size];
        for node in 1..size {
            weights[node] = weights[node - 1] * radices[node - 1] as usize;
        }
        let states = weights[size - 1] * radices[size - 1] as usize;
        // into[to * size + from], so that a minimum over `from` runs through memory.
        let mut into = vec![T::NEVER; size * size];
        for from in 0..size {
            for to in 0..size {
                let cost = self.costs[from * size + to];
                if cost != FORBIDDEN {
                    into[to * size + from] = T::of(cost);
                }
            }
        }
        let mut best: Vec<T> = Vec::with_capacity(states * size);
        let mut digits = vec![0_u64; size];
        for state in 0..states {
            if state % 256 == 0 {
                work.breathe()?;
            }
            let row = best.len();
            best.resize(row + size, T::NEVER);
            if state == 0 {
                best[self.begin] = T::of(0);
            } else {
                for last in 0..size {
                    if digits[last] == 0 || !self.may_come(last, &digits) {
                        continue;
                    }
                    let before = (state - weights[last]) * size;
                    let (done, now) = best.split_at_mut(row);
                    let ways = done[before..before + size].iter().zip(&into[last * size..][..size]);
                    let least = ways.map(|(&total, &cost)| total + cost).min().unwrap_or(T::NEVER);
                    now[last] = if least > T::LIMIT { T::NEVER } else { least };
                }
            }
            for (digit, &radix) in digits.iter_mut().zip(&radices) {
                *digit += 1;
                if *digit < radix {
                    break;
                }
                *digit = 0;
            }
        }
        Ok(self.trace(&best, &into, &weights, states))
    }

    /// Whether everything that comes before the type was visited, and nothing that comes after.
    fn may_come(&self, node: usize, digits: &[u64]) -> bool {
        self.precedence.predecessors[node]
            .iter()
            .all(|&before| digits[before] == u64::from(self.counts[before]))
    }

    fn trace<T: Total>(&self, best: &[T], into: &[T], weights: &[usize], states: usize) -> Walk {
        let size = self.counts.len();
        let mut state = states - 1;
        let home = |last: usize| best[state * size + last] + into[self.begin * size + last];
        let Some(mut last) = (0..size).min_by_key(|&last| home(last)) else { return Walk::None };
        if home(last) > T::LIMIT {
            return Walk::None;
        }
        let mut walk = vec![last];
        while state != 0 {
            let before = state - weights[last];
            let way = |from: usize| best[before * size + from] + into[last * size + from];
            last = (0..size).min_by_key(|&from| way(from)).unwrap_or(last);
            walk.push(last);
            state = before;
        }
        walk.reverse();
        let cost = self.cost_of(&walk);
        Walk::Cheapest(walk, cost)
    }

    fn cost_of(&self, walk: &[usize]) -> i64 {
        let arcs = walk.iter().zip(walk.iter().cycle().skip(1));
        arcs.map(|(&from, &to)| self.costs[from * self.counts.len() + to]).sum()
    }
}
