//! A small client of the Traverse service, to copy from: connect, build a scene, ask with a deadline, try again when
//! that helps, read plans, refusals and findings; open a session over a scene that changes.

mod calling;
mod report;
mod scene;
mod session;

/// Generated from `proto/traverse/v1`.
#[allow(
    missing_docs,
    unreachable_pub,
    clippy::all,
    clippy::uninlined_format_args,
    clippy::semicolon_if_nothing_returned,
    rustdoc::all,
    reason = "generated"
)]
pub mod traverse {
    tonic::include_proto!("traverse.v1");
}

pub use calling::{connect, plan_rapid_move};
pub use report::{print_answer, print_refusal, print_step};
pub use scene::{disc, point, rectangle, scene};
pub use session::{Steps, open_session};
