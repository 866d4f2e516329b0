//! From the wire to the domain: once, validated, with every finding, or refused.

mod check;
mod cost;
mod effort;
mod number;
mod path;
mod plan;
mod reader;
mod rules;
mod scene;
mod shape;
mod tool_change;

pub use check::CheckQuestion;
pub use effort::{requested_time_limit, rules_time_limit};
pub use path::path_from_wire;
pub use plan::PlanQuestion;
pub use tool_change::ToolChangeQuestion;
