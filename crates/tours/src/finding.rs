//! What is wrong with a specification: every finding at once, each naming what to change.

/// One thing that is wrong with a specification.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Finding {
    /// There is nothing to visit.
    #[error("costs has no nodes: give at least one")]
    NoNodes,
    /// The matrix is not square.
    #[error("costs has {entries} entries: a matrix of {size} nodes has size × size")]
    EntryCount {
        /// How many nodes were announced.
        size: usize,
        /// How many entries came.
        entries: usize,
    },
    /// A cost whose sums would no longer be exact.
    #[error("costs[{from}][{to}] is {cost}: use a coarser unit, at most 100 000 000 000 either way")]
    CostTooLarge {
        /// Row.
        from: usize,
        /// Column.
        to: usize,
        /// The entry.
        cost: i64,
    },
    /// One quantity per node, or none at all.
    #[error("quantities has {quantities} entries: give one for each of the {size} nodes, or none")]
    QuantityCount {
        /// How many nodes there are.
        size: usize,
        /// How many quantities came.
        quantities: usize,
    },
    /// A node that is never visited.
    #[error("quantities[{node}] is 0: leave the node out")]
    NoVisit {
        /// The node.
        node: usize,
    },
    /// More visits than a tour may have.
    #[error("{visits} visits: at most 20 000")]
    TooManyVisits {
        /// How many visits were asked for.
        visits: u64,
    },
    /// A node that does not exist.
    #[error("{field} names node {node}: there are {size}")]
    UnknownNode {
        /// The field that names it.
        field: &'static str,
        /// The node.
        node: usize,
        /// How many nodes there are.
        size: usize,
    },
    /// One visit can't be both ends of a longer tour.
    #[error("first and last are both node {node}, which is visited once: choose two nodes")]
    FirstIsLast {
        /// The node.
        node: usize,
    },
    /// A node before itself, directly or through others.
    #[error("precedence puts node {node} before itself: remove one pair of the circle")]
    CyclicPrecedence {
        /// A node of the circle.
        node: usize,
    },
    /// Something is to come before the first node, or after the last.
    #[error("precedence puts node {before} before node {after}, but first and last say otherwise")]
    PrecedenceAgainstEnds {
        /// What is to come earlier.
        before: usize,
        /// What is to come later.
        after: usize,
    },
    /// A published method that knows no order.
    #[error("method keeps no precedence: use the ladder")]
    MethodWithoutPrecedence,
    /// A circle without a beginning has no before and after.
    #[error("precedence in a cycle needs first or last")]
    PrecedenceWithoutEnds,
}
