//! A flat bucket grid over boxes and thick segments: which of them may lie near a straight line, in order along it.
//!
//! Every cell holds the list of the items that reach into it. Lists are linked, so items come and go at any time; an
//! item that is gone is the caller's to pass over. The cells' proportions follow the items' directions, so that a comb
//! of long thin teeth has cells as narrow as its teeth.
//!
//! Cost: an item enters as many cells as it reaches, on average a few; a line visits the cells that it passes.

use std::ops::{ControlFlow, RangeInclusive};
use traverse_geometry::{Bounds, Point, Vector};

/// Cells per item.
const CELLS_PER_ITEM: f64 = 2.0;

/// Most cells that an item enters, on average.
const ENTRIES_PER_ITEM: f64 = 4.0;

/// Most columns or rows.
const SIDE_LIMIT: f64 = 4096.0;

/// Lines and items are taken wider by this share of the grid's extent: far above rounding.
const ROUNDING_RATIO: f64 = 1e-9;

/// No entry.
const NONE: u32 = u32::MAX;

/// What a grid is to hold: decides about the cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load {
    bounds: Bounds,
    count: f64,
    /// Sums of widths, heights and reaches.
    across: Vector,
    reach: f64,
}

impl Load {
    pub(crate) const NONE: Self =
        Self { bounds: Bounds::EMPTY, count: 0.0, across: Vector::new(0.0, 0.0), reach: 0.0 };

    /// Adds a box grown by `reach`.
    pub(crate) fn add(&mut self, bounds: &Bounds, reach: f64) {
        self.bounds = self.bounds.union(*bounds);
        self.count += 1.0;
        self.across += bounds.size();
        self.reach += reach;
    }
}

/// Lists of items by cell.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    min: Point,
    /// Width and height of a cell, and one over both.
    cell: Vector,
    per_cell: Vector,
    columns: usize,
    rows: usize,
    rounding: f64,
    /// Per cell its first entry.
    first: Vec<u32>,
    entries: Vec<Entry>,
    /// Items that reach beyond the cells: looked at always.
    outside: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    item: u32,
    next: u32,
}

impl Grid {
    /// An empty grid for such a load.
    pub(crate) fn new(load: &Load) -> Self {
        if load.count == 0.0 {
            return Self::of(Point::origin(), Vector::repeat(1.0), 0, 0);
        }
        let reach = load.reach / load.count;
        let bounds = load.bounds.grown(2.0 * reach);
        // Never flat: a single point has an extent too.
        let size = bounds.size() + Vector::repeat(1e-3 + 1e-9 * bounds.max.coords.amax());
        let across = load.across + Vector::repeat(load.reach + 1e-9 * load.across.amax() + 1e-9);
        let limit = (ENTRIES_PER_ITEM * load.count / 2.0).powi(2) * (size.x / across.x) * (size.y / across.y);
        let cells = (CELLS_PER_ITEM * load.count).min(limit).max(1.0);
        let columns = (cells * (size.x / size.y) * (across.y / across.x)).sqrt();
        let fit = |count: f64, size: f64| count.min(size / (2.0 * reach)).clamp(1.0, SIDE_LIMIT).ceil();
        let columns = fit(columns, size.x);
        let rows = fit(cells / columns, size.y);
        let cell = Vector::new(size.x / columns, size.y / rows);
        Self::of(bounds.min, cell, columns as usize, rows as usize)
    }

    fn of(min: Point, cell: Vector, columns: usize, rows: usize) -> Self {
        let extent = cell.x * columns as f64 + cell.y * rows as f64 + min.coords.amax();
        Self {
            min,
            cell,
            per_cell: Vector::new(1.0 / cell.x, 1.0 / cell.y),
            columns,
            rows,
            rounding: extent * ROUNDING_RATIO,
            first: vec![NONE; columns * rows],
            entries: Vec::new(),
            outside: Vec::new(),
        }
    }

    /// An empty grid of the same cells.
    pub(crate) fn same_cells(&self) -> Self {
        Self { first: vec![NONE; self.first.len()], entries: Vec::new(), outside: Vec::new(), ..*self }
    }

    /// Columns and rows.
    pub(crate) fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Width and height of a cell.
    pub(crate) fn cell(&self) -> Vector {
        self.cell
    }

    /// The middle of a cell; columns and rows may lie beyond the grid's.
    pub(crate) fn middle(&self, column: i64, row: i64) -> Point {
        self.min + Vector::new((column as f64 + 0.5) * self.cell.x, (row as f64 + 0.5) * self.cell.y)
    }

    /// The column and row of a point, which may lie beyond the grid's.
    pub(crate) fn cell_at(&self, p: Point) -> [i64; 2] {
        let by = (p - self.min).component_mul(&self.per_cell);
        // A cast from a float saturates.
        [by.x.floor() as i64, by.y.floor() as i64]
    }

