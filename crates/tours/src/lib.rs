//! Tours over matrices.

mod answer;
mod assignment;
mod assignment_search;
mod branch_and_cut;
mod certificate;
mod closure;
mod cost;
mod count_program;
mod cuts;
mod euler;
mod exact_bound;
mod finding;
mod guided_search;
mod ladder;
mod linear;
mod local_search;
mod matrix;
mod moves;
mod neighbours;
mod network;
mod options;
#[cfg(test)]
mod oracle_tests;
mod patching;
mod precedence;
mod progress;
mod published;
mod sequential;
mod solve;
mod specification;
#[cfg(test)]
mod test_support;
mod tour_array;
mod tsplib;
mod types;
mod visits;
mod work;

pub use answer::{Ending, Tour, TourAnswer};
pub use assignment::{Assignment, Matched};
pub use certificate::{Certificate, CertificateFault, verify_certificate};
pub use cost::{Costs, FORBIDDEN, LARGEST_COST, LARGEST_VISITS};
pub use finding::Finding;
pub use matrix::CostMatrix;
pub use neighbours::Neighbours;
pub use options::{Method, SolveOptions};
pub use published::{SectionModel, order_with_every_end};
pub use solve::solve;
pub use specification::{Shape, TourSpecification};
pub use tsplib::{LARGEST_DIMENSION, TsplibError, read_tsplib};
pub use work::Work;
