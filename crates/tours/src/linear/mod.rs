//! Linear programs of branch and cut.

pub(crate) mod dual_method;
mod inverse;
#[cfg(test)]
mod oracle_tests;
pub(crate) mod simplex;
