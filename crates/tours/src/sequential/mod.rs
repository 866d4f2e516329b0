//! Local search where an order is to be kept.

mod exchange;
mod path;
pub(crate) mod search;
