//! The linear relaxation that all nodes share: arcs with a column or still without one, rows for counts and cuts.

use super::tree::{Change, Node, cost_of};
use crate::cost::{Costs, FORBIDDEN};
use crate::cuts::crossing::Crossing;
use crate::cuts::support::{Support, UNUSED};
use crate::cuts::{connectivity, order};
use crate::euler::closed_walk;
use crate::exact_bound::{BoundedArc, Duals, ExactBound, PARTS};
use crate::linear::simplex::{Ending, Simplex};
use crate::network::Network;
use crate::progress::Progress;
use crate::work::Work;
use rand::RngExt;
use traverse_solve::{Interrupt, Seed};

/// Arcs out of each node, and into each, that have a column from the start.
const FIRST_COLUMNS: usize = 8;
/// Pivots for one solve before it counts as undecided.
const MOST_PIVOTS: u32 = 100_000;
/// Rounds of cuts at a node below the root.
const NODE_ROUNDS: u32 = 12;
/// Rounds without progress after which the root stops cutting.
const IDLE_ROUNDS: u32 = 6;
/// Arcs that are tried for branching, pivots for each try.
const TRIALS: usize = 8;
const TRIAL_PIVOTS: u32 = 25;

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
    counts: &'a [u32],
    /// Every arc that may still be used, with its bounds at the node.
    arcs: Vec<BoundedArc>,
    columns: Vec<Option<usize>>,
    arc_of_column: Vec<usize>,
    simplex: Simplex,
    cuts: Vec<Crossing>,
    /// Arcs whose bounds differ from the root's, with the root's.
    changed: Vec<(usize, u32, u32)>,
    shift_row: Vec<i64>,
    shift_column: Vec<i64>,
    perturbation: Vec<f64>,
    /// Costs of the linear program are in this unit.
    unit: f64,
    root: Option<(Duals, Vec<Crossing>)>,
    size: usize,
    costs: Vec<i64>,
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
        let spread = (0.02 / size as f64).max(largest as f64 * 1e-8);
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
        let duals = Duals {
            row: row.iter().map(|dual| dual * PARTS).collect(),
            column: column.iter().map(|dual| dual * PARTS).collect(),
            cuts: vec![],
        };
        let bound = ExactBound::of(relaxation.counts, &relaxation.arcs, &[], &duals);
        progress.raise_bound(bound.cost());
        relaxation.fix_arcs(&bound, progress.upper());
        relaxation.first_columns(&bound, progress);
        relaxation.root = Some((duals, vec![]));
        relaxation
    }

    fn first_columns(&mut self, bound: &ExactBound, progress: &Progress<'_>) {
        let open = (0..self.arcs.len()).filter(|&arc| self.arcs[arc].upper > 0);
        let key = |arc: usize| i64::try_from(bound.reduced[arc]).unwrap_or(i64::MAX);
        let mut by_cost: Vec<(i64, usize)> = open.map(|arc| (key(arc), arc)).collect();
        by_cost.sort_unstable();
        let (mut out, mut into) = (vec![0; self.size], vec![0; self.size]);
        let mut wanted = vec![false; self.arcs.len()];
        for (_, arc) in by_cost {
            let BoundedArc { from, to, .. } = self.arcs[arc];
            if out[from] < FIRST_COLUMNS || into[to] < FIRST_COLUMNS {
                out[from] += 1;
                into[to] += 1;
                wanted[arc] = true;
            }
        }
        if let Some((walk, _)) = progress.best() {
            let mut used = vec![false; self.size * self.size];
            for (at, &from) in walk.iter().enumerate() {
                used[from * self.size + walk[(at + 1) % walk.len()]] = true;
            }
            for (arc, wanted) in wanted.iter_mut().enumerate() {
                *wanted |= used[self.arcs[arc].from * self.size + self.arcs[arc].to];
            }
        }
        let duals = self.simplex.duals();
        for arc in (0..self.arcs.len()).filter(|&arc| wanted[arc]) {
            self.add_column(arc, &duals);
        }
        self.simplex.refresh_values();
    }

    fn add_column(&mut self, arc: usize, duals: &[f64]) {
        let BoundedArc { from, to, cost, lower, upper } = self.arcs[arc];
        let shifted = (cost - self.shift_row[from] - self.shift_column[to]) as f64 + self.perturbation[arc];
        let mut entries = vec![(from, 1.0), (self.size + to, 1.0)];
        for (at, cut) in self.cuts.iter().enumerate() {
            if cut.contains(from, to) {
                entries.push((2 * self.size + at, 1.0));
            }
        }
        let column = self.simplex.add_column(shifted / self.unit, f64::from(upper), entries, duals);
        if lower > 0 || upper == 0 {
            self.simplex.set_bounds(column, f64::from(lower), f64::from(upper));
        }
        self.columns[arc] = Some(column);
        self.arc_of_column.resize(column + 1, usize::MAX);
        self.arc_of_column[column] = arc;
    }

    /// Arcs that no cheaper tour can use are closed for good. Only with the root's bound.
    fn fix_arcs(&mut self, bound: &ExactBound, upper: i64) {
        if upper == i64::MAX {
            return;
        }
        for arc in 0..self.arcs.len() {
            if self.arcs[arc].upper > 0 && cost_of(bound.parts + bound.reduced[arc]) >= upper {
                self.arcs[arc].upper = 0;
                if let Some(column) = self.columns[arc] {
                    self.simplex.set_bounds(column, 0.0, 0.0);
                }
            }
        }
        self.simplex.refresh_values();
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
        if upper == i64::MAX { 0.0 } else { (upper - cost_of(parts)).max(0) as f64 * 0.01 }
    }

    fn keep_root(&mut self, bound: &ExactBound, duals: &Duals) {
        // The certificate has no bounds on arcs: whatever prices out below zero is taken off the columns' duals.
        let mut safe = duals.clone();
        for (arc, &reduced) in self.arcs.iter().zip(&bound.reduced) {
            let low = i64::try_from(reduced).unwrap_or(i64::MIN);
            let owed = duals.column[arc.to].saturating_add(low);
            if low < 0 {
                safe.column[arc.to] = safe.column[arc.to].min(owed);
            }
        }
        self.root = Some((safe, self.cuts.clone()));
    }

    /// Duals and cuts of the root.
    pub(super) fn root_duals(&self) -> (Duals, Vec<Crossing>) {
        self.root.clone().unwrap_or_default()
    }

    fn exact_duals(&self, duals: &[f64]) -> Duals {
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

    /// Columns for arcs that price out below zero. Whether there were any.
    fn price(&mut self, bound: &ExactBound, duals: &[f64]) -> bool {
        let tolerance = -i128::from(PARTS / 64);
        let mut missing: Vec<usize> = (0..self.arcs.len())
            .filter(|&arc| self.columns[arc].is_none() && self.arcs[arc].upper > 0)
            .filter(|&arc| bound.reduced[arc] < tolerance)
            .collect();
        missing.sort_by_key(|&arc| bound.reduced[arc]);
        missing.truncate(4 * self.size);
        for &arc in &missing {
            self.add_column(arc, duals);
        }
        if !missing.is_empty() {
            self.simplex.refresh_values();
        }
        !missing.is_empty()
    }

    /// Whether an infeasible program is so with all arcs, by whole numbers.
    fn refute(&mut self, ray: &[f64], upper: i64) -> Refuted {
        let duals = self.simplex.duals();
        let largest = self.costs.iter().map(|cost| cost.unsigned_abs()).max().unwrap_or(1) as f64;
        let visits: f64 = self.counts.iter().map(|&count| f64::from(count)).sum();
        let goal = if upper == i64::MAX { (largest * visits) as i64 + 1 } else { upper };
        let mut step = 1.0;
        for _ in 0..12 {
            let moved: Vec<f64> = duals.iter().zip(ray).map(|(dual, ray)| dual + step * ray).collect();
            let exact = self.exact_duals(&moved);
            let bound = ExactBound::of(self.counts, &self.arcs, &self.cuts, &exact);
            if bound.cost() >= goal {
                return Refuted::Yes;
            }
            let priced: Vec<usize> = (0..self.arcs.len())
                .filter(|&arc| self.columns[arc].is_none() && self.arcs[arc].upper > 0)
                .filter(|&arc| bound.reduced[arc] < 0)
                .take(4 * self.size)
                .collect();
            if !priced.is_empty() {
                for arc in priced {
                    self.add_column(arc, &duals);
                }
                self.simplex.refresh_values();
                return Refuted::ColumnsCame;
            }
            step *= 10.0;
        }
        Refuted::No
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

    /// The two sides of the arc that raises the bound most on both.
    pub(super) fn branch(&mut self, work: &Work<'_>) -> Result<Option<[Change; 2]>, Interrupt> {
        let mut open: Vec<(f64, usize, f64)> = (0..self.arcs.len())
            .filter_map(|arc| {
                let value = self.simplex.value(self.columns[arc]?);
                let from_half = (value - value.floor() - 0.5).abs();
                (from_half < 0.5 - 1e-6).then_some((from_half, arc, value))
            })
            .collect();
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
}

enum Refuted {
    Yes,
    ColumnsCame,
    No,
}
