//! Prices of poses: what makes the order by neighbours choose one pose for both joins of a section.
//!
//! The least offset of two kinds over their poses lets a section stand in one pose to its left neighbour and in another
//! to its right one. A price for each item, paid where it stands on the left of a join and given back where it stands on
//! the right, cancels in every layout and makes such choices dear: a Lagrangian bound (Held and Karp 1971), valid for
//! whatever prices. They follow the subgradient of the assignment's bound; then tours order by the best of them. An
//! iteration costs a look at all pairs of items and an assignment.

use crate::instance::Instance;
use crate::pose_choice::choose_poses;
use crate::progress::Progress;
use crate::relaxation::sum_of_widths;
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Interrupt, Seed, Silent};
use traverse_tours::{
    Assignment, CostMatrix, Costs, Ending, FORBIDDEN, Matched, SolveOptions, TourSpecification, Work, solve,
};

/// The most copies for which prices are sought.
const MOST_COPIES: usize = 600;
/// Changes of prices, at most.
const ROUNDS: usize = 1_000;
/// Rounds without a better bound after which steps are halved.
const PATIENCE: usize = 10;
/// Steps of this part of a full one are the last.
const LEAST_EAGERNESS: f64 = 0.002;
/// Steps of tours with the prices found.
const STEPS: u64 = 5_000;

/// Joins at prices: kinds, and last the ends of the strip.
struct Priced {
    costs: CostMatrix,
    /// In which items the join of two kinds is cheapest.
    items: Vec<(usize, usize)>,
}

