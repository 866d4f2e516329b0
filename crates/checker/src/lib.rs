//! Checks plans against their requests on the original geometry, with none of the planner's code.

mod rapid_check;
mod violation;

pub use rapid_check::{PathCheck, check_rapid_move};
pub use violation::{Violation, ViolationReason};

/// Stands for the work area where a violation names an obstacle.
pub const WORK_AREA_ID: &str = "work_area";
