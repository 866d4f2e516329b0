//! From the domain to the wire.

mod check;
mod distances;
mod layout;
mod order;
mod path;
mod plan;
mod problem;
mod request;
mod session;
mod tool_change;

pub use check::{check_answer, check_sections_answer};
pub use distances::distances_answer;
pub(crate) use layout::pose;
pub use layout::{check_sections_request, order_request};
pub use order::{CountedLimit, Improvement, SearchFacts, order_answer, sound_order_answer};
pub use plan::{plan_answer, sound_answer};
pub use problem::problem;
pub use request::{check_request, plan_request, scene_message};
pub use session::{scene_changed, step_plan};
pub use tool_change::{tool_change_answer, tool_change_request};
