//! Which obstacles a point may lie in or near.

use crate::barrier::Grid;
use std::cell::Cell;
use std::ops::ControlFlow;
use traverse_geometry::{Bounds, Point};

/// A box that would enter more cells than this is looked at always.
const WIDE_CELLS: f64 = 64.0;

/// A point of a cell that lies clear of every barrier.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ClearPoint {
    /// Nobody looked.
    Unknown,
    /// The middle is not clear, and nothing else was found.
    None,
    /// The middle, or where that is not clear the first point that was found.
    At(Point),
}

/// Owners by the boxes of their barriers.
#[derive(Clone, Debug)]
pub(crate) struct Nearby {
    boxes: Grid,
    wide: Vec<usize>,
    /// Per cell a clear point, as far as that is known.
    clear_points: Vec<Cell<ClearPoint>>,
    /// The last two points that were found clear: each end of a move is asked about more than once.
    clear: Cell<[Option<Point>; 2]>,
}

impl Nearby {
    /// Nothing yet, in cells like those of `grid`.
    pub(super) fn like(grid: &Grid) -> Self {
        let [columns, rows] = grid.size();
        let clear_points = vec![Cell::new(ClearPoint::Unknown); columns * rows];
        Self { boxes: grid.same_cells(), wide: Vec::new(), clear_points, clear: Cell::default() }
    }

    /// The middle of the cell that a point lies in, and the cell's clear point.
    pub(crate) fn cell_of(&self, point: Point) -> Option<(Point, &Cell<ClearPoint>)> {
        let [column, row] = self.boxes.cell_at(point);
        let [columns, rows] = self.boxes.size();
        let (column_at, row_at) = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
        if column_at >= columns || row_at >= rows {
            return None;
        }
        Some((self.boxes.middle(column, row), &self.clear_points[row_at * columns + column_at]))
    }

    /// Whether `point` was found clear just now.
    pub(crate) fn was_clear(&self, point: Point) -> bool {
        self.clear.get().contains(&Some(point))
    }

    /// Takes note that `point` is clear.
    pub(crate) fn note_clear(&self, point: Point) {
        let [last, _] = self.clear.get();
        self.clear.set([Some(point), last]);
        if let Some((_, known)) = self.cell_of(point)
            && let ClearPoint::None = known.get()
        {
            known.set(ClearPoint::At(point));
        }
    }

    /// Forgets whether points within `bounds` are clear.
    pub(super) fn forget(&mut self, bounds: &Bounds) {
        self.clear.set([None; 2]);
        let [columns, rows] = self.boxes.size().map(|count| count as i64);
        let (low, high) = (self.boxes.cell_at(bounds.min), self.boxes.cell_at(bounds.max));
        for row in low[1].max(0)..=high[1].min(rows - 1) {
            for column in low[0].max(0)..=high[0].min(columns - 1) {
                self.clear_points[(row * columns + column) as usize].set(ClearPoint::Unknown);
            }
        }
    }

    /// Adds an owner that reaches `bounds`; none: everywhere.
    pub(super) fn push(&mut self, owner: usize, bounds: Option<&Bounds>) {
        match (u32::try_from(owner), bounds) {
            (Ok(item), Some(bounds)) if self.boxes.cells_of(bounds, 0.0) <= WIDE_CELLS => {
                self.boxes.insert_box(item, bounds, 0.0);
            }
            _ => self.wide.push(owner),
        }
    }

    /// Owners that a point may lie in or near, each once.
    pub(crate) fn owners_at(&self, point: Point) -> Vec<usize> {
        let mut owners = self.wide.clone();
        let _ = self.boxes.within(&Bounds::of([point]), |item| {
            owners.push(item as usize);
            ControlFlow::Continue(())
        });
        owners.sort_unstable();
        owners.dedup();
        owners
    }
}
