//! Thousands of sections of 40 vertices: how near the bound the true length comes in a time, and in what memory.
//!
//! `cargo bench -p traverse-layout-sequencing --bench thousands -- [--time SECONDS] [--trace] [COUNT…]`

mod ragged;

use std::time::{Duration, Instant};
use traverse_layout_sequencing::{OrderOptions, order_sections};
use traverse_solve::{CancelToken, Effort, Observer};

/// Says when what was found, where asked to.
struct Watch {
    begin: Instant,
    trace: bool,
}

impl Observer for Watch {
    fn better_cost(&mut self, cost: f64) {
        if self.trace {
            println!("  {:8.3} s length {cost}", self.begin.elapsed().as_secs_f64());
        }
    }

    fn better_bound(&mut self, bound: f64) {
        if self.trace {
            println!("  {:8.3} s bound {bound}", self.begin.elapsed().as_secs_f64());
        }
    }
}

/// The most memory this process has held, megabytes; 0 where the system does not say.
fn peak_mb() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) / 1024
}

fn main() {
    let (mut seconds, mut trace, mut counts) = (30.0, false, vec![]);
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--time" => seconds = arguments.next().and_then(|value| value.parse().ok()).unwrap_or(seconds),
            "--trace" => trace = true,
            _ => counts.extend(argument.parse::<usize>()),
        }
    }
    if counts.is_empty() {
        counts = vec![2_000, 10_000];
    }
    println!("| sections | length | bound | gap | tried | seconds | peak memory |");
    println!("|---|---|---|---|---|---|---|");
    for count in counts {
        let layout = ragged::layout(count, 40, 1);
        let begin = Instant::now();
        let effort = Effort { time_limit: Some(Duration::from_secs_f64(seconds)), ..Effort::default() };
        let options = OrderOptions { threads: 2, ..OrderOptions::default() };
        let mut watch = Watch { begin, trace };
        let budget = effort.budget_from_now(CancelToken::new());
        let Ok(answer) = order_sections(&layout, &options, &budget, &mut watch) else { continue };
        let length = answer.plan.as_ref().map_or(f64::NAN, |plan| plan.length_mm);
        println!(
            "| {count} | {length:.3} mm | {:.3} mm | {:.3} % | {} | {:.1} | {} MB |",
            answer.lower_bound_mm,
            100.0 * (length - answer.lower_bound_mm) / length,
            answer.iterations,
            begin.elapsed().as_secs_f64(),
            peak_mb()
        );
    }
}
