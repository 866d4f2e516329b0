//! Tours over matrices, without geometry: every node as often as asked, at least cost, with a lower bound always and
//! mostly a proof.
//!
//! [`solve`] takes a [`TourSpecification`] (costs of arcs, forbidden ones, quantities, cycle or path, first and last,
//! what comes before what) and climbs a ladder: equal nodes become types, then assignment, program over counts, local
//! search, assignment branch and bound, branch and cut, metric closure. The methods published in 2009 are there by
//! name ([`Method`], [`order_with_every_end`]). Duals that prove a bound without any search come with the answer, and
//! [`verify_certificate`] recomputes what they prove. [`search_lazily`] is for thousands of nodes whose costs are
//! computed when asked for. Kernels are separate: an assignment ([`Assignment`]), a bound, a move, a cut to a file.
//!
//! With one thread the same specification, seed and iteration limit give the same answer. A time limit ends at
//! another iteration every time; two threads agree on what is proven, not on which of equally good tours is found.
//!
//! ```
//! use traverse_solve::{Budget, Silent};
//! use traverse_tours::{CostMatrix, SolveOptions, TourSpecification, solve, verify_certificate};
//!
//! // Two nodes, the first visited twice: 0 0 1 costs 5 + 2 + 1.
//! let costs = CostMatrix::new(2, vec![5, 2, 1, 9]).expect("a square matrix");
//! let specification = TourSpecification { quantities: vec![2, 1], ..TourSpecification::cycle(costs) };
//! let answer = solve(&specification, &SolveOptions::default(), &Budget::unlimited(), &mut Silent).expect("no findings");
//! assert_eq!(answer.tour.as_ref().map(|tour| tour.cost), Some(8));
//! assert_eq!(answer.lower_bound, 8);
//! assert_eq!(verify_certificate(&specification, &answer.certificate), Ok(answer.certified_bound));
//! ```

mod answer;
mod assignment;
mod assignment_search;
mod branch_and_cut;
mod certificate;
mod cheapest_arcs;
mod closure;
mod cost;
mod count_program;
mod cuts;
mod euler;
mod exact_bound;
#[cfg(test)]
mod extreme_tests;
mod finding;
mod guided_search;
mod ladder;
mod lazy_search;
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
mod sparse_assignment;
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
pub use certificate::{Certificate, CertificateFault, verify_certificate, verify_certificate_within};
pub use cost::{Costs, FORBIDDEN, LARGEST_COST, LARGEST_VISITS};
pub use finding::Finding;
pub use lazy_search::{LazyAnswer, search_lazily};
pub use matrix::CostMatrix;
pub use neighbours::Neighbours;
pub use options::{Method, SolveOptions};
pub use published::{SectionModel, order_with_every_end};
pub use solve::solve;
pub use specification::{Shape, TourSpecification};
pub use tsplib::{LARGEST_DIMENSION, TsplibError, read_tsplib};
pub use work::Work;
