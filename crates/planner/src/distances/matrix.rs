//! Costs from points to points while they are worked out.

/// Costs, row by row; infinity where no way is known.
pub(super) struct Matrix {
    rows: usize,
    columns: usize,
    costs: Vec<f64>,
    /// Entry (i, j) stands for (j, i) too.
    is_symmetric: bool,
}

impl Matrix {
    pub(super) fn new(rows: usize, columns: usize, is_symmetric: bool) -> Self {
        Self { rows, columns, costs: vec![f64::INFINITY; rows * columns], is_symmetric }
    }

    /// Pairs that are to be worked out and for which no way is known, in order.
    pub(super) fn open(&self) -> Vec<(usize, usize)> {
        let first = |row: usize| if self.is_symmetric { row } else { 0 };
        let pairs =
            (0..self.rows).flat_map(|row| (first(row)..self.columns).map(move |column| (row, column)));
        pairs.filter(|&(row, column)| self.cost(row, column) == f64::INFINITY).collect()
    }

    pub(super) fn is_full(&self) -> bool {
        self.costs.iter().all(|cost| cost.is_finite())
    }

    pub(super) fn cost(&self, row: usize, column: usize) -> f64 {
        self.costs[row * self.columns + column]
    }

    /// Takes note of a way.
    pub(super) fn lower(&mut self, row: usize, column: usize, cost: f64) {
        let mut at = |row: usize, column: usize| {
            let known = &mut self.costs[row * self.columns + column];
            *known = known.min(cost);
        };
        at(row, column);
        if self.is_symmetric {
            at(column, row);
        }
    }

    pub(super) fn into_costs(self) -> Vec<f64> {
        self.costs
    }
}
