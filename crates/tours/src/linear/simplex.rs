//! The dual simplex method for bounded variables over a growing and shrinking set of rows and columns.
//!
//! Minimise c·x, A x = b or A x ≥ b, lower ≤ x ≤ upper. Written for branch and cut: the basis stays dual feasible
//! when rows come, when bounds change, and when columns come (a column that prices out below zero enters at its
//! upper bound), so every solve continues from the one before. Dual steepest edge, Harris's ratio test (Koberstein
//! 2005). Nothing here is exact: what is proven from its duals is recomputed in integers by `exact_bound`.

use super::inverse::Inverse;
use crate::work::Work;
use traverse_solve::Interrupt;

/// How far a value may be outside its bounds.
const FEASIBLE: f64 = 1e-8;
/// The smallest entry that is pivoted on.
const PIVOT: f64 = 1e-7;
/// By how much the ratio test lets reduced costs go wrong for a better pivot.
const HARRIS: f64 = 1e-9;
/// Pivots between looks at how exact the inverse still is.
const REFRESH: u32 = 100;

/// How a solve ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Ending {
    /// The bounds hold everywhere.
    Optimal,
    /// No values do: added to the row duals any number of times, this raises the bound without end.
    Infeasible(Vec<f64>),
    /// The pivots were used up, or rounding got in the way.
    Unfinished,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Lower,
    Upper,
    Basic(usize),
}

#[derive(Clone, Debug)]
struct Column {
    cost: f64,
    lower: f64,
    upper: f64,
    entries: Vec<(usize, f64)>,
    /// The row whose slack this is.
    slack_of: Option<usize>,
}

/// A linear program and the basis of its last solve.
#[derive(Clone, Debug)]
pub(crate) struct Simplex {
    columns: Vec<Column>,
    right: Vec<f64>,
    slacks: Vec<usize>,
    state: State,
}

/// A basis and all that follows from it: what a trial solve puts back.
#[derive(Clone, Debug)]
pub(crate) struct State {
    places: Vec<Place>,
    reduced: Vec<f64>,
    basis: Vec<usize>,
    values: Vec<f64>,
    inverse: Inverse,
}

impl Simplex {
    /// Rows that must hold with equality, no columns yet but their slacks.
    pub(crate) fn new(right: &[f64]) -> Self {
        let size = right.len();
        let slack = |row| Column {
            cost: 0.0,
            lower: 0.0,
            upper: 0.0,
            entries: vec![(row, 1.0)],
            slack_of: Some(row),
        };
        Self {
            columns: (0..size).map(slack).collect(),
            right: right.to_vec(),
            slacks: (0..size).collect(),
            state: State {
                places: (0..size).map(Place::Basic).collect(),
                reduced: vec![0.0; size],
                basis: (0..size).collect(),
                values: right.to_vec(),
                inverse: Inverse::identity(size),
            },
        }
    }

    /// How many rows there are.
    pub(crate) fn rows(&self) -> usize {
        self.right.len()
    }

    /// A new column at whichever bound keeps the duals feasible; its number. `upper` is finite, `duals` are the
    /// current ones. Call `refresh_values` when all are there.
    pub(crate) fn add_column(
        &mut self,
        cost: f64,
        upper: f64,
        entries: Vec<(usize, f64)>,
        duals: &[f64],
    ) -> usize {
        let reduced = cost - entries.iter().map(|&(row, value)| duals[row] * value).sum::<f64>();
        self.columns.push(Column { cost, lower: 0.0, upper, entries, slack_of: None });
        self.state.reduced.push(reduced);
        self.state.places.push(if reduced < 0.0 { Place::Upper } else { Place::Lower });
        self.columns.len() - 1
    }

