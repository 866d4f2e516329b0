//! Rapid moves.
mod plan;
pub use plan::{Algorithm, Answer, NoPath, RapidMove, RapidPlan, Refusal, Stats, plan_rapid_move};
