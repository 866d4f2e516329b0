//! The linear relaxation that all nodes share: arcs with a column or still without one, rows for counts and cuts.

use super::pricing::Refuted;
use super::tree::{Change, Node, cost_of};
use crate::cost::{Costs, FORBIDDEN};
use crate::cuts::crossing::Crossing;
use crate::cuts::support::{Support, UNUSED};
use crate::cuts::{connectivity, order};
use crate::euler::closed_walk;
use crate::exact_bound::{BoundedArc, Duals, ExactBound, PARTS};
use crate::linear::dual_method::Ending;
use crate::linear::simplex::Simplex;
use crate::network::Network;
use crate::progress::Progress;
use crate::work::Work;
use rand::RngExt;
use traverse_solve::{Interrupt, Seed};

/// Pivots for one solve before it counts as undecided.
const MOST_PIVOTS: u32 = 100_000;
/// Rounds of cuts at a node below the root.
const NODE_ROUNDS: u32 = 12;
/// Rounds without progress after which the root stops cutting.
const IDLE_ROUNDS: u32 = 6;

/// What a node's relaxation said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relaxed {
    /// Nothing cheaper than the best known is in it.
    Pruned,
    /// It must be divided; no tour of it costs less than this.
    Fractional { parts: i128 },
    /// Rounding kept it from being decided.
    Undecided,
}

/// The linear relaxation.
pub(super) struct Relaxation<'a> {
    pub(super) counts: &'a [u32],
    /// Every arc that may still be used, with its bounds at the node.
    pub(super) arcs: Vec<BoundedArc>,
    pub(super) columns: Vec<Option<usize>>,
    pub(super) arc_of_column: Vec<usize>,
    pub(super) simplex: Simplex,
    pub(super) cuts: Vec<Crossing>,
    /// Arcs whose bounds differ from the root's, with the root's.
    pub(super) changed: Vec<(usize, u32, u32)>,
    pub(super) shift_row: Vec<i64>,
    pub(super) shift_column: Vec<i64>,
    pub(super) perturbation: Vec<f64>,
    /// Costs of the linear program are in this unit.
    pub(super) unit: f64,
    pub(super) root: Option<(Duals, Vec<Crossing>)>,
    pub(super) size: usize,
    pub(super) costs: Vec<i64>,
}

impl<'a> Relaxation<'a> {
    /// Arcs that duals and best cost leave, the cheapest of them with columns.
    pub(super) fn new(
        network: &'a Network,
        row: &[i64],
        column: &[i64],
        progress: &mut Progress<'_>,
    ) -> Self {
        let size = network.size;
        let mut arcs = vec![];
        for from in 0..size {
            for to in 0..size {
                let cost = network.cost(from, to);
                let most = network.counts[from].min(network.counts[to]);
                let upper = if from == to && size > 1 { most - 1 } else { most };
                if cost != FORBIDDEN && upper > 0 {
                    arcs.push(BoundedArc { from, to, cost, lower: 0, upper });
                }
            }
        }
        let reduced = |arc: &BoundedArc| arc.cost - row[arc.from] - column[arc.to];
        let largest = arcs.iter().map(reduced).max().unwrap_or(0).max(1);
        let unit = (largest as f64 / 1e4).max(1.0);
        let mut chance = Seed(0).stream();
        // All perturbations of a tour together stay below the step from one whole cost to the next.
        let spread = 0.02 / network.visits() as f64;
        let perturbation = arcs.iter().map(|_| chance.random_range(0.0..spread)).collect();
        let counts: Vec<f64> = network.counts.iter().map(|&count| f64::from(count)).collect();
        let mut relaxation = Self {
            counts: &network.counts,
            columns: vec![None; arcs.len()],
            arc_of_column: vec![],
            simplex: Simplex::new(&[counts.clone(), counts].concat()),
            cuts: vec![],
            changed: vec![],
            shift_row: row.to_vec(),
            shift_column: column.to_vec(),
            perturbation,
            unit,
            root: None,
            size,
            costs: arcs.iter().map(|arc| arc.cost).collect(),
            arcs,
        };
        let duals = Duals::of_whole(row, column);
        let bound = ExactBound::of(relaxation.counts, &relaxation.arcs, &[], &duals);
        progress.raise_bound(bound.cost());
        relaxation.fix_arcs(&bound, progress.upper());
        relaxation.first_columns(&bound, progress);
        relaxation.keep_root(&bound, &duals);
        relaxation
    }

