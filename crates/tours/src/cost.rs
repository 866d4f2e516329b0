//! What an arc costs: a whole number, or nothing at all because the arc is forbidden.
//!
//! Costs are `i64` in a unit that the caller chooses and the kernels never see. A caller with lengths takes
//! nanometres: [`LARGEST_COST`] is then 100 m for one arc, and a tour of [`LARGEST_VISITS`] arcs stays below 2⁵¹,
//! so that sums are exact in `i64` and what an observer hears is exact in `f64`.

/// The cost of an arc that no tour may use.
pub const FORBIDDEN: i64 = i64::MAX;

/// The largest magnitude of an allowed arc's cost.
pub const LARGEST_COST: i64 = 100_000_000_000;

/// The most visits of one tour.
pub const LARGEST_VISITS: usize = 20_000;

/// Where costs come from: a matrix, or a function that computes an entry when it is asked for. Costs are
/// [`FORBIDDEN`] or within ±[`LARGEST_COST`], nodes at most [`LARGEST_VISITS`]; a [`crate::CostMatrix`] sees to it.
pub trait Costs: Sync {
    /// How many nodes there are.
    fn size(&self) -> usize;

    /// What the arc costs, [`FORBIDDEN`] when it must not be used.
    fn cost(&self, from: usize, to: usize) -> i64;

    /// A cost that the arc can't fall below, cheaper to come by than the cost itself: bounds for thousands of nodes
    /// look at every pair once.
    fn floor(&self, from: usize, to: usize) -> i64 {
        self.cost(from, to)
    }
}