    /// A new row `entries · x ≥ right`, its slack basic.
    pub(crate) fn add_row(&mut self, entries: &[(usize, f64)], right: f64) {
        let row = self.rows();
        let mut basic = vec![];
        for &(column, value) in entries {
            self.columns[column].entries.push((row, value));
            if let Place::Basic(at) = self.state.places[column] {
                basic.push((at, value));
            }
        }
        let slack = self.columns.len();
        self.columns.push(Column {
            cost: 0.0,
            lower: f64::NEG_INFINITY,
            upper: 0.0,
            entries: vec![(row, 1.0)],
            slack_of: Some(row),
        });
        self.slacks.push(slack);
        self.right.push(right);
        self.state.inverse.extend(&basic);
        self.state.places.push(Place::Basic(row));
        self.state.reduced.push(0.0);
        self.state.basis.push(slack);
        let activity: f64 = entries.iter().map(|&(column, value)| self.value(column) * value).sum();
        self.state.values.push(right - activity);
    }

    /// Whether the row's slack is basic, so that the row says nothing now.
    pub(crate) fn is_loose(&self, row: usize) -> bool {
        matches!(self.state.places[self.slacks[row]], Place::Basic(_))
    }

    /// Takes rows out that are loose; the others move up. Their slack columns stay, empty, fixed at 0.
    pub(crate) fn remove_loose_rows(&mut self, remove: &[bool]) {
        let keep: Vec<bool> = remove.iter().map(|&remove| !remove).collect();
        let mut keep_basic = vec![true; self.rows()];
        for (row, &keep) in keep.iter().enumerate() {
            if let (false, Place::Basic(at)) = (keep, self.state.places[self.slacks[row]]) {
                keep_basic[at] = false;
            }
        }
        let mut moved = vec![usize::MAX; keep.len()];
        let mut next = 0;
        for (row, &keep) in keep.iter().enumerate() {
            if keep {
                moved[row] = next;
                next += 1;
            }
        }
        self.state.inverse.shrink(&keep, &keep_basic);
        for (row, &keep) in keep.iter().enumerate() {
            if !keep {
                let slack = self.slacks[row];
                self.state.places[slack] = Place::Lower;
                self.columns[slack].lower = 0.0;
                self.columns[slack].entries.clear();
                self.columns[slack].slack_of = None;
            }
        }
        for column in &mut self.columns {
            column.entries.retain(|&(row, _)| keep[row]);
            for entry in &mut column.entries {
                entry.0 = moved[entry.0];
            }
            column.slack_of = column.slack_of.map(|row| moved[row]);
        }
        let retained = |flags: &[bool], at: usize| flags[at];
        let filtered = |values: &[f64], flags: &[bool]| -> Vec<f64> {
            values
                .iter()
                .enumerate()
                .filter(|&(at, _)| retained(flags, at))
                .map(|(_, &value)| value)
                .collect()
        };
        self.right = filtered(&self.right, &keep);
        self.state.values = filtered(&self.state.values, &keep_basic);
        let slacks = self.slacks.iter().enumerate().filter(|&(row, _)| keep[row]);
        self.slacks = slacks.map(|(_, &slack)| slack).collect();
        let basis = self.state.basis.iter().enumerate().filter(|&(at, _)| keep_basic[at]);
        self.state.basis = basis.map(|(_, &column)| column).collect();
        for (at, &column) in self.state.basis.iter().enumerate() {
            self.state.places[column] = Place::Basic(at);
        }
    }

    /// New bounds of a column; call `refresh_values` when all are set.
    pub(crate) fn set_bounds(&mut self, column: usize, lower: f64, upper: f64) {
        self.columns[column].lower = lower;
        self.columns[column].upper = upper;
        if !matches!(self.state.places[column], Place::Basic(_)) {
            self.state.places[column] =
                if self.state.reduced[column] < 0.0 { Place::Upper } else { Place::Lower };
        }
    }

    /// The value of a column.
    pub(crate) fn value(&self, column: usize) -> f64 {
        match self.state.places[column] {
            Place::Basic(at) => self.state.values[at],
            Place::Lower => self.columns[column].lower,
            Place::Upper => self.columns[column].upper,
        }
    }

