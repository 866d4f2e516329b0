//! On which arc a node is divided: a few pivots on both sides of each of the most undecided arcs show which raises the
//! bound most (strong branching; Applegate, Bixby, Chvátal, Cook 1995).

use super::relaxation::Relaxation;
use super::tree::Change;
use crate::euler::closed_walk;
use crate::exact_bound::BoundedArc;
use crate::linear::dual_method::Ending;
use crate::network::Network;
use crate::progress::Progress;
use crate::work::Work;
use traverse_solve::Interrupt;

/// Arcs that are tried for branching, pivots for each try.
const TRIALS: usize = 8;
const TRIAL_PIVOTS: u32 = 25;

impl Relaxation<'_> {
    /// The two sides of the arc that raises the bound most on both.
    pub(super) fn branch(&mut self, work: &Work<'_>) -> Result<Option<[Change; 2]>, Interrupt> {
        let mut open: Vec<(f64, usize, f64)> = (0..self.arcs.len())
            .filter_map(|arc| {
                let value = self.simplex.value(self.columns[arc]?);
                let from_half = (value - value.floor() - 0.5).abs();
                (from_half < 0.5 - 1e-6).then_some((from_half, arc, value))
            })
            .collect();
        if open.is_empty() {
            return Ok(self.whole_branch());
        }
        open.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        open.truncate(TRIALS);
        let state = self.simplex.state();
        let start = self.simplex.objective();
        let mut best = None;
        for &(_, arc, value) in &open {
            let BoundedArc { lower, upper, .. } = self.arcs[arc];
            let down = Change { arc, lower, upper: value.floor() as u32 };
            let up = Change { arc, lower: value.floor() as u32 + 1, upper };
            let mut rises = [0.0; 2];
            if open.len() > 1 {
                for (rise, side) in rises.iter_mut().zip([down, up]) {
                    if let Some(column) = self.columns[arc] {
                        self.simplex.set_bounds(column, f64::from(side.lower), f64::from(side.upper));
                        self.simplex.refresh_values();
                        *rise = match self.simplex.solve(TRIAL_PIVOTS, work)? {
                            Ending::Infeasible(_) => 1e9,
                            _ => (self.simplex.objective() - start).max(1e-6),
                        };
                        self.simplex.set_bounds(column, f64::from(lower), f64::from(upper));
                        self.simplex.restore(state.clone());
                    }
                }
            }
            let score = rises[0] * rises[1];
            if best.is_none_or(|(most, _)| score > most) {
                best = Some((score, [down, up]));
            }
        }
        Ok(best.map(|(_, sides)| sides))
    }

    /// A tour whose cost rounding keeps apart from its bound is pinned down arc by arc: where all are, the bound is
    /// its cost exactly.
    fn whole_branch(&self) -> Option<[Change; 2]> {
        (0..self.arcs.len()).find_map(|arc| {
            let value = self.simplex.value(self.columns[arc]?).round() as u32;
            let BoundedArc { lower, upper, .. } = self.arcs[arc];
            if value > lower {
                Some([Change { arc, lower, upper: value - 1 }, Change { arc, lower: value, upper }])
            } else if value < upper && value > 0 {
                Some([Change { arc, lower, upper: value }, Change { arc, lower: value + 1, upper }])
            } else {
                None
            }
        })
    }

    /// Two halves of a node that rounding kept from being decided: nothing is lost, and each is smaller. Nothing when
    /// every arc is pinned down already.
    pub(super) fn halve(&self) -> Option<[Change; 2]> {
        let open = |arc: &usize| self.arcs[*arc].lower < self.arcs[*arc].upper;
        let arc = (0..self.arcs.len()).find(open)?;
        let BoundedArc { lower, upper, .. } = self.arcs[arc];
        let middle = lower + (upper - lower) / 2;
        Some([Change { arc, lower, upper: middle }, Change { arc, lower: middle + 1, upper }])
    }

    /// Decides a node whose arcs are all pinned down, without any solver: they are a tour, which is offered, or none.
    pub(super) fn decide_pinned(&self, network: &Network, progress: &mut Progress<'_>) {
        let used: Vec<(usize, usize, u32)> =
            self.arcs.iter().filter(|arc| arc.lower > 0).map(|arc| (arc.from, arc.to, arc.lower)).collect();
        let (mut out, mut into) = (vec![0; self.size], vec![0; self.size]);
        for &(from, to, count) in &used {
            out[from] += count;
            into[to] += count;
        }
        if out == self.counts
            && into == self.counts
            && let Some(walk) = closed_walk(self.size, &used)
        {
            progress.offer(network, &walk);
        }
    }
}
