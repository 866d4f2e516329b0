//! Open nodes, the one with the least bound first, among equals the deepest.

use crate::exact_bound::PARTS;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::rc::Rc;

/// Nodes beyond this are too many to keep.
const MOST_NODES: usize = 400_000;

/// New bounds of an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    pub(super) arc: usize,
    pub(super) lower: u32,
    pub(super) upper: u32,
}

#[derive(Debug)]
struct Link {
    change: Change,
    before: Option<Rc<Link>>,
}

/// What is left of the problem after some bound changes.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) parts: i128,
    pub(super) depth: u32,
    order: u64,
    changes: Option<Rc<Link>>,
}

impl Default for Node {
    /// The root, of which nothing is known: below whatever many visits can cost.
    fn default() -> Self {
        Self { parts: i128::MIN, depth: 0, order: 0, changes: None }
    }
}

impl Node {
    /// No tour of this node costs less.
    pub(super) fn bound_cost(&self) -> i64 {
        cost_of(self.parts)
    }

    /// What is left after one change more.
    pub(super) fn child(&self, change: Change, parts: i128) -> Self {
        let link = Link { change, before: self.changes.clone() };
        Self { parts: parts.max(self.parts), depth: self.depth + 1, order: 0, changes: Some(Rc::new(link)) }
    }

    /// All changes, the latest first.
    pub(super) fn changes(&self) -> impl Iterator<Item = Change> {
        std::iter::successors(self.changes.as_deref(), |link| link.before.as_deref()).map(|link| link.change)
    }
}

/// The least whole cost that is not below a bound in parts.
pub(super) fn cost_of(parts: i128) -> i64 {
    let up = parts.div_euclid(i128::from(PARTS)) + i128::from(parts.rem_euclid(i128::from(PARTS)) > 0);
    up.clamp(i128::from(i64::MIN), i128::from(i64::MAX)) as i64
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Node {}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .bound_cost()
            .cmp(&self.bound_cost())
            .then(self.depth.cmp(&other.depth))
            .then(other.parts.cmp(&self.parts))
            .then(self.order.cmp(&other.order))
    }
}

/// Open nodes.
#[derive(Debug, Default)]
pub(super) struct Tree {
    open: BinaryHeap<Node>,
    made: u64,
}

impl Tree {
    pub(super) fn push(&mut self, mut node: Node) {
        self.made += 1;
        node.order = self.made;
        self.open.push(node);
    }

    pub(super) fn pop(&mut self) -> Option<Node> {
        self.open.pop()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.open.is_empty()
    }

    pub(super) fn is_full(&self) -> bool {
        self.open.len() > MOST_NODES
    }

    /// The least bound of the open nodes.
    pub(super) fn bound(&self) -> Option<i64> {
        self.open.peek().map(Node::bound_cost)
    }
}
