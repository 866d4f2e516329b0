//! Work ends when it must: cancels, deadlines, iteration limits; and the same limit gives the same answer.

use rand::RngExt;
use std::time::Duration;
use traverse_solve::{Budget, CancelToken, Effort, Interrupt, Observer, Seed, Silent};
use traverse_tours::{CostMatrix, Ending, SolveOptions, TourSpecification, solve};

fn random(size: usize, seed: u64) -> TourSpecification {
    let mut chance = Seed(seed).stream();
    let entries = (0..size * size).map(|_| chance.random_range(1..=1000)).collect();
    TourSpecification::cycle(CostMatrix::new(size, entries).expect("small costs"))
}

/// A matrix of points on a plane with a wind: hard enough to keep any step busy.
fn windy(size: usize, seed: u64) -> TourSpecification {
    let mut chance = Seed(seed).stream();
    let points: Vec<(f64, f64)> =
        (0..size).map(|_| (chance.random_range(0.0..1e4), chance.random_range(0.0..1e4))).collect();
    let cost = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1) + (b.0 - a.0).max(0.0) * 0.3;
    let entries = (0..size * size).map(|at| cost(points[at / size], points[at % size]) as i64).collect();
    TourSpecification::cycle(CostMatrix::new(size, entries).expect("small costs"))
}

/// Raises a cancel when it has heard of so many better tours and bounds.
struct CancelAfter {
    left: u32,
    cancel: CancelToken,
}

impl CancelAfter {
    fn hear(&mut self) {
        if self.left == 0 {
            self.cancel.cancel();
        }
        self.left = self.left.saturating_sub(1);
    }
}

impl Observer for CancelAfter {
    fn better_cost(&mut self, _cost: f64) {
        self.hear();
    }

    fn better_bound(&mut self, _lower_bound: f64) {
        self.hear();
    }
}

#[test]
fn cancelled_work_ends_with_a_tour() {
    let ordered = {
        let mut path = TourSpecification::path(windy(60, 2).costs);
        path.precedence = (0..50).map(|node| (node, node + 7)).collect();
        path
    };
    for (name, specification) in [
        ("tree", windy(150, 1)),
        ("root", windy(450, 2)),
        ("assignment", random(1500, 3)),
        ("ordered", ordered),
        ("table", windy(20, 4)),
    ] {
        for threads in [1, 2] {
            for left in [0, 1, 4] {
                let cancel = CancelToken::new();
                // Not all of them tell so much.
                let iterations = Some(20_000);
                let budget = Budget { cancel: cancel.clone(), iterations, ..Budget::unlimited() };
                let options = SolveOptions { threads, ..SolveOptions::default() };
                let mut observer = CancelAfter { left, cancel: cancel.clone() };
                let answer = solve(&specification, &options, &budget, &mut observer).expect("no findings");
                let ended = matches!(
                    answer.ending,
                    Ending::ProvenOptimal | Ending::Interrupted(Interrupt::Cancelled)
                );
                assert!(ended, "{name}, {threads} threads, {left}: {:?}", answer.ending);
                assert!(answer.tour.is_some(), "{name}: there is always a tour where no arc is forbidden");
            }
        }
    }
}

#[test]
fn a_deadline_of_nothing_still_gives_a_tour_and_a_bound() {
    let effort = Effort { time_limit: Some(Duration::ZERO), ..Effort::default() };
    let budget = effort.budget_from_now(CancelToken::new());
    let answer = solve(&random(300, 1), &SolveOptions::default(), &budget, &mut Silent).expect("no findings");
    assert_eq!(answer.ending, Ending::Interrupted(Interrupt::Deadline));
    let tour = answer.tour.expect("the order as given");
    assert!(answer.lower_bound > 0 && answer.lower_bound <= tour.cost);
}

#[test]
fn the_same_seed_and_limit_give_the_same_answer() {
    let specification = windy(120, 7);
    for iterations in [1, 500, 3_500, 5_000] {
        let answer = || {
            let budget = Budget { iterations: Some(iterations), ..Budget::unlimited() };
            let options = SolveOptions { seed: Seed(3), ..SolveOptions::default() };
            solve(&specification, &options, &budget, &mut Silent).expect("no findings")
        };
        let first = answer();
        assert_eq!(first, answer(), "{iterations}");
        assert!(first.iterations <= iterations);
    }
}
