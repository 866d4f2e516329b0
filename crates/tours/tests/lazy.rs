//! Thousands of nodes, costs computed when asked for.

use rand::RngExt;
use traverse_solve::{Budget, Seed, Silent};
use traverse_tours::{Assignment, Costs, Work, search_lazily};

/// Points on a plane with a wind; nothing is stored for pairs.
struct Windy(Vec<(f64, f64)>);

impl Windy {
    fn new(size: usize, seed: u64) -> Self {
        let mut chance = Seed(seed).stream();
        Self((0..size).map(|_| (chance.random_range(0.0..1e5), chance.random_range(0.0..1e5))).collect())
    }
}

impl Costs for Windy {
    fn size(&self) -> usize {
        self.0.len()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        if from == to {
            return traverse_tours::FORBIDDEN;
        }
        let (a, b) = (self.0[from], self.0[to]);
        ((a.0 - b.0).hypot(a.1 - b.1) + (b.0 - a.0).max(0.0)) as i64
    }
}

#[test]
fn the_bound_is_the_assignment_without_its_matrix() {
    let budget = Budget { iterations: Some(2_000), ..Budget::unlimited() };
    for seed in 0..5 {
        let costs = Windy::new(60, seed);
        let answer = search_lazily(&costs, Seed(1), 1, &budget, &mut Silent);
        let (assignment, _) = Assignment::solve(&costs, &Work::new(&budget)).expect("no limit");
        assert_eq!(answer.lower_bound, Some(assignment.bound()));
        assert!(answer.cost >= answer.lower_bound);
        assert_eq!(answer.row.iter().chain(&answer.column).sum::<i64>(), assignment.bound());
        for from in 0..60 {
            for to in 0..60 {
                assert!(answer.row[from].saturating_add(answer.column[to]) <= costs.cost(from, to));
            }
        }
        assert_eq!(search_lazily(&costs, Seed(1), 2, &budget, &mut Silent), answer);
    }
}

#[test]
fn two_thousand_nodes_get_a_tour_and_a_bound() {
    let costs = Windy::new(2_000, 1);
    let budget = Budget { iterations: Some(5_000), ..Budget::unlimited() };
    let answer = search_lazily(&costs, Seed(1), 1, &budget, &mut Silent);
    let mut seen = answer.order.clone();
    seen.sort_unstable();
    assert!(seen.into_iter().eq(0..2_000));
    let (cost, bound) = (answer.cost.expect("nothing is forbidden"), answer.lower_bound.expect("no limit"));
    // Assignment bounds of plane instances are weak: a fifth is usual.
    assert!(cost < bound * 3 / 2, "{cost} {bound}");
}
