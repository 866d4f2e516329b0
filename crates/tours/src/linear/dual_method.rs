//! The dual simplex method itself: which column leaves, which enters, and how the basis stays exact. Dual steepest
//! edge and Harris's ratio test (Koberstein 2005); a pivot costs a product with every column and an update of the
//! inverse.

use super::inverse::Inverse;
use super::simplex::{Column, Place, Simplex};
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

impl Simplex {
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
}
