//! PlanDistances' answer.

use crate::v1;

/// Shortest costs, row by row, as their message.
#[must_use]
pub fn distances_answer(costs: Vec<f64>) -> v1::PlanDistancesResponse {
    v1::PlanDistancesResponse { costs, cost_unit: v1::CostUnit::Mm.into() }
}
