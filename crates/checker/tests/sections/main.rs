//! Layouts of sections: what is wrong is found, what is sound is accepted.

#![allow(clippy::panic, reason = "tests; clippy sees functions that help them as production code")]

mod certificates;
mod making;
mod mutation;
mod oracle;
mod overlaps;
mod rules;
