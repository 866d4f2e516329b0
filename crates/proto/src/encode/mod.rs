//! From the domain to the wire.

mod check;
mod path;
mod plan;

pub use check::check_answer;
pub use plan::{plan_answer, sound_answer};
