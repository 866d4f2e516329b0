//! Looks at the budget once in so much work: often enough to stop within some milliseconds, seldom enough to cost
//! nothing.

use traverse_solve::{Budget, Interrupt};

/// Steps between two looks; a step is some nanoseconds.
const LOOK_EVERY: usize = 1 << 16;

/// Looks at the budget once in so much work. Only time and cancel count.
#[derive(Debug)]
pub(crate) struct Pace {
    budget: Budget,
    steps: usize,
}

impl Pace {
    pub(crate) fn of(budget: &Budget) -> Self {
        Self { budget: Budget { iterations: None, ..budget.clone() }, steps: LOOK_EVERY }
    }

    /// So many more steps are done.
    #[inline]
    pub(crate) fn spend(&mut self, steps: usize) -> Result<(), Interrupt> {
        self.steps += steps;
        if self.steps < LOOK_EVERY {
            return Ok(());
        }
        self.steps = 0;
        self.budget.check(0)
    }
}
