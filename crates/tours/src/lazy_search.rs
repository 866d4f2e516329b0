//! Tours of thousands of nodes whose costs are computed when asked for: sparse assignment with looks at every pair
//! until none is missed, then local search on the arcs that are cheapest beyond its duals. Memory is O(n · width).

use crate::cheapest_arcs::cheapest_arcs;
use crate::cost::{Costs, FORBIDDEN};
use crate::local_search::{LocalSearch, cycle_cost};
use crate::neighbours::Neighbours;
use crate::sparse_assignment::{Arc, SparseAssignment};
use crate::work::Work;
use traverse_solve::{Budget, Interrupt, Observer, Seed};

/// Arcs out of a node that local search sees.
const WIDTH: usize = 10;
/// Rows from which the first duals are taken.
const SAMPLED_ROWS: usize = 256;
/// Looks at every pair after which the assignment is good enough.
const MOST_LOOKS: u32 = 12;
/// With more nodes than this a look that raises the bound by less than this part of it is the last.
const FEW: usize = 3_000;
const LEAST_RISE: i64 = 5_000;
/// Kicks between two looks at the best cost.
const BURST: u64 = 500;

/// The best tour of a lazy search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LazyAnswer {
    /// Every node once, back to the first.
    pub order: Vec<usize>,
    /// What it costs; absent when it uses a forbidden arc.
    pub cost: Option<i64>,
    /// No tour costs less. Absent when the budget ended before every pair was looked at.
    pub lower_bound: Option<i64>,
    /// Duals that prove it: row and column together are at most what the arc between two different nodes costs, if it
    /// is allowed, and all of them add up to the bound. Empty when there is none.
    pub row: Vec<i64>,
    /// Likewise.
    pub column: Vec<i64>,
    /// Kicks.
    pub iterations: u64,
    /// Why it stopped; absent when cost and bound met.
    pub interrupt: Option<Interrupt>,
}

