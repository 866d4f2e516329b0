//! Work ends when it must: cancels, deadlines, iteration limits; and the same limit gives the same answer.

use rand::RngExt;
use std::time::{Duration, Instant};
use traverse_solve::{Budget, CancelToken, Effort, Interrupt, Seed, Silent};
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

#[test]
fn cancelled_work_frees_the_core_at_once() {
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
            for after in [1, 30, 300, 900] {
                let cancel = CancelToken::new();
                let budget = Budget { cancel: cancel.clone(), ..Budget::unlimited() };
                let options = SolveOptions { threads, ..SolveOptions::default() };
                let (answer, cancelled, done) = std::thread::scope(|scope| {
                    let work = scope.spawn(|| {
                        let answer = solve(&specification, &options, &budget, &mut Silent);
                        (answer, Instant::now())
                    });
                    std::thread::sleep(Duration::from_millis(after));
                    let cancelled = Instant::now();
                    cancel.cancel();
                    let (answer, done) = work.join().expect("no panic");
                    (answer.expect("no findings"), cancelled, done)
                });
                let late = done.saturating_duration_since(cancelled);
                // Promised are 50 ms on a core of its own; tests share theirs.
                assert!(late < Duration::from_millis(200), "{name}, {threads} threads, {after} ms: {late:?}");
                println!("{name}, {threads} threads, after {after} ms: {late:?} {:?}", answer.ending);
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
