//! The order by neighbours of thousands of copies: nodes are copies, joins are computed when they are asked for unless
//! they are at hand, and floors of joins tell which need not be. Memory is linear in the copies.

use crate::certificate::BoundCertificate;
use crate::instance::Instance;
use crate::progress::{BoundsOnly, Progress};
use crate::relaxation::{Relaxed, duals_of_sections, sum_of_widths};
use crate::sampled_borders::SampledBorders;
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Observer, Seed, Silent};
use traverse_tours::{Certificate, Costs, FORBIDDEN, LazyAnswer, search_lazily};

/// Kicks of the tour for each copy, at most.
const KICKS: u64 = 50;

/// Copies as nodes, and last the ends of the strip; costs are offsets, computed on demand.
struct CopyCosts<'a> {
    instance: &'a Instance,
    kind_of: Vec<usize>,
    /// Where offsets are not at hand.
    borders: Option<SampledBorders>,
}

impl Costs for CopyCosts<'_> {
    fn size(&self) -> usize {
        self.kind_of.len() + 1
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        match (self.kind_of.get(from), self.kind_of.get(to)) {
            (None, None) => FORBIDDEN,
            (None, Some(&kind)) => end_cost(self.instance.first, kind),
            (Some(&kind), None) => end_cost(self.instance.last, kind),
            (Some(_), Some(_)) if from == to => FORBIDDEN,
            (Some(&left), Some(&right)) => self.instance.kind_cost(left, right).unwrap_or(FORBIDDEN),
        }
    }

    fn floor(&self, from: usize, to: usize) -> i64 {
        match (self.kind_of.get(from), self.kind_of.get(to)) {
            (Some(&left), Some(&right)) if from != to && self.instance.may_join(left, right) => {
                match &self.borders {
                    Some(borders) => borders.floor(self.instance, left, right),
                    None => self.cost(from, to),
                }
            }
            _ => self.cost(from, to),
        }
    }
}

/// What it costs to begin or end with a kind.
fn end_cost(asked: Option<usize>, kind: usize) -> i64 {
    if asked.is_none_or(|asked| asked == kind) { 0 } else { FORBIDDEN }
}

/// Orders thousands of copies; the bound is the assignment's.
pub(crate) fn relax_lazily(
    instance: &Instance,
    seed: Seed,
    threads: usize,
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Relaxed {
    let kind_of: Vec<usize> = (0..instance.kinds.len())
        .flat_map(|kind| std::iter::repeat_n(kind, instance.quantity(kind)))
        .collect();
    let borders = if instance.has_all_offsets() {
        None
    } else {
        let Ok(borders) = SampledBorders::of(instance, budget) else { return Relaxed::default() };
        Some(borders)
    };
    let costs = CopyCosts { instance, kind_of, borders };
    let mut limited = budget.clone();
    let most = KICKS * instance.copies as u64;
    limited.iterations = Some(limited.iterations.map_or(most, |limit| limit.min(most)));
    let widths = sum_of_widths(instance);
    let answer: LazyAnswer = {
        let mut bounds = BoundsOnly { progress, plus: widths };
        let silent: &mut dyn Observer = &mut Silent;
        let observer = if instance.rule == SlideRule::KeepOrder { &mut bounds } else { silent };
        search_lazily(&costs, seed, threads, &limited, observer)
    };
    progress.add_iterations(answer.iterations);
    let ends = instance.copies;
    let begin = answer.order.iter().position(|&node| node == ends).unwrap_or(0);
    let turned = answer.order[begin..].iter().chain(&answer.order[..begin]);
    let order = turned.filter(|&&node| node != ends).map(|&node| costs.kind_of[node]).collect();
    let mut relaxed = Relaxed { order: answer.cost.map(|_| order), ..Relaxed::default() };
    if instance.rule == SlideRule::KeepOrder && answer.lower_bound.is_some() {
        let certificate = duals_of_kinds(instance, &costs.kind_of, &answer);
        relaxed.certified = proven_by(instance, &certificate).saturating_add(widths);
        relaxed.certificate = BoundCertificate::Joins(duals_of_sections(instance, &certificate));
        progress.raise_bound(relaxed.certified);
    }
    relaxed
}

/// Duals of copies become duals of kinds: the largest of each kind stays feasible between kinds, as all its copies see
/// the same costs. Behind a copy of itself a kind gives way.
fn duals_of_kinds(instance: &Instance, kind_of: &[usize], answer: &LazyAnswer) -> Certificate {
    let kinds = instance.kinds.len();
    let largest = |duals: &[i64]| {
        let mut largest = vec![i64::MIN; kinds];
        for (&kind, &dual) in kind_of.iter().zip(duals) {
            largest[kind] = largest[kind].max(dual);
        }
        largest.extend(duals.get(kind_of.len()));
        largest
    };
    let (mut row, column) = (largest(&answer.row), largest(&answer.column));
    for kind in (0..kinds).filter(|&kind| instance.quantity(kind) > 1) {
        if let Some(cost) = instance.kind_cost(kind, kind) {
            row[kind] = row[kind].min(cost - column[kind]);
        }
    }
    Certificate { parts: 1, row, column, sets: vec![] }
}

/// What duals of kinds and of the ends prove.
fn proven_by(instance: &Instance, certificate: &Certificate) -> i64 {
    let quantity = |node: usize| if node < instance.kinds.len() { instance.quantity(node) as i64 } else { 1 };
    let duals = certificate.row.iter().zip(&certificate.column);
    let paid = |(node, (&row, &column)): (usize, (&i64, &i64))| {
        i128::from(quantity(node)) * (i128::from(row) + i128::from(column))
    };
    let proven: i128 = duals.enumerate().map(paid).sum();
    // Below whatever a layout can come to, it is nothing anyway.
    proven.clamp(i128::from(i64::MIN / 2), i128::from(i64::MAX / 2)) as i64
}
