//! From the domain to the wire.

mod check;
mod path;
mod plan;
mod request;

pub use check::check_answer;
pub use plan::{plan_answer, sound_answer};
pub use request::{check_request, plan_request};
