//! What a kernel has spent of its budget, and whether it may go on: the only place where kernels meet the clock.

use std::sync::atomic::{AtomicBool, Ordering};
use traverse_solve::{Budget, Interrupt};

/// What a kernel has spent of its budget.
#[derive(Debug)]
pub struct Work<'a> {
    budget: &'a Budget,
    iterations: u64,
    enough: Option<&'a AtomicBool>,
}

impl<'a> Work<'a> {
    /// Nothing spent yet.
    #[must_use]
    pub fn new(budget: &'a Budget) -> Self {
        Self { budget, iterations: 0, enough: None }
    }

    /// Work that also ends when someone beside it has raised `enough`.
    pub(crate) fn beside(budget: &'a Budget, enough: &'a AtomicBool) -> Self {
        Self { budget, iterations: 0, enough: Some(enough) }
    }

    /// One iteration more.
    ///
    /// # Errors
    /// Why the kernel must stop.
    pub fn step(&mut self) -> Result<(), Interrupt> {
        self.breathe()?;
        self.iterations += 1;
        Ok(())
    }

    /// Whether work may go on within an iteration. Reads the clock.
    ///
    /// # Errors
    /// Why the kernel must stop.
    pub fn breathe(&self) -> Result<(), Interrupt> {
        if self.enough.is_some_and(|enough| enough.load(Ordering::Relaxed)) {
            return Err(Interrupt::Cancelled);
        }
        self.budget.check(self.iterations)
    }

    /// The budget.
    pub(crate) fn budget(&self) -> &'a Budget {
        self.budget
    }

    /// How many iterations were spent.
    #[must_use]
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// Takes over what work beside this has spent.
    pub(crate) fn add(&mut self, iterations: u64) {
        self.iterations = self.iterations.saturating_add(iterations);
    }
}
