//! From the wire to the domain: once, validated, with every finding, or refused.

mod certificate;
mod check;
mod check_sections;
mod cost;
mod distances;
mod effort;
mod layout;
mod number;
mod order;
mod path;
mod plan;
mod reader;
mod rules;
mod scene;
mod section;
mod session;
mod shape;
mod tool_change;

pub use check::CheckQuestion;
pub use check_sections::{CheckSectionsQuestion, order_from_wire};
pub use distances::DistancesQuestion;
pub use effort::{requested_time_limit, rules_time_limit};
pub use order::{OrderQuestion, OrderReturns, requested_order_time_limit};
pub use path::path_from_wire;
pub use plan::PlanQuestion;
pub use session::{StepQuestion, edit_from_wire, scene_from_wire, step_id_of};
pub use tool_change::ToolChangeQuestion;
