//! Which obstacles a point may lie in or near.

use crate::barrier::Grid;
use std::ops::ControlFlow;
use traverse_geometry::{Bounds, Point};

/// A box that would enter more cells than this is looked at always.
const WIDE_CELLS: f64 = 64.0;

/// Owners by the boxes of their barriers.
#[derive(Clone, Debug)]
pub(crate) struct Nearby {
    boxes: Grid,
    wide: Vec<usize>,
}

impl Nearby {
    /// Nothing yet, in cells like those of `grid`.
    pub(super) fn like(grid: &Grid) -> Self {
        Self { boxes: grid.same_cells(), wide: Vec::new() }
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