    /// The duals of all rows.
    pub(crate) fn duals(&self) -> Vec<f64> {
        let mut duals = vec![0.0; self.rows()];
        for (at, &column) in self.state.basis.iter().enumerate() {
            let cost = self.columns[column].cost;
            if cost != 0.0 {
                for (dual, value) in duals.iter_mut().zip(self.state.inverse.row(at)) {
                    *dual += cost * value;
                }
            }
        }
        duals
    }

    /// The cost at the current values: at the end of a solve the least cost, before it a lower bound.
    pub(crate) fn objective(&self) -> f64 {
        (0..self.columns.len())
            .filter(|&column| self.columns[column].cost != 0.0)
            .map(|column| self.columns[column].cost * self.value(column))
            .sum()
    }

    /// The basis, to come back to.
    pub(crate) fn state(&self) -> State {
        self.state.clone()
    }

    /// Back to a basis of the same rows and columns; call `refresh_values` when bounds have changed since.
    pub(crate) fn restore(&mut self, state: State) {
        self.state = state;
    }

    /// Basic values from the inverse and the bounds of all others.
    pub(crate) fn refresh_values(&mut self) {
        let right = self.right_for_basis();
        self.state.values = self.state.inverse.times_dense(&right);
    }

    fn right_for_basis(&self) -> Vec<f64> {
        let mut right = self.right.clone();
        for (column, place) in self.state.places.iter().enumerate() {
            let value = match place {
                Place::Basic(_) => continue,
                Place::Lower => self.columns[column].lower,
                Place::Upper => self.columns[column].upper,
            };
            if value != 0.0 {
                for &(row, entry) in &self.columns[column].entries {
                    right[row] -= entry * value;
                }
            }
        }
        right
    }

    /// Inverts the basis anew when it has lost precision. Whether there is a usable inverse.
    fn keep_exact(&mut self, work: &Work<'_>) -> Result<bool, Interrupt> {
        let right = self.right_for_basis();
        let mut residual = right.clone();
        self.state.values = self.state.inverse.times_dense(&right);
        for (at, &column) in self.state.basis.iter().enumerate() {
            for &(row, entry) in &self.columns[column].entries {
                residual[row] -= entry * self.state.values[at];
            }
        }
        let worst = residual.iter().fold(0.0_f64, |worst, value| worst.max(value.abs()));
        if worst <= FEASIBLE {
            return Ok(true);
        }
        let columns: Vec<Vec<(usize, f64)>> =
            self.state.basis.iter().map(|&column| self.columns[column].entries.clone()).collect();
        let Some((inverse, order)) = Inverse::of(&columns, work)? else { return Ok(false) };
        self.state.inverse = inverse;
        self.state.basis = order.iter().map(|&at| self.state.basis[at]).collect();
        for (at, &column) in self.state.basis.iter().enumerate() {
            self.state.places[column] = Place::Basic(at);
        }
        self.refresh_values();
        let duals = self.duals();
        for column in 0..self.columns.len() {
            self.state.reduced[column] = match self.state.places[column] {
                Place::Basic(_) => 0.0,
                _ => self.priced(column, &duals),
            };
        }
        Ok(true)
    }

    fn priced(&self, column: usize, duals: &[f64]) -> f64 {
        let entries = &self.columns[column].entries;
        self.columns[column].cost - entries.iter().map(|&(row, value)| duals[row] * value).sum::<f64>()
    }

