//! How far apart the left edges of any two items must be: all of them kept in a matrix while there are few enough,
//! each computed when it is asked for otherwise. Rows are shared out to threads.

use crate::grid::Grid;
use crate::instance::{Item, grid_offset};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use traverse_solve::{Budget, Interrupt};

/// The most items whose offsets are all kept: 50 MB.
const MOST_ITEMS: usize = 2_500;
/// The most pieces of envelopes that are passed to compute them all: some seconds.
const MOST_WORK: usize = 2_000_000_000;

/// Offsets of items.
#[derive(Clone, Debug)]
pub(crate) struct Offsets {
    /// Row by row; empty when each is computed on demand.
    kept: Arc<[i64]>,
}

impl Offsets {
    /// Each is computed when it is asked for.
    pub(crate) fn computed() -> Self {
        Self { kept: Arc::default() }
    }

    /// All of them if they are few enough, on `threads` threads.
    pub(crate) fn of(items: &[Item], grid: Grid, threads: usize, budget: &Budget) -> Result<Self, Interrupt> {
        let count = items.len();
        let pieces: usize = items.iter().map(|item| item.profile.left.pieces.len()).sum();
        if count > MOST_ITEMS || count.saturating_mul(pieces) > MOST_WORK {
            return Ok(Self::computed());
        }
        let row = |left: usize, row: &mut [i64]| {
            for (right, offset) in items.iter().zip(row) {
                *offset = grid_offset(&items[left].profile, &right.profile, grid);
            }
        };
        Ok(Self { kept: filled(count, 0, threads, budget, row)?.into() })
    }

    pub(crate) fn are_kept(&self) -> bool {
        !self.kept.is_empty()
    }

    #[inline]
    pub(crate) fn between(&self, items: &[Item], grid: Grid, left: usize, right: usize) -> i64 {
        if self.kept.is_empty() {
            grid_offset(&items[left].profile, &items[right].profile, grid)
        } else {
            self.kept[left * items.len() + right]
        }
    }
}

/// A square matrix whose rows are filled one by one, shared out to threads.
pub(crate) fn filled<T: Copy + Send>(
    size: usize,
    empty: T,
    threads: usize,
    budget: &Budget,
    row: impl Fn(usize, &mut [T]) + Sync,
) -> Result<Vec<T>, Interrupt> {
    let mut entries = vec![empty; size * size];
    if threads < 2 || size < 2 {
        for (number, entries) in entries.chunks_mut(size.max(1)).enumerate() {
            budget.check(0)?;
            row(number, entries);
        }
        return Ok(entries);
    }
    let rows: Vec<_> = entries.chunks_mut(size).map(|entries| Mutex::new(Some(entries))).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            budget.check(0)?;
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(slot) = rows.get(number) else { return Ok(()) };
            if let Some(entries) = slot.lock().ok().and_then(|mut entries| entries.take()) {
                row(number, entries);
            }
        }
    };
    let results: Vec<Result<(), Interrupt>> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads.min(size)).map(|_| scope.spawn(work)).collect();
        let own = work();
        let joined = others.into_iter().map(|other| other.join().unwrap_or(Err(Interrupt::Cancelled)));
        std::iter::once(own).chain(joined).collect()
    });
    drop(rows);
    results.into_iter().collect::<Result<(), _>>()?;
    Ok(entries)
}
