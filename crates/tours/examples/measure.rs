//! Solves TSPLIB files and prints a row for each: name, cost, bound, certified bound, proven, seconds, seconds to the
//! last better cost, iterations. `cargo run --release -p traverse-tours --example measure -- [--time SECONDS]
//! [--threads COUNT] [--seed NUMBER] FILE…`

use std::time::{Duration, Instant};
use traverse_solve::{CancelToken, Effort, Observer, Seed};
use traverse_tours::{SolveOptions, read_tsplib, solve, verify_certificate};

struct Watch {
    begin: Instant,
    last_cost: Duration,
    trace: bool,
}

impl Observer for Watch {
    fn better_cost(&mut self, cost: f64) {
        self.last_cost = self.begin.elapsed();
        if self.trace {
            eprintln!("  {:.3} cost {cost}", self.begin.elapsed().as_secs_f64());
        }
    }

    fn better_bound(&mut self, bound: f64) {
        if self.trace {
            eprintln!("  {:.3} bound {bound}", self.begin.elapsed().as_secs_f64());
        }
    }
}

fn main() {
    let mut effort = Effort { time_limit: Some(Duration::from_secs(60)), ..Effort::default() };
    let mut options = SolveOptions::default();
    let mut trace = false;
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut number = || arguments.next().and_then(|value| value.parse::<f64>().ok()).unwrap_or(1.0);
        match argument.as_str() {
            "--time" => effort.time_limit = Some(Duration::from_secs_f64(number())),
            "--threads" => options.threads = number() as usize,
            "--seed" => options.seed = Seed(number() as u64),
            "--trace" => trace = true,
            file => row(file, &effort, &options, trace),
        }
    }
}

fn row(file: &str, effort: &Effort, options: &SolveOptions, trace: bool) {
    let name = file.rsplit('/').next().unwrap_or(file);
    let specification = match std::fs::read_to_string(file)
        .map_err(|error| error.to_string())
        .and_then(|text| read_tsplib(&text).map_err(|error| error.to_string()))
    {
        Ok(specification) => specification,
        Err(error) => return println!("{name}: {error}"),
    };
    let begin = Instant::now();
    let mut watch = Watch { begin, last_cost: Duration::ZERO, trace };
    match solve(&specification, options, &effort.budget_from_now(CancelToken::new()), &mut watch) {
        Ok(answer) => println!(
            "{name:22} cost {:>8} bound {:>8} certified {:>8} ({}) {:?} {:.3} s, cost after {:.3} s, {} iterations",
            answer.tour.as_ref().map_or(String::from("none"), |tour| tour.cost.to_string()),
            answer.lower_bound,
            answer.certified_bound,
            verify_certificate(&specification, &answer.certificate) == Ok(answer.certified_bound),
            answer.ending,
            begin.elapsed().as_secs_f64(),
            watch.last_cost.as_secs_f64(),
            answer.iterations
        ),
        Err(findings) => println!("{name}: {findings:?}"),
    }
}
