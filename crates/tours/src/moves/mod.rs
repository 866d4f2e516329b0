//! Moves of local search, one to a file.

pub(crate) mod double_bridge;
pub(crate) mod three_opt;
