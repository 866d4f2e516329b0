//! How hard to try: what a caller asks for. What is to be solved stands in each engine's own specification.

use crate::{Budget, CancelToken};
use std::time::{Duration, Instant};

/// How hard to try.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Effort {
    /// Stop after this long and answer with the best so far. Absent: no limit.
    pub time_limit: Option<Duration>,
    /// Stop after this many steps of the method. Absent: no limit.
    pub iteration_limit: Option<u64>,
}

impl Effort {
    /// The budget of work that starts now.
    #[must_use]
    pub fn budget_from_now(&self, cancel: CancelToken) -> Budget {
        Budget {
            // A limit so long that the clock can't express its end is none.
            deadline: self.time_limit.and_then(|limit| Instant::now().checked_add(limit)),
            iterations: self.iteration_limit,
            cancel,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Interrupt;

    #[test]
    fn a_limit_of_zero_is_over_at_once() {
        let effort = Effort { time_limit: Some(Duration::ZERO), ..Effort::default() };
        assert_eq!(effort.budget_from_now(CancelToken::new()).check(0), Err(Interrupt::Deadline));
    }

    #[test]
    fn an_endless_limit_is_none() {
        let effort = Effort { time_limit: Some(Duration::MAX), ..Effort::default() };
        assert_eq!(effort.budget_from_now(CancelToken::new()).check(u64::MAX), Ok(()));
    }
}
