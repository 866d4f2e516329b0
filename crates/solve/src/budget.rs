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

    /// A part of what is left, from 0 to 1: until that part of the time to the deadline has passed, and that part of the
    /// iterations beyond `iterations`, those already spent, is used up. The cancel stays the same. Reads the clock.
    #[must_use]
    pub fn share(&self, part: f64, iterations: u64) -> Self {
        let now = Instant::now();
        let until =
            |deadline: Instant| now + deadline.saturating_duration_since(now).mul_f64(part.clamp(0.0, 1.0));
        let some = |limit: u64| (limit.saturating_sub(iterations) as f64 * part.clamp(0.0, 1.0)) as u64;
        Self {
            deadline: self.deadline.map(until),
            iterations: self.iterations.map(some),
            cancel: self.cancel.clone(),
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_share_is_a_part_of_what_is_left_under_the_same_cancel() {
        let end = Instant::now() + Duration::from_secs(1_000);
        let budget = Budget { deadline: Some(end), iterations: Some(100), ..Budget::unlimited() };
        let share = budget.share(0.5, 40);
        assert_eq!(share.iterations, Some(30));
        assert!(share.deadline.is_some_and(|deadline| deadline < end - Duration::from_secs(400)));
        budget.cancel.cancel();
        assert_eq!(share.check(0), Err(Interrupt::Cancelled));
        assert_eq!(Budget::unlimited().share(0.5, 7).deadline, None);
    }
}
