//! What rounded duals prove, in whole numbers: for any row duals u, column duals v and cut weights w ≥ 0,
//! Σ count·(u + v) + Σ w + Σ over arcs of the reduced cost at its cheaper bound is at most any tour's cost. So the
//! floating-point solver may err; what is concluded from it can't. Σ|from|·|to| of the weighted cuts, and O(arcs).

use crate::cuts::crossing::Crossing;

/// Duals are whole multiples of this part of a cost unit.
pub(crate) const PARTS: i64 = 1 << 16;

/// An arc that may be used, with how often.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BoundedArc {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) cost: i64,
    pub(crate) lower: u32,
    pub(crate) upper: u32,
}

/// Duals in parts of a cost unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Duals {
    pub(crate) row: Vec<i64>,
    pub(crate) column: Vec<i64>,
    /// Number of the cut, weight.
    pub(crate) cuts: Vec<(usize, i64)>,
}

impl Duals {
    /// From duals in whole units, cut off where they don't fit: [`ExactBound`] counts what is asked too much.
    pub(crate) fn of_whole(row: &[i64], column: &[i64]) -> Self {
        let scaled = |duals: &[i64]| duals.iter().map(|dual| dual.saturating_mul(PARTS)).collect();
        Self { row: scaled(row), column: scaled(column), cuts: vec![] }
    }
}

/// A bound in parts of a cost unit, and every arc's reduced cost in them.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExactBound {
    pub(crate) parts: i128,
    pub(crate) reduced: Vec<i128>,
}

impl ExactBound {
    /// The least whole cost that is not below the bound.
    pub(crate) fn cost(&self) -> i64 {
        let up = self.parts.div_euclid(i128::from(PARTS))
            + i128::from(self.parts.rem_euclid(i128::from(PARTS)) > 0);
        up.clamp(i128::from(i64::MIN / 4), i128::from(i64::MAX / 4)) as i64
    }

    /// What the duals prove about arcs with these bounds.
    pub(crate) fn of(counts: &[u32], arcs: &[BoundedArc], cuts: &[Crossing], duals: &Duals) -> Self {
        let size = counts.len();
        let mut weights = vec![0_i128; size * size];
        let mut parts = 0_i128;
        for &(cut, weight) in &duals.cuts {
            parts += i128::from(weight);
            for &from in cuts[cut].from() {
                for &to in cuts[cut].to() {
                    weights[from * size + to] += i128::from(weight);
                }
            }
        }
        for (node, &count) in counts.iter().enumerate() {
            parts += i128::from(count) * (i128::from(duals.row[node]) + i128::from(duals.column[node]));
        }
        let reduced: Vec<i128> = arcs
            .iter()
            .map(|arc| {
                i128::from(arc.cost) * i128::from(PARTS)
                    - i128::from(duals.row[arc.from])
                    - i128::from(duals.column[arc.to])
                    - weights[arc.from * size + arc.to]
            })
            .collect();
        for (arc, &reduced) in arcs.iter().zip(&reduced) {
            parts += reduced * i128::from(if reduced < 0 { arc.upper } else { arc.lower });
        }
        Self { parts, reduced }
    }
}