    /// Items that reach beyond the cells.
    pub(crate) fn outside(&self) -> &[u32] {
        &self.outside
    }

    /// The items of a cell of the grid, some of them more than once.
    pub(crate) fn items(&self, column: usize, row: usize) -> impl Iterator<Item = u32> {
        let mut at = self.first[row * self.columns + column];
        std::iter::from_fn(move || {
            let entry = self.entries.get(at as usize)?;
            at = entry.next;
            Some(entry.item)
        })
    }

    /// Adds the thick segment from `from` to `to` as `item`; an item may be added in several pieces.
    pub(crate) fn insert(&mut self, item: u32, from: Point, to: Point, reach: f64) {
        if !self.holds(from, reach) || !self.holds(to, reach) {
            if self.outside.last() != Some(&item) {
                self.outside.push(item);
            }
            return;
        }
        for row in self.rows_between(from, to, reach) {
            for column in self.columns_in(row, from, to, reach) {
                self.enter(row, column, item);
            }
        }
    }

    /// How many cells a box grown by `reach` would enter.
    pub(crate) fn cells_of(&self, bounds: &Bounds, reach: f64) -> f64 {
        let size = bounds.size() + Vector::repeat(2.0 * reach);
        (size.x * self.per_cell.x + 1.0) * (size.y * self.per_cell.y + 1.0)
    }

    /// Adds a box grown by `reach` as `item`.
    pub(crate) fn insert_box(&mut self, item: u32, bounds: &Bounds, reach: f64) {
        if !self.holds(bounds.min, reach) || !self.holds(bounds.max, reach) {
            self.outside.push(item);
            return;
        }
        let (columns, rows) = self.cells_in(&bounds.grown(reach));
        for row in rows {
            for column in columns.clone() {
                self.enter(row, column, item);
            }
        }
    }

    fn enter(&mut self, row: usize, column: usize, item: u32) {
        let first = &mut self.first[row * self.columns + column];
        self.entries.push(Entry { item, next: *first });
        *first = self.entries.len() as u32 - 1;
    }

    fn holds(&self, p: Point, reach: f64) -> bool {
        let by = p - self.min;
        let size = Vector::new(self.cell.x * self.columns as f64, self.cell.y * self.rows as f64);
        by.x >= reach && by.y >= reach && by.x + reach <= size.x && by.y + reach <= size.y
    }

