//! From the wire to the domain: once, validated, with every finding, or refused.

mod check;
mod distances;
mod effort;
mod number;
mod path;
mod plan;
mod reader;
mod rules;
mod scene;
mod session;
mod shape;

pub use check::CheckQuestion;
pub use distances::DistancesQuestion;
pub use effort::{requested_time_limit, time_limit_in};
pub use path::path_from_wire;
pub use plan::PlanQuestion;
pub use session::{StepQuestion, edit_from_wire, scene_from_wire, step_id_of};
