//! Local search on a network, guided by duals, that goes on from the best tour known: what the ladder calls between
//! proofs, and beside them.

use crate::cost::Costs;
use crate::local_search::LocalSearch;
use crate::neighbours::Neighbours;
use crate::network::Network;
use crate::patching::patch;
use crate::progress::Progress;
use crate::sequential::search::{SequentialSearch, greedy_order};
use crate::visits::{GuideCosts, Visits};
use crate::work::Work;
use traverse_solve::{Interrupt, Seed};

/// Arcs out of a node that local search looks at.
const WIDTH: usize = 12;
/// What part of the arcs' mean cost beyond the duals a kept tour may be dearer. 0.05 to 0.4 do equally well.
const TEMPER: f64 = 0.1;
/// Kicks between two looks at what others have found.
const BURST: u64 = 500;

/// Local search on a network.
#[derive(Debug)]
pub(crate) struct GuidedSearch<'a> {
    network: &'a Network,
    visits: &'a Visits<'a>,
    guide: GuideCosts<'a, Visits<'a>>,
    neighbours: Neighbours,
    seed: Seed,
    runs: u64,
}

impl<'a> GuidedSearch<'a> {
    /// Guided by duals of visits.
    pub(crate) fn new(
        network: &'a Network,
        visits: &'a Visits<'a>,
        duals: (&'a [i64], &'a [i64]),
        seed: Seed,
        work: &Work<'_>,
    ) -> Result<Self, Interrupt> {
        let guide = GuideCosts::of(visits, duals.0, duals.1, work)?;
        let neighbours = Neighbours::cheapest(&guide, WIDTH, work)?;
        Ok(Self { network, visits, guide, neighbours, seed, runs: 0 })
    }

    /// A first tour: the assignment's circles joined, or with an order to keep the cheapest next node at a time.
    pub(crate) fn first_tour(
        &self,
        successor: &[usize],
        progress: &mut Progress<'_>,
        work: &Work<'_>,
    ) -> Result<Vec<usize>, Interrupt> {
        let order = match self.network.depot {
            Some(depot) if !self.network.precedence.is_empty() => {
                greedy_order(&self.guide, &self.network.precedence, depot)
            }
            _ => patch(&self.guide, successor, work)?,
        };
        progress.offer(self.network, &self.visits.walk(&order));
        Ok(order)
    }

    /// Improves the best tour known, or `otherwise` while none is, until the kicks are used up or cost and bound
    /// meet.
    pub(crate) fn improve(
        &mut self,
        kicks: u64,
        otherwise: &[usize],
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<(), Interrupt> {
        self.runs += 1;
        progress.upper();
        let chance = self.seed.part(self.runs).stream();
        let mut order = match progress.best() {
            Some((walk, _)) => self.visits.order(walk),
            None => otherwise.to_vec(),
        };
        let temper = self.temper(&order);
        if self.network.precedence.is_empty() {
            let mut search = LocalSearch::new(&self.guide, &self.neighbours, order, chance);
            search.loosen(temper);
            let mut done = search.descend(work);
            let mut left = kicks;
            loop {
                progress.offer(self.network, &self.visits.walk(search.best().0));
                done?;
                if left == 0 || progress.is_proven() {
                    return Ok(());
                }
                done = search.kicks(left.min(BURST), work);
                left -= left.min(BURST);
            }
        }
        let begin = order.iter().position(|&visit| Some(visit) == self.network.depot).unwrap_or(0);
        order.rotate_left(begin);
        let mut search = SequentialSearch::new(&self.guide, &self.network.precedence, order, chance);
        search.loosen(temper);
        let mut done = search.descend(work);
        let mut left = kicks;
        loop {
            progress.offer(self.network, search.best().0);
            done?;
            if left == 0 || progress.is_proven() {
                return Ok(());
            }
            done = search.kicks(left.min(BURST), work);
            left -= left.min(BURST);
        }
    }

    /// How much dearer a tour may get: a small part of what its arcs cost beyond the duals, on average.
    fn temper(&self, order: &[usize]) -> f64 {
        let arcs = order.iter().zip(order.iter().cycle().skip(1));
        let total: f64 = arcs.map(|(&from, &to)| self.guide.cost(from, to) as f64).sum();
        TEMPER * total / order.len() as f64
    }
}
