//! Inequalities that every tour satisfies and an assignment may not: how they look, and how violated ones are found.

pub(crate) mod connectivity;
pub(crate) mod crossing;
pub(crate) mod flow;
pub(crate) mod order;
pub(crate) mod support;
