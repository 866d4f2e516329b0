//! Which arcs have a column in the linear program: cheap ones from the start, others when their duals ask for them,
//! and none that no cheaper tour can use.

use super::relaxation::Relaxation;
use super::tree::cost_of;
use crate::exact_bound::{BoundedArc, ExactBound, PARTS};
use crate::progress::Progress;

/// Arcs out of each node, and into each, that have a column from the start.
const FIRST_COLUMNS: usize = 8;

/// Steps along a ray, each ten times the one before: the last reaches from the least sum of costs to the largest.
const RAY_STEPS: u32 = 15;

/// Whether an infeasible program stays so with all arcs.
pub(super) enum Refuted {
    Yes,
    ColumnsCame,
    No,
}

impl Relaxation<'_> {
    pub(super) fn first_columns(&mut self, bound: &ExactBound, progress: &Progress<'_>) {
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

    pub(super) fn add_column(&mut self, arc: usize, duals: &[f64]) {
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
    pub(super) fn fix_arcs(&mut self, bound: &ExactBound, upper: i64) {
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

    /// Columns for arcs that price out below zero. Whether there were any.
    pub(super) fn price(&mut self, bound: &ExactBound, duals: &[f64]) -> bool {
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

    /// What no tour costs: more than the dearest arc out of every node.
    fn more_than_any_tour(&self) -> i64 {
        let mut dearest = vec![i64::MIN; self.size];
        for (arc, &cost) in self.arcs.iter().zip(&self.costs) {
            dearest[arc.from] = dearest[arc.from].max(cost);
        }
        let out = dearest.iter().zip(self.counts).map(|(&cost, &count)| i128::from(cost) * i128::from(count));
        out.sum::<i128>().clamp(i128::from(i64::MIN), i128::from(i64::MAX / 4)) as i64 + 1
    }

    /// Whether an infeasible program is so with all arcs, by whole numbers.
    pub(super) fn refute(&mut self, ray: &[f64], upper: i64) -> Refuted {
        let duals = self.simplex.duals();
        let goal = if upper == i64::MAX { self.more_than_any_tour() } else { upper };
        let mut step = 1.0;
        for _ in 0..RAY_STEPS {
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
}
