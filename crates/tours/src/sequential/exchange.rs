//! The path-preserving 3-exchange with labels (Gambardella and Dorigo 2000).
//!
//! Two neighbouring segments may change places when nothing in the first must come before something in the second.
//! While the first segment grows by a node, that node's successors are marked; the second grows until it meets a
//! marked node. So every trial is decided in constant time, and all trials from one place cost O(n²).

use super::path::{Exchange, Path};
use crate::cost::Costs;
use crate::precedence::Precedence;

/// Marks of nodes that the growing segment shuts out.
#[derive(Clone, Debug)]
pub(super) struct Labels {
    mark: Vec<u64>,
    stamp: u64,
}

impl Labels {
    pub(super) fn new(size: usize) -> Self {
        Self { mark: vec![0; size], stamp: 0 }
    }

    fn clear(&mut self) {
        self.stamp += 1;
    }

    fn shut_out(&mut self, nodes: &[usize]) {
        for &node in nodes {
            self.mark[node] = self.stamp;
        }
    }

    fn is_shut_out(&self, node: usize) -> bool {
        self.mark[node] == self.stamp
    }
}

/// The best exchange whose first segment begins right behind the position.
pub(super) fn forward(
    costs: &impl Costs,
    precedence: &Precedence,
    path: &Path,
    before: usize,
    labels: &mut Labels,
) -> Option<(Exchange, i64)> {
    labels.clear();
    let end_of_path = path.end();
    let (start, first) = (path.at(before), path.at(before + 1));
    let mut best: Option<(Exchange, i64)> = None;
    let mut least = 0;
    let first_out = costs.cost(start, first);
    for middle in before + 1..end_of_path.saturating_sub(1) {
        labels.shut_out(&precedence.successors[path.at(middle)]);
        let (inner, second) = (path.at(middle), path.at(middle + 1));
        let part = first_out + costs.cost(inner, second) - costs.cost(start, second);
        let mut last = second;
        for end in middle + 1..end_of_path {
            if labels.is_shut_out(last) {
                break;
            }
            let next = path.at(end + 1);
            let saving = part + costs.cost(last, next) - costs.cost(last, first) - costs.cost(inner, next);
            if saving > least {
                least = saving;
                best = Some((Exchange { before, middle, end }, saving));
            }
            last = next;
        }
    }
    best
}

/// The best exchange whose second segment ends at the position.
pub(super) fn backward(
    costs: &impl Costs,
    precedence: &Precedence,
    path: &Path,
    end: usize,
    labels: &mut Labels,
) -> Option<(Exchange, i64)> {
    labels.clear();
    let (last, next) = (path.at(end), path.at(end + 1));
    let mut best: Option<(Exchange, i64)> = None;
    let mut least = 0;
    let last_out = costs.cost(last, next);
    for middle in (1..end).rev() {
        labels.shut_out(&precedence.predecessors[path.at(middle + 1)]);
        let (inner, second) = (path.at(middle), path.at(middle + 1));
        let part = last_out + costs.cost(inner, second) - costs.cost(inner, next);
        let mut first = inner;
        for before in (0..middle).rev() {
            if labels.is_shut_out(first) {
                break;
            }
            let start = path.at(before);
            let saving = part + costs.cost(start, first) - costs.cost(start, second) - costs.cost(last, first);
            if saving > least {
                least = saving;
                best = Some((Exchange { before, middle, end }, saving));
            }
            first = start;
        }
    }
    best
}

/// Whether the exchange keeps the order.
pub(super) fn is_allowed(precedence: &Precedence, path: &Path, exchange: Exchange, labels: &mut Labels) -> bool {
    labels.clear();
    for position in exchange.before + 1..=exchange.middle {
        labels.shut_out(&precedence.successors[path.at(position)]);
    }
    (exchange.middle + 1..=exchange.end).all(|position| !labels.is_shut_out(path.at(position)))
}