/// Raises the bound by prices of poses, where there is a choice, and offers the layout that they lead to.
pub(crate) fn order_at_prices(
    instance: &Instance,
    seed: Seed,
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<Option<Vec<usize>>, Interrupt> {
    let kept = instance.rule == SlideRule::KeepOrder && instance.has_all_offsets();
    if !kept || !instance.has_choice_of_pose() || !(2..=MOST_COPIES).contains(&instance.copies) {
        return Ok(None);
    }
    let widths = sum_of_widths(instance);
    let best = best_prices(instance, progress, widths, budget);
    let Some(priced) = priced(instance, &best) else { return Ok(None) };
    let mut quantities: Vec<u32> =
        (0..instance.kinds.len()).map(|kind| instance.quantity(kind) as u32).collect();
    quantities.push(1);
    let specification = TourSpecification { quantities, ..TourSpecification::cycle(priced.costs) };
    let options = SolveOptions { seed, threads: 1, ..SolveOptions::default() };
    let limited = Budget {
        iterations: Some(budget.iterations.map_or(STEPS, |most| most.min(STEPS))),
        ..budget.clone()
    };
    let Ok(answer) = solve(&specification, &options, &limited, &mut Silent) else { return Ok(None) };
    progress.add_iterations(answer.iterations);
    if answer.ending == Ending::ProvenInfeasible {
        return Ok(None);
    }
    progress.raise_bound(answer.lower_bound.saturating_add(widths));
    let Some(tour) = answer.tour else { return Ok(None) };
    let ends = instance.kinds.len();
    let begin = tour.visits.iter().position(|&node| node == ends).unwrap_or(0);
    let turned = tour.visits[begin..].iter().chain(&tour.visits[..begin]);
    let order: Vec<usize> = turned.copied().filter(|&node| node != ends).collect();
    if !instance.is_allowed(&order) {
        return Ok(None);
    }
    choose_poses(instance, &order, budget).map(Some)
}

/// The prices with the best bound that was found, one for each item. Interrupted or not, the best so far count.
fn best_prices(instance: &Instance, progress: &mut Progress<'_>, widths: i64, budget: &Budget) -> Vec<i64> {
    let mut prices = vec![0.0; instance.items.len()];
    let mut best = (i64::MIN, vec![0; instance.items.len()]);
    let (mut eagerness, mut idle) = (1.0, 0);
    let work = Work::new(budget);
    for round in 0..ROUNDS {
        let whole: Vec<i64> = prices.iter().map(|&price: &f64| price.round() as i64).collect();
        let Some(priced) = priced(instance, &whole) else { break };
        let Ok((bound, uneven)) = bound_of(instance, &priced, &work) else { break };
        let Some(bound) = bound else { break };
        progress.add_iterations(1);
        idle += 1;
        if bound > best.0 {
            best = (bound, whole);
            idle = 0;
        }
        let length: f64 = uneven.iter().map(|&uneven| (uneven * uneven) as f64).sum();
        let missing = progress.upper().saturating_sub(widths).saturating_sub(bound);
        if length == 0.0
            || missing <= 0
            || eagerness < LEAST_EAGERNESS
            || budget.check(round as u64 + 1).is_err()
        {
            break;
        }
        if idle > PATIENCE {
            (eagerness, idle) = (eagerness / 2.0, 0);
        }
        let most = instance.longest_reach as f64;
        let step = eagerness * (missing as f64).min(most) / length;
        for (price, &uneven) in prices.iter_mut().zip(&uneven) {
            *price = (*price + step * uneven as f64).clamp(-most, most);
        }
    }
    best.1
}

/// Nothing when costs would be too large for tours.
fn priced(instance: &Instance, prices: &[i64]) -> Option<Priced> {
    let kinds = instance.kinds.len();
    let mut costs = vec![FORBIDDEN; (kinds + 1) * (kinds + 1)];
    let mut items = vec![(0, 0); costs.len()];
    let items_of = |kind: usize| instance.kinds[kind].items.clone();
    for left in 0..kinds {
        let width = instance.items[items_of(left).start].width;
        for right in 0..kinds {
            if !instance.may_join(left, right) || (left == right && instance.quantity(left) == 1) {
                continue;
            }
            let pairs = items_of(left).flat_map(|i| items_of(right).map(move |j| (i, j)));
            let cost =
                |&(i, j): &(usize, usize)| instance.offset(i, j).max(0) + prices[i] - prices[j] - width;
            let at = left * (kinds + 1) + right;
            if let Some(pair) = pairs.min_by_key(cost) {
                (costs[at], items[at]) = (cost(&pair), pair);
            }
        }
        if instance.first.is_none_or(|first| first == left)
            && let Some(item) = items_of(left).max_by_key(|&item| prices[item])
        {
            let at = kinds * (kinds + 1) + left;
            (costs[at], items[at]) = (-prices[item], (item, item));
        }
        if instance.last.is_none_or(|last| last == left)
            && let Some(item) = items_of(left).min_by_key(|&item| prices[item])
        {
            let at = left * (kinds + 1) + kinds;
            (costs[at], items[at]) = (prices[item], (item, item));
        }
    }
    let costs = CostMatrix::new(kinds + 1, costs).ok()?;
    Some(Priced { costs, items })
}

/// Joins at prices with every copy as a node.
struct Copies<'a> {
    priced: &'a Priced,
    kind_of: Vec<usize>,
}

impl Costs for Copies<'_> {
    fn size(&self) -> usize {
        self.kind_of.len()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        if from == to { FORBIDDEN } else { self.priced.costs.cost(self.kind_of[from], self.kind_of[to]) }
    }
}

