//! The inverse of a basis as a dense matrix, row by row. A pivot costs O(m · rows it touches), which for tours is a
//! small part of m²; a few hundred rows fit into the cache.

use crate::work::Work;
use traverse_solve::Interrupt;

/// The inverse of a basis, with the squared length of each row (dual steepest edge comes for free from them).
#[derive(Clone, Debug, Default)]
pub(crate) struct Inverse {
    rows: Vec<Vec<f64>>,
    pub(crate) lengths: Vec<f64>,
}

/// Smaller entries are noise of cancellation.
const NOISE: f64 = 1e-13;

impl Inverse {
    pub(crate) fn identity(size: usize) -> Self {
        let mut rows = vec![vec![0.0; size]; size];
        for (at, row) in rows.iter_mut().enumerate() {
            row[at] = 1.0;
        }
        Self { rows, lengths: vec![1.0; size] }
    }

    pub(crate) fn row(&self, at: usize) -> &[f64] {
        &self.rows[at]
    }

    /// The product with a sparse column, as its non-zero entries.
    pub(crate) fn times(&self, column: &[(usize, f64)], product: &mut Vec<f64>) {
        product.clear();
        product.extend(self.rows.iter().map(|row| {
            let sum: f64 = column.iter().map(|&(at, value)| row[at] * value).sum();
            if sum.abs() < NOISE { 0.0 } else { sum }
        }));
    }

    /// The product with a dense column.
    pub(crate) fn times_dense(&self, column: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row.iter().zip(column).map(|(a, b)| a * b).sum()).collect()
    }

    /// Replaces the basic column at `at` by the one whose product with this inverse is `column`.
    pub(crate) fn pivot(&mut self, at: usize, column: &[f64]) {
        let mut pivot_row = std::mem::take(&mut self.rows[at]);
        let scale = 1.0 / column[at];
        let mut places = vec![];
        for (place, value) in pivot_row.iter_mut().enumerate() {
            if *value != 0.0 {
                *value *= scale;
                places.push(place);
            }
        }
        let dense = places.len() * 4 > pivot_row.len();
        for (other, row) in self.rows.iter_mut().enumerate() {
            let factor = column[other];
            if other == at || factor == 0.0 {
                continue;
            }
            if dense {
                let mut length = 0.0;
                for (value, &pivot) in row.iter_mut().zip(&pivot_row) {
                    *value -= factor * pivot;
                    length += *value * *value;
                }
                self.lengths[other] = length.max(NOISE);
            } else {
                let mut length = self.lengths[other];
                for &place in &places {
                    let old = row[place];
                    let mut new = old - factor * pivot_row[place];
                    if new.abs() < NOISE {
                        new = 0.0;
                    }
                    length += new * new - old * old;
                    row[place] = new;
                }
                self.lengths[other] = length.max(NOISE);
            }
        }
        self.lengths[at] = pivot_row.iter().map(|value| value * value).sum::<f64>().max(NOISE);
        self.rows[at] = pivot_row;
    }

    /// One more row of the problem, basic in itself; `basic` are its entries at the basic columns.
    pub(crate) fn extend(&mut self, basic: &[(usize, f64)]) {
        let size = self.rows.len();
        let mut last = vec![0.0; size + 1];
        for &(at, entry) in basic {
            for (sum, value) in last.iter_mut().zip(&self.rows[at]) {
                *sum -= entry * value;
            }
        }
        for row in &mut self.rows {
            row.push(0.0);
        }
        last[size] = 1.0;
        self.lengths.push(last.iter().map(|value| value * value).sum());
        self.rows.push(last);
    }

    /// Takes rows out whose own columns are basic; `keep` by problem row, `keep_basic` by place in the basis.
    pub(crate) fn shrink(&mut self, keep: &[bool], keep_basic: &[bool]) {
        let mut at = 0;
        self.rows.retain(|_| {
            at += 1;
            keep_basic[at - 1]
        });
        for row in &mut self.rows {
            let mut place = 0;
            row.retain(|_| {
                place += 1;
                keep[place - 1]
            });
        }
        self.lengths = self.rows.iter().map(|row| row.iter().map(|value| value * value).sum()).collect();
    }

    /// The inverse of the given columns, by elimination. The columns' order changes: the answer says which column
    /// is basic where. Nothing when they are dependent.
    pub(crate) fn of(
        columns: &[Vec<(usize, f64)>],
        work: &Work<'_>,
    ) -> Result<Option<(Self, Vec<usize>)>, Interrupt> {
        let size = columns.len();
        let mut inverse = Self::identity(size);
        let mut taken = vec![usize::MAX; size];
        // Sparse columns first: they fill in least.
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by_key(|&column| columns[column].len());
        let mut product = vec![];
        for column in order {
            work.breathe()?;
            inverse.times(&columns[column], &mut product);
            let best = (0..size)
                .filter(|&at| taken[at] == usize::MAX)
                .max_by(|&a, &b| product[a].abs().total_cmp(&product[b].abs()));
            let Some(at) = best.filter(|&at| product[at].abs() > 1e-9) else { return Ok(None) };
            taken[at] = column;
            inverse.pivot(at, &product);
        }
        Ok(Some((inverse, taken)))
    }
}
