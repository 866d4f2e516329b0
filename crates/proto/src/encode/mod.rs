//! From the domain to the wire.

mod check;
mod layout;
mod order;
mod path;
mod plan;
mod request;
mod tool_change;

pub use check::{check_answer, check_sections_answer};
pub(crate) use layout::pose;
pub use layout::{check_sections_request, order_request};
pub use order::{CountedLimit, Improvement, SearchFacts, order_answer, sound_order_answer};
pub use plan::{plan_answer, sound_answer};
pub use request::{check_request, plan_request};
pub use tool_change::{tool_change_answer, tool_change_request};
