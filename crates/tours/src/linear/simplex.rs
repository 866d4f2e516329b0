//! A linear program for the dual simplex method with bounded variables, over a growing and shrinking set of rows and columns.
//!
//! Minimise c·x, A x = b or A x ≥ b, lower ≤ x ≤ upper. Written for branch and cut: the basis stays dual feasible
//! when rows come, when bounds change, and when columns come (a column that prices out below zero enters at its
//! upper bound), so every solve continues from the one before. Nothing here is exact: what is proven from its duals is recomputed in integers by `exact_bound`.

use super::inverse::Inverse;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Lower,
    Upper,
    Basic(usize),
}

#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) cost: f64,
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) entries: Vec<(usize, f64)>,
    /// The row whose slack this is.
    pub(super) slack_of: Option<usize>,
}

/// A linear program and the basis of its last solve.
#[derive(Clone, Debug)]
pub(crate) struct Simplex {
    pub(super) columns: Vec<Column>,
    pub(super) right: Vec<f64>,
    pub(super) slacks: Vec<usize>,
    pub(super) state: State,
}

/// A basis and all that follows from it: what a trial solve puts back.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(super) places: Vec<Place>,
    pub(super) reduced: Vec<f64>,
    pub(super) basis: Vec<usize>,
    pub(super) values: Vec<f64>,
    pub(super) inverse: Inverse,
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

    pub(super) fn right_for_basis(&self) -> Vec<f64> {
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

    pub(super) fn priced(&self, column: usize, duals: &[f64]) -> f64 {
        let entries = &self.columns[column].entries;
        self.columns[column].cost - entries.iter().map(|&(row, value)| duals[row] * value).sum::<f64>()
    }
}
