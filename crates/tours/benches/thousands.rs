//! Thousands of sections whose joins are computed when asked for: cost, bound and gap after a time limit.
//!
//! A section is a strip with ragged edges, sampled at 16 heights; the cost of a join is the least offset at which the
//! two don't overlap. `cargo bench -p traverse-tours --bench thousands -- [--time SECONDS] [--trace] [COUNT…]`

use rand::RngExt;
use std::time::{Duration, Instant};
use traverse_solve::{CancelToken, Effort, Observer, Seed};
use traverse_tours::{Costs, FORBIDDEN, search_lazily};

const HEIGHTS: usize = 16;

struct Sections {
    right: Vec<[i32; HEIGHTS]>,
    left: Vec<[i32; HEIGHTS]>,
}

impl Costs for Sections {
    fn size(&self) -> usize {
        self.right.len()
    }

    fn cost(&self, from: usize, to: usize) -> i64 {
        if from == to {
            return FORBIDDEN;
        }
        let gaps = self.right[from].iter().zip(&self.left[to]).map(|(right, left)| right - left);
        i64::from(gaps.max().unwrap_or(0))
    }
}

/// Says everything where asked to.
struct Watch {
    begin: Instant,
    trace: bool,
}

impl Observer for Watch {
    fn better_cost(&mut self, cost: f64) {
        if self.trace {
            println!("  {:8.3} s cost {cost}", self.begin.elapsed().as_secs_f64());
        }
    }

    fn better_bound(&mut self, bound: f64) {
        if self.trace {
            println!("  {:8.3} s bound {bound}", self.begin.elapsed().as_secs_f64());
        }
    }
}

fn main() {
    let mut trace = false;
    let mut seconds = 30.0;
    let mut counts = vec![];
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        if argument == "--time" {
            seconds = arguments.next().and_then(|value| value.parse().ok()).unwrap_or(seconds);
        } else if argument == "--trace" {
            trace = true;
        } else {
            counts.extend(argument.parse::<usize>());
        }
    }
    if counts.is_empty() {
        counts = vec![2_000, 10_000];
    }
    println!("| sections | cost | bound | gap | kicks | seconds |");
    println!("|---|---|---|---|---|---|");
    for count in counts {
        let mut chance = Seed(count as u64).stream();
        let mut edges = |base: i32| -> Vec<[i32; HEIGHTS]> {
            (0..count).map(|_| [(); HEIGHTS].map(|()| base + chance.random_range(0..10_000))).collect()
        };
        let sections = Sections { right: edges(50_000), left: edges(0) };
        let begin = Instant::now();
        let effort = Effort { time_limit: Some(Duration::from_secs_f64(seconds)), ..Effort::default() };
        let budget = effort.budget_from_now(CancelToken::new());
        let mut watch = Watch { begin, trace };
        let answer = search_lazily(&sections, Seed(1), 1, &budget, &mut watch);
        let (cost, bound) = (answer.cost.unwrap_or(i64::MAX), answer.lower_bound.unwrap_or(0));
        println!(
            "| {count} | {cost} | {bound} | {:.3} % | {} | {:.1} |",
            100.0 * (cost - bound) as f64 / cost as f64,
            answer.iterations,
            begin.elapsed().as_secs_f64()
        );
    }
}
