//! Linear programs of branch and cut.

mod inverse;
pub(crate) mod simplex;