    /// Sets the bounds of a node.
    pub(super) fn enter(&mut self, node: &Node) {
        for (arc, lower, upper) in std::mem::take(&mut self.changed) {
            self.set(arc, lower, upper);
        }
        for Change { arc, lower, upper } in node.changes() {
            if self.changed.iter().all(|&(other, ..)| other != arc) {
                self.changed.push((arc, self.arcs[arc].lower, self.arcs[arc].upper));
            }
            let (lower, upper) = (lower.max(self.arcs[arc].lower), upper.min(self.arcs[arc].upper));
            self.set(arc, lower, upper);
        }
        self.simplex.refresh_values();
    }

    fn set(&mut self, arc: usize, lower: u32, upper: u32) {
        self.arcs[arc].lower = lower;
        self.arcs[arc].upper = upper;
        if let Some(column) = self.columns[arc] {
            self.simplex.set_bounds(column, f64::from(lower), f64::from(upper));
        }
    }

    /// Solves, prices and cuts until the node is decided or must be divided.
    pub(super) fn relax(
        &mut self,
        node: &Node,
        network: &Network,
        progress: &mut Progress<'_>,
        work: &Work<'_>,
    ) -> Result<Relaxed, Interrupt> {
        if self.arcs.iter().any(|arc| arc.lower > arc.upper) {
            return Ok(Relaxed::Pruned);
        }
        let at_root = node.depth == 0;
        let mut parts = node.parts;
        let (mut rounds, mut idle, mut last) = (0_u32, 0_u32, f64::NEG_INFINITY);
        loop {
            match self.simplex.solve(MOST_PIVOTS, work)? {
                Ending::Unfinished => return Ok(Relaxed::Undecided),
                Ending::Infeasible(ray) => match self.refute(&ray, progress.upper()) {
                    Refuted::Yes => return Ok(Relaxed::Pruned),
                    Refuted::ColumnsCame => continue,
                    Refuted::No => return Ok(Relaxed::Undecided),
                },
                Ending::Optimal => {}
            }
            let duals = self.exact_duals(&self.simplex.duals());
            let bound = ExactBound::of(self.counts, &self.arcs, &self.cuts, &duals);
            if self.price(&bound, &self.simplex.duals()) {
                continue;
            }
            parts = parts.max(bound.parts);
            if at_root {
                progress.raise_bound(cost_of(parts));
                self.keep_root(&bound, &duals);
                self.fix_arcs(&bound, progress.upper());
            }
            if cost_of(parts) >= progress.upper() {
                return Ok(Relaxed::Pruned);
            }
            let support = self.support();
            let whole = support.is_whole();
            if whole && self.offer(&support, network, progress) && cost_of(parts) >= progress.upper() {
                if at_root {
                    progress.raise_bound(cost_of(parts));
                }
                return Ok(Relaxed::Pruned);
            }
            let mut found = connectivity::violated(&support, work)?;
            if let (true, false, Some(depot)) =
                (found.is_empty(), network.precedence.is_empty(), network.depot)
            {
                found = order::violated(&support, &network.precedence, depot, 2 * self.size, work)?;
            }
            let objective = self.simplex.objective() * self.unit;
            idle =
                if objective > last + 0.01 * (1.0 + self.distance(parts, progress)) { 0 } else { idle + 1 };
            last = last.max(objective);
            rounds += 1;
            let enough = if at_root { idle > IDLE_ROUNDS } else { rounds > NODE_ROUNDS || idle > 2 };
            if found.is_empty() || (enough && !whole) {
                return Ok(Relaxed::Fractional { parts });
            }
            self.add_cuts(found, work)?;
        }
    }