/// The assignment's bound, and for each item how much oftener it stands on the left of a join than on the right.
fn bound_of(
    instance: &Instance,
    priced: &Priced,
    work: &Work<'_>,
) -> Result<(Option<i64>, Vec<i64>), Interrupt> {
    let kinds = instance.kinds.len();
    let copies = (0..kinds).flat_map(|kind| std::iter::repeat_n(kind, instance.quantity(kind)));
    let copies = Copies { priced, kind_of: copies.chain([kinds]).collect() };
    let (assignment, matched) = Assignment::solve(&copies, work)?;
    let mut uneven = vec![0; instance.items.len()];
    if matched == Matched::None {
        return Ok((None, uneven));
    }
    for (from, &to) in assignment.successor.iter().enumerate() {
        let (left, right) = (copies.kind_of[from], copies.kind_of[to]);
        let (i, j) = priced.items[left * (kinds + 1) + right];
        uneven[i] += i64::from(left < kinds);
        uneven[j] -= i64::from(right < kinds);
    }
    Ok((Some(assignment.bound()), uneven))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section, SectionLayout};

    fn layout(count: usize, chance: &mut impl RngExt) -> SectionLayout {
        let mut section = |id: usize| {
            let mut xy = vec![];
            for (base, upwards) in [(60.0, true), (0.0, false)] {
                for step in 0..5 {
                    let y = 25.0 * f64::from(if upwards { step } else { 4 - step });
                    xy.extend([base + chance.random_range(0.0..40.0), y]);
                }
            }
            let shape = Polygon::from_ring(Ring::from_xy(&xy, &[]).expect("chains don't cross"));
            let part =
                Part { id: "part".into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false };
            let quantity = 1 + u32::from(id == 2);
            Section { id: id.to_string(), parts: vec![part], quantity, poses: Pose::ALL[..2].to_vec() }
        };
        SectionLayout::new((0..count).map(&mut section).collect())
    }

    #[test]
    fn prices_cancel_in_every_order_and_raise_the_bound() {
        let mut chance = Seed(8).stream();
        let budget = Budget::unlimited();
        let mut raised = 0;
        for _ in 0..20 {
            let instance = Instance::of(&layout(8, &mut chance), 1, &budget).expect("no limit");
            let items: Vec<usize> = instance
                .kinds
                .iter()
                .flat_map(|kind| {
                    std::iter::repeat_n(chance.random_range(kind.items.clone()), kind.copies.len())
                })
                .collect();
            let prices: Vec<i64> = items.iter().map(|_| chance.random_range(-9_000_000..9_000_000)).collect();
            let prices: Vec<i64> = prices.iter().cycle().take(instance.items.len()).copied().collect();
            let free = priced(&instance, &vec![0; instance.items.len()]).expect("small");
            let dear = priced(&instance, &prices).expect("small");
            let ends = instance.kinds.len();
            let mut paid = 0;
            let mut sum = -prices[items[0]] + prices[items[items.len() - 1]];
            let kind = |item: usize| instance.items[item].kind;
            paid +=
                dear.costs.cost(ends, kind(items[0])) + dear.costs.cost(kind(items[items.len() - 1]), ends);
            for pair in items.windows(2) {
                let width = instance.items[pair[0]].width;
                let join = instance.offset(pair[0], pair[1]) - width;
                sum += join + prices[pair[0]] - prices[pair[1]];
                paid += dear.costs.cost(kind(pair[0]), kind(pair[1]));
            }
            let joins: i64 = items
                .windows(2)
                .map(|pair| instance.offset(pair[0], pair[1]) - instance.items[pair[0]].width)
                .sum();
            assert_eq!(sum, joins);
            assert!(paid <= joins);
            let work = Work::new(&budget);
            let plain = bound_of(&instance, &free, &work).expect("no limit").0.expect("nothing is forbidden");
            let mut silent = Silent;
            let mut progress = Progress::new(&instance, None, &mut silent);
            progress.offer(
                &items,
                crate::placing::Placing::of(&instance, &items, &budget).expect("no limit").length(),
            );
            let best = best_prices(&instance, &mut progress, sum_of_widths(&instance), &budget);
            let best = priced(&instance, &best).expect("small");
            let best = bound_of(&instance, &best, &work).expect("no limit").0.expect("nothing is forbidden");
            assert!(plain <= best && best <= joins);
            raised += usize::from(plain < best);
        }
        assert!(raised > 10, "{raised}");
    }
}
