//! Algorithm, time limit and iteration limit.

use super::reader::Reader;
use crate::v1;
use std::time::Duration;
use traverse_planner::Algorithm;

/// The time limit that a request names, if it names a sound one. Read before the request is validated: waiting for a core
/// counts.
#[must_use]
pub fn requested_time_limit(request: &v1::PlanRapidMoveRequest) -> Option<Duration> {
    rules_time_limit(request.rules.as_ref())
}

/// The time limit that rules name, if they name a sound one.
#[must_use]
pub fn rules_time_limit(rules: Option<&v1::RapidRules>) -> Option<Duration> {
    let limit = rules?.options.as_ref()?.time_limit.as_ref()?;
    duration(limit)
}

/// The duration, if it is a sound one.
pub(crate) fn duration(wire: &prost_types::Duration) -> Option<Duration> {
    let nanos = u32::try_from(wire.nanos).ok().filter(|&nanos| nanos < 1_000_000_000)?;
    Some(Duration::new(u64::try_from(wire.seconds).ok()?, nanos))
}

impl Reader<'_> {
    /// The method that is asked for.
    pub(crate) fn algorithm(&mut self, field: &str, algorithm: i32) -> Option<Algorithm> {
        match v1::RapidAlgorithm::try_from(algorithm) {
            Ok(v1::RapidAlgorithm::Unspecified | v1::RapidAlgorithm::Exact) => Some(Algorithm::Exact),
            Ok(v1::RapidAlgorithm::SupportingLines) => Some(Algorithm::SupportingLines),
            Err(_) => {
                let known = ["RAPID_ALGORITHM_EXACT (1)", "RAPID_ALGORITHM_SUPPORTING_LINES (2)"];
                self.unknown_enum_value(field, algorithm, &known);
                None
            }
        }
    }

    /// Reports a time limit that is none; gives the iteration limit, absent when there is none.
    pub(crate) fn iteration_limit(&mut self, field: &str, options: &v1::SolveOptions) -> Option<u64> {
        if let Some(limit) = &options.time_limit
            && duration(limit).is_none()
        {
            let value = format!("{} s {} ns", limit.seconds, limit.nanos);
            self.out_of_range(&format!("{field}.time_limit"), value, "0 s or more, with 0 to 999999999 ns");
        }
        match u64::try_from(options.iteration_limit) {
            Ok(limit) => Some(limit).filter(|&limit| limit > 0),
            Err(_) => {
                let field = format!("{field}.iteration_limit");
                self.out_of_range(&field, options.iteration_limit, "0 (no limit) or more");
                None
            }
        }
    }
}