/// Searches until the budget ends or cost and bound meet. Threads share the looks at every pair and change nothing but
/// the time.
pub fn search_lazily(
    costs: &impl Costs,
    seed: Seed,
    threads: usize,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> LazyAnswer {
    let mut work = Work::new(budget);
    let mut answer = LazyAnswer {
        order: (0..costs.size()).collect(),
        cost: None,
        lower_bound: None,
        row: vec![],
        column: vec![],
        iterations: 0,
        interrupt: None,
    };
    answer.cost = true_cost(costs, &answer.order);
    answer.interrupt = run(costs, seed, threads, &mut answer, &mut work, observer).err();
    answer.iterations = work.iterations();
    answer
}

fn run(
    costs: &impl Costs,
    seed: Seed,
    threads: usize,
    answer: &mut LazyAnswer,
    work: &mut Work<'_>,
    observer: &mut dyn Observer,
) -> Result<(), Interrupt> {
    let mut assignment = SparseAssignment::solve(first_lists(costs, threads, work)?, work)?;
    let cheapest = match look_until_none_is_missed(costs, threads, &mut assignment, answer, work, observer) {
        Ok(cheapest) => cheapest,
        Err(interrupt) => {
            // What is matched so far is near the best already.
            let order = assignment.order();
            let cost = true_cost(costs, &order);
            if cost.is_some_and(|cost| answer.cost.is_none_or(|best| cost < best)) {
                (answer.order, answer.cost) = (order, cost);
            }
            return Err(interrupt);
        }
    };
    let neighbours = Neighbours::from_lists(&cheapest);
    // The duals that cost and lists are seen by; local search needs no feasible ones.
    let guide = LazyGuide { costs, row: &assignment.row, column: &assignment.column };
    let mut search = LocalSearch::new(&guide, &neighbours, assignment.order(), seed.stream());
    let (_, start) = search.best();
    let mut told = i64::MAX;
    let mut done = search.descend(work);
    loop {
        let (order, cost) = search.best();
        if cost < told {
            told = cost;
            let true_cost = true_cost(costs, order);
            if true_cost.is_some_and(|cost| answer.cost.is_none_or(|best| cost < best)) {
                answer.order = order.to_vec();
                answer.cost = true_cost;
                observer.better_cost(true_cost.unwrap_or(start) as f64);
            }
        }
        done?;
        if answer.cost == answer.lower_bound {
            return Ok(());
        }
        done = search.kicks(BURST, work);
    }
}

/// Looks at every pair until the assignment is that of all of them, or near enough. The arcs out of each node that are
/// cheapest beyond its duals.
fn look_until_none_is_missed(
    costs: &impl Costs,
    threads: usize,
    assignment: &mut SparseAssignment,
    answer: &mut LazyAnswer,
    work: &Work<'_>,
    observer: &mut dyn Observer,
) -> Result<Vec<Vec<usize>>, Interrupt> {
    let mut looks = 0;
    loop {
        looks += 1;
        // What the look unmatches is matched again before the order is asked for.
        let look = assignment.look(costs, WIDTH, threads, work)?;
        let least_rise = look.bound.abs() / LEAST_RISE;
        let flat = answer.lower_bound.is_some_and(|bound| look.bound - bound < least_rise);
        if answer.lower_bound.is_none_or(|bound| look.bound > bound) {
            answer.lower_bound = Some(look.bound);
            answer.row.clone_from(&assignment.row);
            answer.column.clone_from(&assignment.column);
            observer.better_bound(look.bound as f64);
        }
        assignment.rematch(work)?;
        if look.missed == 0 || looks == MOST_LOOKS || (flat && costs.size() > FEW) {
            return Ok(look.cheapest);
        }
    }
}

/// The cheapest arcs out of each node, and the cheapest into each, beyond rough duals: what is cheap for everyone does
/// not crowd out what is needed.
fn first_lists(costs: &impl Costs, threads: usize, work: &Work<'_>) -> Result<Vec<Vec<Arc>>, Interrupt> {
    let column = rough_duals(costs, work)?;
    let out = cheapest_arcs(costs, &column, WIDTH, threads, work)?;
    let row: Vec<i64> = out.iter().map(|arcs| arcs.first().map_or(0, |first| first.0)).collect();
    let into = cheapest_arcs(&Reversed(costs), &row, WIDTH, threads, work)?;
    let mut lists: Vec<Vec<Arc>> =
        out.iter().map(|arcs| arcs.iter().map(|&(beyond, to)| (to, beyond + column[to])).collect()).collect();
    for (to, arcs) in into.iter().enumerate() {
        for &(beyond, from) in arcs {
            if lists[from].iter().all(|arc| arc.0 != to) {
                lists[from].push((to, beyond + row[from]));
            }
        }
    }
    Ok(lists)
}

/// The least floor of each column in some of the rows.
fn rough_duals(costs: &impl Costs, work: &Work<'_>) -> Result<Vec<i64>, Interrupt> {
    let size = costs.size();
    let mut column = vec![FORBIDDEN; size];
    for from in (0..size).step_by(size.div_ceil(SAMPLED_ROWS).max(1)) {
        work.breathe()?;
        for (to, least) in column.iter_mut().enumerate().filter(|&(to, _)| to != from) {
            *least = (*least).min(costs.floor(from, to));
        }
    }
    column.iter_mut().filter(|dual| **dual == FORBIDDEN).for_each(|dual| *dual = 0);
    Ok(column)
}

/// Every arc the other way.
struct Reversed<'a, C>(&'a C);

impl<C: Costs> Costs for Reversed<'_, C> {
    fn size(&self) -> usize {
        self.0.size()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        self.0.cost(to, from)
    }

    fn floor(&self, from: usize, to: usize) -> i64 {
        self.0.floor(to, from)
    }
}

fn true_cost(costs: &impl Costs, order: &[usize]) -> Option<i64> {
    let arcs = order.iter().zip(order.iter().cycle().skip(1));
    let allowed = arcs.clone().all(|(&from, &to)| costs.cost(from, to) != FORBIDDEN);
    (allowed && order.len() > 1).then(|| cycle_cost(costs, order))
}

struct LazyGuide<'a, C> {
    costs: &'a C,
    row: &'a [i64],
    column: &'a [i64],
}

/// A forbidden arc costs as much as a hundred thousand of the dearest: no sum of them overflows.
const PENALTY: i64 = i64::MAX / 1_000_000;

impl<C: Costs> Costs for LazyGuide<'_, C> {
    fn size(&self) -> usize {
        self.costs.size()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        match self.costs.cost(from, to) {
            FORBIDDEN => PENALTY,
            cost => cost - self.row[from] - self.column[to],
        }
    }
}
