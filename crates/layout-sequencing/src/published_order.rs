//! Orders by the methods of 2009: every copy a node, effects of neighbours, every section held at the end in turn, best
//! of all. Each section stands in the first of its allowed poses: those methods choose none.

use crate::instance::Instance;
use crate::options::{Algorithm, EffectModel};
use crate::placing::Placing;
use crate::progress::Progress;
use crate::published_effect::Facing;
use traverse_geometry::SectionLayout;
use traverse_solve::{Budget, Interrupt, Seed};
use traverse_tours::{FORBIDDEN, Method, SectionModel, SolveOptions, order_with_every_end};

/// Orders as published; every better order is placed exactly and offered. Whether there is an order at all, as far as
/// was found out.
pub(crate) fn order_as_published(
    layout: &SectionLayout,
    instance: &Instance,
    algorithm: Algorithm,
    model: EffectModel,
    seed: Seed,
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<(), Interrupt> {
    let copies: Vec<usize> = (0..instance.kinds.len())
        .flat_map(|kind| std::iter::repeat_n(kind, instance.quantity(kind)))
        .collect();
    if copies.len() < 2 {
        return offer(instance, &copies, progress, budget);
    }
    let effects = kind_effects(layout, instance, model, budget)?;
    let kinds = instance.kinds.len();
    let effect = |at: usize| {
        let (left, right) = (copies[at / copies.len()], copies[at % copies.len()]);
        // What must come first has nothing on its left, what must come last nothing on its right.
        let ends = instance.first == Some(right) && instance.quantity(right) == 1
            || instance.last == Some(left) && instance.quantity(left) == 1;
        if ends || !instance.may_join(left, right) { FORBIDDEN } else { effects[left * kinds + right] }
    };
    let matrix: Vec<i64> = (0..copies.len() * copies.len()).map(effect).collect();
    let method = match algorithm {
        Algorithm::AntColony => Method::AntColony,
        Algorithm::LocalImprovement => Method::SuccessiveImprovement,
        Algorithm::BranchAndBound => Method::BranchAndBound,
        Algorithm::Best | Algorithm::GivenOrder => Method::Ladder,
    };
    let options = SolveOptions { method, seed, threads: 1 };
    let model = SectionModel::Complement;
    let mut best: Option<Vec<usize>> = None;
    let mut heard = |order: &[usize], _saved: i64| {
        best = Some(order.iter().map(|&node| copies[node]).collect());
    };
    // The matrix is square and its costs are in range: no findings.
    let _ = order_with_every_end(&matrix, copies.len(), model, &options, budget, &mut heard);
    if let Some(order) = best.filter(|order| instance.is_allowed(order)) {
        // Its share may be used up: what was found counts all the same.
        offer(instance, &order, progress, &Budget { deadline: None, iterations: None, ..budget.clone() })?;
    }
    progress.add_iterations(copies.len() as u64);
    budget.check(progress.iterations())
}

fn offer(
    instance: &Instance,
    order: &[usize],
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<(), Interrupt> {
    let items: Vec<usize> = order.iter().map(|&kind| instance.kinds[kind].items.start).collect();
    progress.offer(&items, Placing::of(instance, &items, budget)?.length());
    Ok(())
}

/// Effects of kinds in their first poses, on the grid, row by row.
fn kind_effects(
    layout: &SectionLayout,
    instance: &Instance,
    model: EffectModel,
    budget: &Budget,
) -> Result<Vec<i64>, Interrupt> {
    let kinds = &instance.kinds;
    let mut effects = vec![];
    let facings: Vec<Facing> = match model {
        EffectModel::Exact => vec![],
        EffectModel::Published => kinds
            .iter()
            .map(|kind| Facing::of(&layout.sections[kind.section], instance.items[kind.items.start].pose))
            .collect(),
    };
    for left in 0..kinds.len() {
        budget.check(0)?;
        for right in 0..kinds.len() {
            let (i, j) = (kinds[left].items.start, kinds[right].items.start);
            effects.push(match model {
                EffectModel::Exact => instance.items[i].reach - instance.offset(i, j).max(0),
                EffectModel::Published => instance.grid.down(facings[left].effect(&facings[right])),
            });
        }
    }
    Ok(effects)
}
