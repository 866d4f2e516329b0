//! Duals that prove a bound without a search, and the checker that recomputes it.
//!
//! With row duals u, column duals v and weights w ≥ 0 of node sets S such that for every allowed arc
//! u_i + v_j + Σ over sets that the arc leaves of w ≤ c_ij, every tour costs at least
//! Σ count·u + Σ count·v + Σ w, because it leaves every set. The checker costs O(n² + Σ |S|·(n − |S|)) and knows
//! nothing of how the duals came about. Nodes are those of the specification; a path (and whatever else has ends)
//! has one more, the last, from which it begins and to which it returns; with precedence every visit is a node.

use crate::TourSpecification;
use crate::cost::{Costs, FORBIDDEN};
use crate::cuts::crossing::Crossing;
use crate::exact_bound::{Duals, PARTS};
use crate::network::Network;
use traverse_solve::{Budget, Interrupt};

/// Duals that prove a bound.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Certificate {
    /// All duals and weights are in this part of a cost unit.
    pub parts: i64,
    /// Dual of each row.
    pub row: Vec<i64>,
    /// Dual of each column.
    pub column: Vec<i64>,
    /// Sets that a tour must leave, with what each visit of that costs.
    pub sets: Vec<(Vec<usize>, i64)>,
}

impl Certificate {
    /// The cheapest arc out of each node, a certificate that costs nothing, with the bound.
    pub(crate) fn row_minima(costs: &[i64], counts: &[u32]) -> (Self, i64) {
        let least = |row: &[i64]| row.iter().copied().filter(|&cost| cost != FORBIDDEN).min().unwrap_or(0);
        let row: Vec<i64> = costs.chunks(counts.len()).map(least).collect();
        let bound = row.iter().zip(counts).map(|(dual, &count)| dual * i64::from(count)).sum();
        (Self { parts: 1, row, column: vec![0; counts.len()], sets: vec![] }, bound)
    }

    /// From whole duals of types, without sets, to those of the nodes that they stand for, with the bound: in parts of a
    /// unit where these fit, which those of hundreds of nodes at the largest costs may not.
    pub(crate) fn of_assignment(
        nodes: usize,
        counts: &[u32],
        members: &[Vec<usize>],
        row: &[i64],
        column: &[i64],
    ) -> (Self, i64) {
        let fit = row.iter().chain(column).all(|dual| dual.checked_mul(PARTS).is_some());
        let parts = if fit { PARTS } else { 1 };
        let scaled = |duals: &[i64]| duals.iter().map(|dual| dual * parts).collect();
        let duals = Duals { row: scaled(row), column: scaled(column), cuts: vec![] };
        Self::in_parts(parts, nodes, counts, members, &duals, &[])
    }

    /// From duals of types to duals of the nodes that they stand for, with the bound.
    pub(crate) fn expanded(
        nodes: usize,
        counts: &[u32],
        members: &[Vec<usize>],
        duals: &Duals,
        cuts: &[Crossing],
    ) -> (Self, i64) {
        Self::in_parts(PARTS, nodes, counts, members, duals, cuts)
    }

    fn in_parts(
        parts: i64,
        nodes: usize,
        counts: &[u32],
        members: &[Vec<usize>],
        duals: &Duals,
        cuts: &[Crossing],
    ) -> (Self, i64) {
        let (mut row, mut column) = (vec![0; nodes], vec![0; nodes]);
        for (kind, members) in members.iter().enumerate() {
            for &node in members {
                row[node] = duals.row[kind];
                column[node] = duals.column[kind];
            }
        }
        let connectivity = duals.cuts.iter().filter(|(cut, _)| cuts[*cut].is_connectivity());
        let sets: Vec<(Vec<usize>, i64)> = connectivity
            .map(|&(cut, weight)| {
                (cuts[cut].from().iter().flat_map(|&kind| members[kind].clone()).collect(), weight)
            })
            .collect();
        let mut total: i128 = sets.iter().map(|&(_, weight)| i128::from(weight)).sum();
        for node in 0..nodes {
            total += i128::from(counts[node]) * (i128::from(row[node]) + i128::from(column[node]));
        }
        (Self { parts, row, column, sets }, rounded_up(total, parts))
    }
}

