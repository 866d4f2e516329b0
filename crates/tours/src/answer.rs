//! What a solve says: the best tour, how good it is known to be, and why it stopped.

use crate::certificate::Certificate;
use traverse_solve::Interrupt;

/// A tour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tour {
    /// The nodes in the order of their visits; repeated nodes as often as asked.
    pub visits: Vec<usize>,
    /// What the arcs cost, the way back included when the tour is a cycle.
    pub cost: i64,
}

/// Why a solve stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No tour is cheaper.
    ProvenOptimal,
    /// Forbidden arcs and order leave no tour.
    ProvenInfeasible,
    /// The method has nothing more to try, and proves nothing.
    Exhausted,
    /// The budget ended.
    Interrupted(Interrupt),
}

/// What a solve says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TourAnswer {
    /// The best tour found.
    pub tour: Option<Tour>,
    /// No tour costs less; the engine's word.
    pub lower_bound: i64,
    /// Duals that prove a bound without a search.
    pub certificate: Certificate,
    /// What the certificate proves: [`crate::verify_certificate`] recomputes it.
    pub certified_bound: i64,
    /// Why it stopped.
    pub ending: Ending,
    /// Kicks of local search and nodes of searches, all together.
    pub iterations: u64,
}

impl TourAnswer {
    /// Whether the search closed the gap.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        matches!(self.ending, Ending::ProvenOptimal | Ending::ProvenInfeasible)
    }
}
