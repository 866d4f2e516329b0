//! Moves of local search, one to a file.

pub(crate) mod double_bridge;
pub(crate) mod or_opt;
pub(crate) mod three_opt;
