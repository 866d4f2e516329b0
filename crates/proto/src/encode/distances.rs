//! PlanDistances' answer.

use super::plan::cost_unit;
use crate::v1;
use traverse_geometry::TravelCost;

/// Shortest costs, row by row, as their message; `cost` is how they are measured.
#[must_use]
pub fn distances_answer(costs: Vec<f64>, cost: &TravelCost) -> v1::PlanDistancesResponse {
    v1::PlanDistancesResponse { costs, cost_unit: cost_unit(cost.unit()).into() }
}
