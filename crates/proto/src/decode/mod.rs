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

pub use check::CheckQuestion;
pub use effort::requested_time_limit;
pub use path::path_from_wire;
pub use plan::PlanQuestion;
