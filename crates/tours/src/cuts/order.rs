//! Violated precedence inequalities (Balas, Fischetti, Pulleyblank 1995).
//!
//! When i comes before j, the tour goes from i to j without meeting what comes before i or after j: a flow of one
//! must fit through the other nodes (the (π, σ) inequalities). Likewise from j to the end without what comes
//! before j (π), and from the beginning to i without what comes after i (σ). One maximum flow for each.

use super::crossing::{Crossing, Side};
use super::flow::Flow;
use super::support::Support;
use crate::precedence::Precedence;
use crate::work::Work;
use traverse_solve::Interrupt;

/// A flow below this is violated.
const TARGET: f64 = 1.0 - 1e-3;

/// At most `most` violated precedence inequalities.
pub(crate) fn violated(
    support: &Support,
    precedence: &Precedence,
    depot: usize,
    most: usize,
    work: &Work<'_>,
) -> Result<Vec<Crossing>, Interrupt> {
    let mut cuts = vec![];
    let mut closed = Flow::new(support, None);
    let mut open = Flow::new(support, Some(depot));
    let mut left_out = vec![false; support.size];
    for node in 0..support.size {
        work.breathe()?;
        if cuts.len() >= most {
            return Ok(cuts);
        }
        let (before, after) = (&precedence.predecessors[node], &precedence.successors[node]);
        if !before.is_empty() {
            mark(&mut left_out, &[before]);
            cuts.extend(cut(&mut closed, node, depot, &left_out));
        }
        if !after.is_empty() {
            mark(&mut left_out, &[after]);
            cuts.extend(cut(&mut closed, depot, node, &left_out));
        }
    }
    for from in 0..support.size {
        for &to in &precedence.successors[from] {
            work.breathe()?;
            if cuts.len() >= most {
                return Ok(cuts);
            }
            mark(&mut left_out, &[&precedence.predecessors[from], &precedence.successors[to]]);
            left_out[depot] = true;
            cuts.extend(cut(&mut open, from, to, &left_out));
        }
    }
    Ok(cuts)
}

fn mark(left_out: &mut [bool], lists: &[&Vec<usize>]) {
    left_out.fill(false);
    for &&node in lists.iter().flat_map(|list| list.iter()).collect::<Vec<_>>().iter() {
        left_out[node] = true;
    }
}

fn cut(flow: &mut Flow, from: usize, to: usize, left_out: &[bool]) -> Option<Crossing> {
    let (value, reached) = flow.run(from, to, left_out, TARGET);
    (value < TARGET).then(|| {
        let side = |node: usize| match (left_out[node], reached[node]) {
            (true, _) => Side::Neither,
            (_, true) => Side::From,
            _ => Side::To,
        };
        Crossing::new((0..left_out.len()).map(side).collect())
    })
}