    /// Pivots until the bounds hold everywhere, at most `limit` times.
    pub(crate) fn solve(&mut self, limit: u32, work: &Work<'_>) -> Result<Ending, Interrupt> {
        let mut alphas: Vec<(usize, f64)> = vec![];
        let mut column = vec![];
        let mut troubles = 0;
        for pivots in 0..limit {
            work.breathe()?;
            if pivots % REFRESH == REFRESH - 1 && !self.keep_exact(work)? {
                return Ok(Ending::Unfinished);
            }
            let Some((at, above)) = self.leaving() else {
                // The last word on feasibility belongs to freshly computed values.
                if pivots > 0 && !self.keep_exact(work)? {
                    return Ok(Ending::Unfinished);
                }
                if self.leaving().is_none() {
                    return Ok(Ending::Optimal);
                }
                troubles += 1;
                if troubles > 5 {
                    return Ok(Ending::Unfinished);
                }
                continue;
            };
            let sign = if above { 1.0 } else { -1.0 };
            let Some(entering) = self.entering(at, sign, &mut alphas) else {
                let ray = self.state.inverse.row(at).iter().map(|value| sign * value).collect();
                return Ok(Ending::Infeasible(ray));
            };
            self.state.inverse.times(&self.columns[entering].entries, &mut column);
            if column[at].abs() < PIVOT * 0.5 {
                troubles += 1;
                if troubles > 5 || !self.keep_exact(work)? {
                    return Ok(Ending::Unfinished);
                }
                continue;
            }
            self.exchange(at, above, entering, &column, &alphas);
        }
        Ok(Ending::Unfinished)
    }

    /// The basic column farthest outside its bounds, by steepest edge, and whether it is above.
    fn leaving(&self) -> Option<(usize, bool)> {
        let mut best = None;
        let mut most = 0.0;
        for (at, &column) in self.state.basis.iter().enumerate() {
            let value = self.state.values[at];
            let (below, above) = (self.columns[column].lower - value, value - self.columns[column].upper);
            let outside = below.max(above);
            if outside > FEASIBLE {
                let weight = outside * outside / self.state.inverse.lengths[at];
                if weight > most {
                    most = weight;
                    best = Some((at, above > below));
                }
            }
        }
        best
    }

    /// The column whose reduced cost is the first to reach 0; `alphas` gets the row's entries.
    fn entering(&self, at: usize, sign: f64, alphas: &mut Vec<(usize, f64)>) -> Option<usize> {
        let row = self.state.inverse.row(at);
        alphas.clear();
        let mut least = f64::INFINITY;
        for (column, place) in self.state.places.iter().enumerate() {
            let Column { lower, upper, ref entries, .. } = self.columns[column];
            if matches!(place, Place::Basic(_)) || entries.is_empty() {
                continue;
            }
            let alpha: f64 = entries.iter().map(|&(at, value)| row[at] * value).sum();
            if alpha.abs() < 1e-12 {
                continue;
            }
            alphas.push((column, alpha));
            let usable = if *place == Place::Lower { sign * alpha } else { -sign * alpha };
            if lower < upper && usable > PIVOT {
                least = least.min((self.state.reduced[column].abs() + HARRIS) / usable);
            }
        }
        let mut best = None;
        let mut largest = 0.0;
        for &(column, alpha) in alphas.iter() {
            let usable = if self.state.places[column] == Place::Lower { sign * alpha } else { -sign * alpha };
            let free = self.columns[column].lower < self.columns[column].upper;
            if free
                && usable > PIVOT
                && self.state.reduced[column].abs() / usable <= least
                && usable > largest
            {
                largest = usable;
                best = Some(column);
            }
        }
        best
    }

