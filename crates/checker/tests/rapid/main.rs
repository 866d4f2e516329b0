//! Accepted and refused rapid moves, rule by rule.

mod ends_and_arcs;
mod hostile;
mod making;
mod mitred;
mod mutation;
mod oracle;
mod round;
mod symmetry;
mod touching;
mod work_area;
