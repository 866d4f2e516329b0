//! From the domain to the wire.

mod check;
mod path;
mod plan;
mod request;
mod tool_change;

pub use check::check_answer;
pub use plan::{plan_answer, sound_answer};
pub use request::{check_request, plan_request};
pub use tool_change::{tool_change_answer, tool_change_request};
