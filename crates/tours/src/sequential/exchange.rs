//! The path-preserving 3-exchange with labels (Gambardella and Dorigo 2000).
//!
//! Two neighbouring segments may change places when nothing in the first must come before something in the second.
//! While the first segment grows by a node, that node's successors (a few words of bits) are marked; the second grows until it meets a
//! marked node. So every trial is decided in constant time, and all trials from one place cost O(n²). Costs are
//! never negative here, so that the dearest arc of the path bounds what a third arc can save, and most second
//! segments need not be grown at all.

use super::path::{Exchange, Path};
use crate::cost::Costs;
use crate::precedence::Precedence;

/// Nodes that the growing segment shuts out, as bits.
#[derive(Clone, Debug)]
pub(super) struct Labels {
    bits: Vec<u64>,
}

impl Labels {
    pub(super) fn new(size: usize) -> Self {
        Self { bits: vec![0; size.div_ceil(64)] }
    }

    fn clear(&mut self) {
        self.bits.fill(0);
    }

    fn shut_out(&mut self, nodes: &[u64]) {
        for (bits, more) in self.bits.iter_mut().zip(nodes) {
            *bits |= more;
        }
    }

    fn is_shut_out(&self, node: usize) -> bool {
        self.bits[node / 64] >> (node % 64) & 1 == 1
    }
}

/// The best exchange whose first segment begins right behind the position.
pub(super) fn forward(
    costs: &impl Costs,
    precedence: &Precedence,
    path: &Path,
    before: usize,
    dearest: i64,
    labels: &mut Labels,
) -> Option<(Exchange, i64)> {
    labels.clear();
    let end_of_path = path.end();
    let (start, first) = (path.at(before), path.at(before + 1));
    let mut best: Option<(Exchange, i64)> = None;
    let mut least = 0;
    let first_out = costs.cost(start, first);
    for middle in before + 1..end_of_path.saturating_sub(1) {
        labels.shut_out(precedence.successor_bits(path.at(middle)));
        let (inner, second) = (path.at(middle), path.at(middle + 1));
        let part = first_out + costs.cost(inner, second) - costs.cost(start, second);
        if part + dearest <= least {
            continue;
        }
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
    dearest: i64,
    labels: &mut Labels,
) -> Option<(Exchange, i64)> {
    labels.clear();
    let (last, next) = (path.at(end), path.at(end + 1));
    let mut best: Option<(Exchange, i64)> = None;
    let mut least = 0;
    let last_out = costs.cost(last, next);
    for middle in (1..end).rev() {
        labels.shut_out(precedence.predecessor_bits(path.at(middle + 1)));
        let (inner, second) = (path.at(middle), path.at(middle + 1));
        let part = last_out + costs.cost(inner, second) - costs.cost(inner, next);
        if part + dearest <= least {
            continue;
        }
        let mut first = inner;
        for before in (0..middle).rev() {
            if labels.is_shut_out(first) {
                break;
            }
            let start = path.at(before);
            let saving =
                part + costs.cost(start, first) - costs.cost(start, second) - costs.cost(last, first);
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
pub(super) fn is_allowed(
    precedence: &Precedence,
    path: &Path,
    exchange: Exchange,
    labels: &mut Labels,
) -> bool {
    labels.clear();
    for position in exchange.before + 1..=exchange.middle {
        labels.shut_out(precedence.successor_bits(path.at(position)));
    }
    (exchange.middle + 1..=exchange.end).all(|position| !labels.is_shut_out(path.at(position)))
}
