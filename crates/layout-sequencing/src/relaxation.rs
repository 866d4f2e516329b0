//! The order by neighbours alone: a path through the kinds, each as often as it has copies, at the least sum of offsets
//! in any poses. With kept order its length bounds every layout; its duals are the certificate.
//!
//! Up to some hundred copies, and thousands of few kinds, the ladder of tours proves it; thousands of kinds are searched
//! on few joins of each.

use crate::certificate::{BoundCertificate, JoinDuals};
use crate::instance::Instance;
use crate::lazy_relaxation::relax_lazily;
use crate::offsets::filled;
use crate::progress::{BoundsOnly, Progress};
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Interrupt, Observer, Seed, Silent};
use traverse_tours::{
    Certificate, CostMatrix, Ending, FORBIDDEN, Shape, SolveOptions, TourAnswer, TourSpecification, solve,
    verify_certificate_within,
};

/// The most copies that the ladder takes; with precedence, where every copy is a node.
const MOST_COPIES: usize = 600;
const MOST_ORDERED_COPIES: usize = 400;
/// The same where copies are of so few kinds that branch and cut over kinds proves.
const FEW_KINDS: usize = 200;
const MOST_COPIES_OF_FEW: usize = 2_500;

/// The most steps of the ladder when nothing else limits them: section matrices are proven in far fewer.
const MOST_STEPS: u64 = 100_000;

/// What the order by neighbours says.
#[derive(Debug, Default)]
pub(crate) struct Relaxed {
    /// Kinds from left to right, allowed.
    pub(crate) order: Option<Vec<usize>>,
    /// There is no allowed order.
    pub(crate) infeasible: bool,
    pub(crate) certificate: BoundCertificate,
    /// What the certificate proves.
    pub(crate) certified: i64,
}

/// Orders by neighbours; bounds are told to `progress` where they hold for layouts. Interrupted or not, what was found
/// comes back. The certificate is verified within `whole`, as the search may have used up its own budget.
pub(crate) fn relax(
    instance: &Instance,
    seed: Seed,
    threads: usize,
    progress: &mut Progress<'_>,
    budget: &Budget,
    whole: &Budget,
) -> Result<Relaxed, Interrupt> {
    if instance.copies == 1 {
        return Ok(Relaxed { order: Some(vec![0]), ..Relaxed::default() });
    }
    let few_kinds = instance.kinds.len() <= FEW_KINDS && instance.copies <= MOST_COPIES_OF_FEW;
    if (instance.copies > MOST_COPIES && !few_kinds) || !instance.has_all_offsets() {
        return Ok(relax_lazily(instance, seed, threads, progress, budget));
    }
    let count = instance.kinds.len();
    let row = |left: usize, row: &mut [i64]| {
        for (right, cost) in row.iter_mut().enumerate() {
            *cost = instance.kind_cost(left, right).unwrap_or(FORBIDDEN);
        }
    };
    let costs = filled(count, FORBIDDEN, threads, budget, row)?;
    let Ok(costs) = CostMatrix::new(count, costs) else { return Ok(Relaxed::default()) };
    let ordered = !instance.precedences.is_empty() && instance.copies <= MOST_ORDERED_COPIES;
    let specification = TourSpecification {
        quantities: (0..count).map(|kind| instance.quantity(kind) as u32).collect(),
        shape: Shape::Path,
        first: instance.first,
        last: instance.last,
        precedence: if ordered { instance.precedences.clone() } else { vec![] },
        costs,
    };
    let mut limited = budget.clone();
    limited.iterations = Some(limited.iterations.map_or(MOST_STEPS, |limit| limit.min(MOST_STEPS)));
    let options = SolveOptions { seed, threads, ..SolveOptions::default() };
    let widths = sum_of_widths(instance);
    let answer = {
        let mut bounds = BoundsOnly { progress, plus: widths };
        let silent: &mut dyn Observer = &mut Silent;
        let observer = if instance.rule == SlideRule::KeepOrder { &mut bounds } else { silent };
        solve(&specification, &options, &limited, observer)
    };
    let Ok(answer) = answer else { return Ok(Relaxed::default()) };
    progress.add_iterations(answer.iterations);
    let mut relaxed = Relaxed {
        infeasible: answer.ending == Ending::ProvenInfeasible,
        order: answer.tour.as_ref().map(|tour| tour.visits.clone()),
        ..Relaxed::default()
    };
    if instance.rule == SlideRule::KeepOrder && !relaxed.infeasible {
        progress.raise_bound(answer.lower_bound.saturating_add(widths));
        certify(instance, specification, &options, answer, &mut relaxed, whole);
    }
    Ok(relaxed)
}

pub(crate) fn sum_of_widths(instance: &Instance) -> i64 {
    let width = |kind: usize| instance.items[instance.kinds[kind].items.start].width;
    (0..instance.kinds.len()).map(|kind| width(kind) * instance.quantity(kind) as i64).sum()
}

/// Duals of the kinds become duals of the sections. With precedence every copy would have its own: there the certificate
/// is that of the question without it.
fn certify(
    instance: &Instance,
    specification: TourSpecification,
    options: &SolveOptions,
    answer: TourAnswer,
    relaxed: &mut Relaxed,
    budget: &Budget,
) {
    let answer = if specification.precedence.is_empty() {
        answer
    } else {
        let plain = TourSpecification { precedence: vec![], ..specification.clone() };
        let brief = Budget { iterations: Some(1_000), ..budget.share(0.5, 0) };
        match solve(&plain, options, &brief, &mut Silent) {
            Ok(answer) => answer,
            Err(_) => return,
        }
    };
    let plain = TourSpecification { precedence: vec![], ..specification };
    if let Ok(Ok(proven)) = verify_certificate_within(&plain, &answer.certificate, budget) {
        relaxed.certified = proven.saturating_add(sum_of_widths(instance));
        relaxed.certificate = BoundCertificate::Joins(duals_of_sections(instance, &answer.certificate));
    }
}

pub(crate) fn duals_of_sections(instance: &Instance, certificate: &Certificate) -> JoinDuals {
    let kinds = instance.kinds.len();
    // Duals and widths in parts may exceed a machine word together.
    let mm = |parts: i128| instance.grid.mm(1) * (parts as f64 / certificate.parts as f64);
    let dual = |parts: i64| mm(i128::from(parts));
    // Costs of kinds leave the width of the left one out.
    let width = |kind: usize| {
        let width = instance.items[instance.kinds[kind].items.start].width;
        i128::from(width) * i128::from(certificate.parts)
    };
    let sections = || (0..instance.sections()).map(|section| instance.kind_of(section));
    let last = kinds;
    let mut row_mm: Vec<f64> =
        sections().map(|kind| mm(i128::from(certificate.row[kind]) + width(kind))).collect();
    let mut column_mm: Vec<f64> = sections().map(|kind| dual(certificate.column[kind])).collect();
    row_mm.push(dual(certificate.row[last]));
    column_mm.push(dual(certificate.column[last]));
    let of_kinds = |set: &Vec<usize>| -> Vec<usize> {
        let own = sections().enumerate().filter(|(_, kind)| set.contains(kind)).map(|(section, _)| section);
        own.chain(set.contains(&last).then(|| instance.sections())).collect()
    };
    let sets = certificate.sets.iter().map(|(set, weight)| (of_kinds(set), dual(*weight))).collect();
    JoinDuals { row_mm, column_mm, sets }
}
