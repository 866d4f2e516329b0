//! How a solve goes about it.

use traverse_solve::Seed;

/// Which method orders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The ladder: whatever proves the optimum soonest, local search until then.
    #[default]
    Ladder,
    /// Branch and bound on one arc in or out, bounded by assignments, as published in 2009.
    BranchAndBound,
    /// An ant colony, as published in 2009.
    AntColony,
    /// Successive improvement, as published in 2009.
    SuccessiveImprovement,
}

/// How a solve goes about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SolveOptions {
    /// The method.
    pub method: Method,
    /// Where chance comes from.
    pub seed: Seed,
    /// 1: everything in turn, the same answer for the same seed and iteration limit. 2 or more: local search beside
    /// the proof; what is proven is the same, which of equally good tours is found may differ.
    pub threads: usize,
}

impl Default for SolveOptions {
    fn default() -> Self {
        Self { method: Method::Ladder, seed: Seed::default(), threads: 1 }
    }
}