    /// Shows `visit` every item that may lie near the line from `from` to `to`, roughly in order, some of them more
    /// than once, until it breaks off.
    pub(crate) fn along(
        &self,
        from: Point,
        to: Point,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for &item in &self.outside {
            visit(item)?;
        }
        let rows = self.rows_between(from, to, 0.0);
        let (upwards, rightwards) = (to.y >= from.y, to.x >= from.x);
        for row in in_order(rows, upwards) {
            for column in in_order(self.columns_in(row, from, to, 0.0), rightwards) {
                self.visit_cell(row, column, &mut visit)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Shows `visit` every item that may reach into the box, some of them more than once, until it breaks off.
    pub(crate) fn within(
        &self,
        bounds: &Bounds,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for &item in &self.outside {
            visit(item)?;
        }
        let (columns, rows) = self.cells_in(bounds);
        for row in rows {
            for column in columns.clone() {
                self.visit_cell(row, column, &mut visit)?;
            }
        }
        ControlFlow::Continue(())
    }

    fn visit_cell(
        &self,
        row: usize,
        column: usize,
        visit: &mut impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut at = self.first[row * self.columns + column];
        while let Some(entry) = self.entries.get(at as usize) {
            visit(entry.item)?;
            at = entry.next;
        }
        ControlFlow::Continue(())
    }

    /// The columns and rows that a box reaches into.
    fn cells_in(&self, bounds: &Bounds) -> (RangeInclusive<usize>, RangeInclusive<usize>) {
        let (min, max) = (bounds.min - self.min, bounds.max - self.min);
        (
            cells_between(min.x, max.x, self.rounding, self.per_cell.x, self.columns),
            cells_between(min.y, max.y, self.rounding, self.per_cell.y, self.rows),
        )
    }

    fn rows_between(&self, from: Point, to: Point, reach: f64) -> RangeInclusive<usize> {
        let (low, high) = (from.y.min(to.y) - self.min.y, from.y.max(to.y) - self.min.y);
        cells_between(low, high, reach + self.rounding, self.per_cell.y, self.rows)
    }

    /// The columns that the thick segment reaches into within a row.
    fn columns_in(&self, row: usize, from: Point, to: Point, reach: f64) -> RangeInclusive<usize> {
        let reach = reach + self.rounding;
        let along = to - from;
        let from = from - self.min;
        let (mut x0, mut x1) = (from.x, from.x + along.x);
        if along.y.abs() > self.rounding && along.x != 0.0 {
            let slope = along.x / along.y;
            let low = row as f64 * self.cell.y - reach - from.y;
            let high = (row + 1) as f64 * self.cell.y + reach - from.y;
            let (a, b) = (from.x + low * slope, from.x + high * slope);
            let (left, right) = (x0.min(x1), x0.max(x1));
            (x0, x1) = (a.min(b).max(left), a.max(b).min(right));
        }
        cells_between(x0.min(x1), x0.max(x1), reach, self.per_cell.x, self.columns)
    }
}

/// The cells of one axis between two places, grown by `reach`; an empty range when there is none.
fn cells_between(low: f64, high: f64, reach: f64, per_cell: f64, count: usize) -> RangeInclusive<usize> {
    let (low, high) = ((low - reach) * per_cell, (high + reach) * per_cell);
    if count == 0 || high < 0.0 || low >= count as f64 {
        return RangeInclusive::new(1, 0);
    }
    // A cast from a float saturates.
    (low as usize)..=(high as usize).min(count - 1)
}

fn in_order(range: RangeInclusive<usize>, ascending: bool) -> impl Iterator<Item = usize> {
    let (low, high) = (*range.start(), *range.end());
    range.map(move |at| if ascending { at } else { low + high - at })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_geometry::{Edge, Segment};
    use traverse_solve::Seed;

    /// Every item that really lies near a line is shown, at many proportions and reaches.
    #[test]
    fn nothing_near_a_line_is_missed() {
        for seed in 0..200 {
            let mut random = Seed(seed).stream();
            let spread = Vector::new(
                10f64.powf(random.random_range(-2.0..3.0)),
                10f64.powf(random.random_range(-2.0..3.0)),
            );
            let mut at = |far: f64| {
                Point::new(
                    random.random_range(-far..far) * spread.x,
                    random.random_range(-far..far) * spread.y,
                )
            };
            let items: Vec<(Point, Point, f64)> =
                (0..60).map(|i| (at(1.0), at(1.0), [0.0, 1e-6, 0.5, 3.0][i % 4])).collect();
            let mut load = Load::NONE;
            // Half of them come later and may lie outside.
            items[..30].iter().for_each(|&(from, to, reach)| load.add(&Bounds::of([from, to]), reach));
            let mut grid = Grid::new(&load);
            for (i, &(from, to, reach)) in items.iter().enumerate() {
                if i % 3 == 0 {
                    grid.insert_box(i as u32, &Bounds::of([from, to]), reach);
                } else {
                    grid.insert(i as u32, from, to, reach);
                }
            }
            for _ in 0..60 {
                let (from, to) = (at(1.5), at(1.5));
                let mut shown = vec![false; items.len()];
                let _ = grid.along(from, to, |item| {
                    shown[item as usize] = true;
                    ControlFlow::Continue(())
                });
                let mut boxed = vec![false; items.len()];
                let bounds = Bounds::of([from, to]);
                let _ = grid.within(&bounds, |item| {
                    boxed[item as usize] = true;
                    ControlFlow::Continue(())
                });
                let line = Edge::Segment(Segment::new(from, to));
                for (i, &(a, b, reach)) in items.iter().enumerate() {
                    let is_near = line.distance(&Edge::Segment(Segment::new(a, b))) <= reach;
                    assert!(!is_near || shown[i], "seed {seed}: item {i} was missed");
                    assert!(!shown[i] || boxed[i], "seed {seed}: item {i} is on the line but not in its box");
                }
            }
        }
    }

    #[test]
    fn an_empty_grid_shows_nothing() {
        let grid = Grid::new(&Load::NONE);
        let shown = |_| ControlFlow::Break(());
        let (from, to) = (Point::new(-1.0, -1.0), Point::new(1.0, 1.0));
        assert_eq!(grid.along(from, to, shown), ControlFlow::Continue(()));
        assert_eq!(grid.within(&Bounds::of([from, to]), shown), ControlFlow::Continue(()));
    }

    #[test]
    fn a_break_ends_the_visit() {
        let mut load = Load::NONE;
        let (from, to) = (Point::new(0.0, 0.0), Point::new(1.0, 1.0));
        load.add(&Bounds::of([from, to]), 0.1);
        let mut grid = Grid::new(&load);
        grid.insert(0, from, to, 0.1);
        grid.insert(1, from, to, 0.1);
        let mut count = 0;
        let ended = grid.along(from, to, |_| {
            count += 1;
            ControlFlow::Break(())
        });
        assert_eq!((ended, count), (ControlFlow::Break(()), 1));
    }
}
