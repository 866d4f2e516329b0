//! How a plan was reached and how good it is known to be.

use crate::{Interrupt, Trace};

/// Why an engine stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// Cost and bound met.
    ProvenOptimal,
    /// The budget ended.
    Interrupted(Interrupt),
}

/// How a plan was reached and how good it is known to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Cost of the best plan. Absent: none was found.
    pub cost: Option<f64>,
    /// No plan costs less.
    pub lower_bound: f64,
    /// Why the engine stopped.
    pub stop_reason: StopReason,
}

impl Report {
    /// The report of an engine that told `trace` and then stopped.
    #[must_use]
    pub fn of(trace: &Trace, stop_reason: StopReason) -> Self {
        Self {
            cost: trace.costs.last().copied(),
            lower_bound: trace.bounds.last().copied().unwrap_or(0.0),
            stop_reason,
        }
    }

    /// (cost − lower bound) / cost, 0 when the cost is 0. Absent while there is no plan.
    #[must_use]
    pub fn gap_ratio(&self) -> Option<f64> {
        self.cost.map(|cost| if cost == 0.0 { 0.0 } else { (cost - self.lower_bound) / cost })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Observer;

    #[test]
    fn the_gap_is_what_the_last_cost_leaves_to_the_last_bound() {
        let mut trace = Trace::default();
        trace.better_bound(5.0);
        trace.better_cost(20.0);
        trace.better_cost(10.0);
        trace.better_bound(9.0);
        let report = Report::of(&trace, StopReason::Interrupted(Interrupt::Deadline));
        assert_eq!(report.cost, Some(10.0));
        assert_eq!(report.gap_ratio(), Some(0.1));
    }

    #[test]
    fn no_plan_has_no_gap_and_a_free_plan_has_none_to_close() {
        let none = Report::of(&Trace::default(), StopReason::ProvenOptimal);
        assert_eq!(none.gap_ratio(), None);
        let free = Report { cost: Some(0.0), lower_bound: 0.0, stop_reason: StopReason::ProvenOptimal };
        assert_eq!(free.gap_ratio(), Some(0.0));
    }
}
