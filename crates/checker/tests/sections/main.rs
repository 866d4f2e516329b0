//! Layouts of sections: what is wrong is found, what is sound is accepted.

mod making;
mod mutation;
mod oracle;
mod overlaps;
mod rules;
