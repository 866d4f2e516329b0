//! From the domain to the wire.

mod check;
mod distances;
mod path;
mod plan;
mod problem;
mod request;
mod session;

pub use check::check_answer;
pub use distances::distances_answer;
pub use plan::{plan_answer, sound_answer};
pub use problem::problem;
pub use request::{check_request, plan_request, scene_message};
pub use session::{scene_changed, step_plan};