    fn exchange(&mut self, at: usize, above: bool, entering: usize, column: &[f64], alphas: &[(usize, f64)]) {
        let leaving = self.state.basis[at];
        let pivot = column[at];
        let dual_step = self.state.reduced[entering] / pivot;
        for &(other, alpha) in alphas {
            self.state.reduced[other] -= dual_step * alpha;
        }
        self.state.reduced[entering] = 0.0;
        self.state.reduced[leaving] = -dual_step;
        let bound = if above { self.columns[leaving].upper } else { self.columns[leaving].lower };
        let step = (self.state.values[at] - bound) / pivot;
        let entered = self.value(entering) + step;
        for (value, &entry) in self.state.values.iter_mut().zip(column) {
            *value -= step * entry;
        }
        self.state.values[at] = entered;
        self.state.inverse.pivot(at, column);
        self.state.places[leaving] = if above { Place::Upper } else { Place::Lower };
        self.state.places[entering] = Place::Basic(at);
        self.state.basis[at] = entering;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microlp::{ComparisonOp, OptimizationDirection, Problem};
    use rand::RngExt;
    use traverse_solve::{Budget, Seed};

    /// Values agree with an independent solver, however rows and bounds come and go.
    #[test]
    fn random_programs_have_the_cost_that_microlp_finds() {
        let budget = Budget::unlimited();
        let work = Work::new(&budget);
        let mut chance = Seed(3).stream();
        let (mut optimal, mut infeasible) = (0, 0);
        for _ in 0..300 {
            let (rows, columns) = (chance.random_range(1..4), chance.random_range(3..9));
            let right: Vec<f64> = (0..rows).map(|_| f64::from(chance.random_range(0..4))).collect();
            let mut simplex = Simplex::new(&right);
            let mut costs = vec![];
            let mut matrix: Vec<(Vec<f64>, bool, f64)> = right.iter().map(|&b| (vec![], true, b)).collect();
            let mut bounds = vec![];
            let mut numbers = vec![];
            for _ in 0..columns {
                let cost = f64::from(chance.random_range(-5..10));
                let upper = f64::from(chance.random_range(1..4));
                let entries: Vec<f64> = (0..rows).map(|_| f64::from(chance.random_range(0..2))).collect();
                let sparse = entries.iter().copied().enumerate().filter(|&(_, value)| value != 0.0).collect();
                let duals = simplex.duals();
                numbers.push(simplex.add_column(cost, upper, sparse, &duals));
                costs.push(cost);
                bounds.push((0.0, upper));
                for (row, value) in entries.into_iter().enumerate() {
                    matrix[row].0.push(value);
                }
            }
            simplex.refresh_values();
            for step in 0..4 {
                let ending = simplex.solve(1000, &work).expect("no limit");
                let mut problem = Problem::new(OptimizationDirection::Minimize);
                let variables: Vec<_> =
                    costs.iter().zip(&bounds).map(|(&cost, &bound)| problem.add_var(cost, bound)).collect();
                for (entries, equal, right) in &matrix {
                    let terms: Vec<_> = variables.iter().copied().zip(entries.iter().copied()).collect();
                    let sense = if *equal { ComparisonOp::Eq } else { ComparisonOp::Ge };
                    problem.add_constraint(&terms, sense, *right);
                }
                match problem.solve() {
                    Ok(outcome) => {
                        assert_eq!(ending, Ending::Optimal);
                        let expected = outcome.solution().expect("no limit").objective();
                        assert!((simplex.objective() - expected).abs() < 1e-6);
                        optimal += 1;
                    }
                    Err(_) => {
                        assert!(matches!(ending, Ending::Infeasible(_)), "{ending:?}");
                        infeasible += 1;
                        break;
                    }
                }
                if step == 1 {
                    let loose: Vec<bool> =
                        (0..simplex.rows()).map(|row| row >= rows && simplex.is_loose(row)).collect();
                    let mut at = 0;
                    matrix.retain(|_| {
                        at += 1;
                        !loose[at - 1]
                    });
                    simplex.remove_loose_rows(&loose);
                }
                if step == 2 {
                    let column = chance.random_range(0..columns);
                    bounds[column] = (1.0, 1.0);
                    simplex.set_bounds(numbers[column], 1.0, 1.0);
                    simplex.refresh_values();
                    continue;
                }
                let entries: Vec<f64> = (0..columns).map(|_| f64::from(chance.random_range(0..2))).collect();
                let right = f64::from(chance.random_range(0..3));
                let sparse: Vec<(usize, f64)> =
                    numbers.iter().copied().zip(entries.iter().copied()).filter(|&(_, v)| v != 0.0).collect();
                simplex.add_row(&sparse, right);
                matrix.push((entries, false, right));
            }
        }
        assert!(optimal > 300 && infeasible > 30, "{optimal} {infeasible}");
    }
}
