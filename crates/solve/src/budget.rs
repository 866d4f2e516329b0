//! How long an engine may work: deadline, iterations, cancel. An engine's only contact with time.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Raised by whoever no longer wants the answer; seen by the engine at its next check.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token that nobody has raised.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the engine to stop.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the engine was asked to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Why an engine had to stop before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interrupt {
    /// The deadline has passed.
    Deadline,
    /// The iteration limit is reached.
    Iterations,
    /// Cancelled.
    Cancelled,
    /// The work outgrew the memory that an engine allows itself.
    Memory,
}

/// How long an engine may work.
#[derive(Clone, Debug, Default)]
pub struct Budget {
    /// Stop then. Absent: no deadline.
    pub deadline: Option<Instant>,
    /// Stop after this many iterations. Absent: no limit.
    pub iterations: Option<u64>,
    /// Stop when raised.
    pub cancel: CancelToken,
}

impl Budget {
    /// No limits.
    #[must_use]
    pub fn unlimited() -> Self {
        Self::default()
    }

    /// Whether the engine may go on, having spent `iterations` of them. Reads the clock: call it every few
    /// microseconds of work, not every few nanoseconds.
    ///
    /// # Errors
    /// Why the engine must stop.
    pub fn check(&self, iterations: u64) -> Result<(), Interrupt> {
        if self.cancel.is_cancelled() {
            return Err(Interrupt::Cancelled);
        }
        if self.iterations.is_some_and(|limit| iterations >= limit) {
            return Err(Interrupt::Iterations);
        }
        if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return Err(Interrupt::Deadline);
        }
        Ok(())
    }
}