    /// A hundredth of what is still open, the yardstick of progress.
    fn distance(&self, parts: i128, progress: &mut Progress<'_>) -> f64 {
        let upper = progress.upper();
        if upper == i64::MAX { 0.0 } else { upper.saturating_sub(cost_of(parts)).max(0) as f64 * 0.01 }
    }

    fn keep_root(&mut self, bound: &ExactBound, duals: &Duals) {
        // The certificate has no bounds on arcs: whatever prices out below zero is taken off the columns' duals.
        let mut column: Vec<i128> = duals.column.iter().map(|&dual| i128::from(dual)).collect();
        for (arc, &reduced) in self.arcs.iter().zip(&bound.reduced) {
            if reduced < 0 {
                column[arc.to] = column[arc.to].min(i128::from(duals.column[arc.to]) + reduced);
            }
        }
        // What does not fit is left to the duals kept before: a dual that is cut off would ask too much.
        if let Ok(column) = column.into_iter().map(i64::try_from).collect() {
            self.root = Some((Duals { column, ..duals.clone() }, self.cuts.clone()));
        }
    }

    /// Duals and cuts of the root; nothing while none fitted.
    pub(super) fn root_duals(&self) -> Option<(Duals, Vec<Crossing>)> {
        self.root.clone()
    }

    pub(super) fn exact_duals(&self, duals: &[f64]) -> Duals {
        let parts = |shift: i64, dual: f64| {
            shift.saturating_mul(PARTS).saturating_add((dual * self.unit * PARTS as f64).round() as i64)
        };
        let size = self.size;
        Duals {
            row: (0..size).map(|node| parts(self.shift_row[node], duals[node])).collect(),
            column: (0..size).map(|node| parts(self.shift_column[node], duals[size + node])).collect(),
            cuts: (0..self.cuts.len())
                .map(|cut| (cut, parts(0, duals[2 * size + cut])))
                .filter(|&(_, weight)| weight > 0)
                .collect(),
        }
    }

    fn support(&self) -> Support {
        let used = (0..self.arcs.len()).filter_map(|arc| {
            let value = self.simplex.value(self.columns[arc]?);
            (value > UNUSED).then_some((self.arcs[arc].from, self.arcs[arc].to, value))
        });
        Support { size: self.size, arcs: used.collect() }
    }

    /// A whole solution that hangs together is a tour, and is offered. Whether it did.
    fn offer(&self, support: &Support, network: &Network, progress: &mut Progress<'_>) -> bool {
        let arcs: Vec<(usize, usize, u32)> =
            support.arcs.iter().map(|&(from, to, value)| (from, to, value.round() as u32)).collect();
        match closed_walk(self.size, &arcs) {
            Some(walk) if walk.len() == network.visits() => {
                progress.offer(network, &walk);
                true
            }
            _ => false,
        }
    }

    fn add_cuts(&mut self, found: Vec<Crossing>, work: &Work<'_>) -> Result<(), Interrupt> {
        if self.cuts.len() > 3 * self.size {
            self.drop_loose_cuts();
        }
        for cut in found {
            work.breathe()?;
            let entries: Vec<(usize, f64)> = (0..self.arcs.len())
                .filter(|&arc| cut.contains(self.arcs[arc].from, self.arcs[arc].to))
                .filter_map(|arc| Some((self.columns[arc]?, 1.0)))
                .collect();
            self.simplex.add_row(&entries, 1.0);
            self.cuts.push(cut);
        }
        Ok(())
    }

    fn drop_loose_cuts(&mut self) {
        let first = 2 * self.size;
        let loose: Vec<bool> =
            (0..self.simplex.rows()).map(|row| row >= first && self.simplex.is_loose(row)).collect();
        self.simplex.remove_loose_rows(&loose);
        let mut at = first;
        self.cuts.retain(|_| {
            at += 1;
            !loose[at - 1]
        });
    }
}