fn rounded_up(total: i128, parts: i64) -> i64 {
    let parts = i128::from(parts);
    let up = total.div_euclid(parts) + i128::from(total.rem_euclid(parts) > 0);
    i64::try_from(up).unwrap_or(if up > 0 { i64::MAX } else { i64::MIN })
}

/// Why a certificate proves nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CertificateFault {
    /// The specification has findings of its own.
    #[error("the specification can't be solved: see its findings")]
    Specification,
    /// Duals and nodes don't match in number.
    #[error("the certificate has {duals} duals for {nodes} nodes")]
    Size {
        /// Duals of rows or columns.
        duals: usize,
        /// Nodes there are.
        nodes: usize,
    },
    /// Parts must be a positive number.
    #[error("parts is {parts}: it must be from 1 to 2^30")]
    Parts {
        /// What stands there.
        parts: i64,
    },
    /// A set that a tour need not leave, or a negative weight.
    #[error(
        "set {set} proves nothing: it needs some but not all nodes, each once, and a weight of 0 at least"
    )]
    Set {
        /// Number of the set.
        set: usize,
    },
    /// The duals ask more of an arc than it costs.
    #[error("duals and weights exceed the cost of the arc from {from} to {to}")]
    Arc {
        /// From node.
        from: usize,
        /// To node.
        to: usize,
    },
}

/// The bound that a certificate proves, recomputed.
///
/// # Errors
/// Why it proves nothing.
pub fn verify_certificate(
    specification: &TourSpecification,
    certificate: &Certificate,
) -> Result<i64, CertificateFault> {
    verify_certificate_within(specification, certificate, &Budget::unlimited()).unwrap_or(Ok(0))
}

/// The same, as long as `budget` lasts: it is looked at for every set and row.
///
/// # Errors
/// That the budget ended; within, why the certificate proves nothing.
pub fn verify_certificate_within(
    specification: &TourSpecification,
    certificate: &Certificate,
    budget: &Budget,
) -> Result<Result<i64, CertificateFault>, Interrupt> {
    if !specification.findings().is_empty() {
        return Ok(Err(CertificateFault::Specification));
    }
    let network = Network::of(specification);
    if network.visits() < 2 {
        return Ok(Ok(0));
    }
    let nodes = network.size;
    for duals in [&certificate.row, &certificate.column] {
        if duals.len() != nodes {
            return Ok(Err(CertificateFault::Size { duals: duals.len(), nodes }));
        }
    }
    if !(1..=1 << 30).contains(&certificate.parts) {
        return Ok(Err(CertificateFault::Parts { parts: certificate.parts }));
    }
    let mut weights = vec![0_i128; nodes * nodes];
    let mut total = 0_i128;
    for (set, (members, weight)) in certificate.sets.iter().enumerate() {
        budget.check(0)?;
        let mut inside = vec![false; nodes];
        let fresh = members.iter().all(|&node| node < nodes && !std::mem::replace(&mut inside[node], true));
        if !fresh || members.is_empty() || members.len() >= nodes || *weight < 0 {
            return Ok(Err(CertificateFault::Set { set }));
        }
        total += i128::from(*weight);
        for &from in members {
            for to in (0..nodes).filter(|&to| !inside[to]) {
                weights[from * nodes + to] += i128::from(*weight);
            }
        }
    }
    for from in 0..nodes {
        budget.check(0)?;
        let count = i128::from(network.counts[from]);
        total += count * (i128::from(certificate.row[from]) + i128::from(certificate.column[from]));
        for to in 0..nodes {
            let cost = network.cost(from, to);
            let asked = i128::from(certificate.row[from])
                + i128::from(certificate.column[to])
                + weights[from * nodes + to];
            if cost != FORBIDDEN && asked > i128::from(cost) * i128::from(certificate.parts) {
                return Ok(Err(CertificateFault::Arc { from, to }));
            }
        }
    }
    Ok(Ok(rounded_up(total, certificate.parts)))
}
