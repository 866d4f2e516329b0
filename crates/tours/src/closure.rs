//! The metric closure: the cheapest way from each type to each through any others, and what visiting every type at
//! least as often as asked costs along such ways.
//!
//! A type whose copies follow one another for nothing need be entered only once: any further visit between two
//! others costs no less than the way between those. Its digit in the dynamic program becomes a bit. What the
//! program finds is a bound for every tour, and where its ways pass through no type more often than there are
//! visits to make, it is a tour. Floyd (1962), O(n³), then the program over counts.

use crate::cost::{Costs, FORBIDDEN};
use crate::count_program::{CountProgram, Walk};
use crate::network::Network;
use crate::precedence::Precedence;
use crate::work::Work;
use traverse_solve::Interrupt;

/// The cheapest ways between types.
#[derive(Clone, Debug)]
pub(crate) struct Closure<'a> {
    network: &'a Network,
    costs: Vec<i64>,
    /// The first type after `from` on the way; of equal ways one with the fewest arcs is taken.
    through: Vec<usize>,
    counts: Vec<u32>,
}

/// What the closure says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ClosureBound {
    /// No tour costs less.
    pub(crate) bound: i64,
    /// A walk that visits every type as often as asked, mostly from the bound's ways.
    pub(crate) walk: Vec<usize>,
}

impl<'a> Closure<'a> {
    /// The closure, nothing when a cost is negative or an order is to be kept.
    pub(crate) fn of(network: &'a Network, work: &Work<'_>) -> Result<Option<Self>, Interrupt> {
        let size = network.size;
        let mut costs = vec![FORBIDDEN; size * size];
        let mut hops = vec![u32::MAX; size * size];
        let mut through = vec![usize::MAX; size * size];
        for from in 0..size {
            for to in 0..size {
                let at = from * size + to;
                costs[at] = network.cost(from, to);
                (hops[at], through[at]) = (1, to);
                if costs[at] < 0 {
                    return Ok(None);
                }
            }
        }
        if !network.precedence.is_empty() {
            return Ok(None);
        }
        for mid in 0..size {
            work.breathe()?;
            for from in 0..size {
                let first = costs[from * size + mid];
                if first == FORBIDDEN {
                    continue;
                }
                for to in 0..size {
                    let (second, at) = (costs[mid * size + to], from * size + to);
                    if second == FORBIDDEN {
                        continue;
                    }
                    let steps = hops[from * size + mid] + hops[mid * size + to];
                    if (first + second, steps) < (costs[at], hops[at]) {
                        costs[at] = first + second;
                        hops[at] = steps;
                        through[at] = through[from * size + mid];
                    }
                }
            }
        }
        let once = |node: usize| if costs[node * size + node] == 0 { 1 } else { network.counts[node] };
        let counts = (0..size).map(once).collect();
        Ok(Some(Self { network, costs, through, counts }))
    }

    fn program<'b>(&'b self, none: &'b Precedence) -> CountProgram<'b> {
        // The type with the most visits loses one digit when the walk begins there.
        let begin = (0..self.network.size).max_by_key(|&node| self.counts[node]).unwrap_or(0);
        CountProgram { costs: &self.costs, counts: &self.counts, begin, precedence: none }
    }

    /// How many bytes the dynamic program takes.
    pub(crate) fn bytes(&self) -> u64 {
        self.program(&Precedence::none(self.network.size)).bytes()
    }

    /// The bound and a walk, nothing when there is no tour.
    pub(crate) fn bound(&self, work: &Work<'_>) -> Result<Option<ClosureBound>, Interrupt> {
        let none = Precedence::none(self.network.size);
        Ok(match self.program(&none).solve(work)? {
            Walk::None => None,
            Walk::Cheapest(walk, bound) => Some(ClosureBound { bound, walk: self.expanded(&walk) }),
        })
    }

    /// Ways drawn out, visits beyond the counts left out, missing ones made where the type is met first.
    fn expanded(&self, walk: &[usize]) -> Vec<usize> {
        let size = self.network.size;
        let mut long = vec![];
        for (at, &from) in walk.iter().enumerate() {
            let to = walk[(at + 1) % walk.len()];
            long.push(from);
            let mut node = self.through[from * size + to];
            while node != to && node < size && long.len() < size * size + walk.len() {
                long.push(node);
                node = self.through[node * size + to];
            }
        }
        let mut met = vec![0_u32; size];
        long.iter().for_each(|&node| met[node] += 1);
        let mut left = self.network.counts.clone();
        let mut visits = vec![];
        for &node in &long {
            let more = if met[node] < left[node] { left[node] - met[node] + 1 } else { 1 };
            met[node] -= 1;
            for _ in 0..more.min(left[node]) {
                visits.push(node);
                left[node] -= 1;
            }
        }
        visits
    }
}
