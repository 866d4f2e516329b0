//! Prints a row for each instance: cost, bound, certified bound, how it ended, seconds, seconds to the last better
//! cost, iterations. Without files: those of `tests/data`.
//!
//! `cargo bench -p traverse-tours --bench instances -- [--time SECONDS] [--threads COUNT] [--seed NUMBER] [--trace]
//! [FILE…]`

use std::path::Path;
use std::time::{Duration, Instant};
use traverse_solve::{CancelToken, Effort, Observer, Seed};
use traverse_tours::{SolveOptions, read_tsplib, solve, verify_certificate};

/// Remembers when the last better cost came, and says everything where asked to.
struct Watch {
    begin: Instant,
    last_cost: Duration,
    trace: bool,
}

impl Watch {
    fn say(&self, what: &str, value: f64) {
        if self.trace {
            println!("  {:8.3} s {what} {value}", self.begin.elapsed().as_secs_f64());
        }
    }
}

impl Observer for Watch {
    fn better_cost(&mut self, cost: f64) {
        self.last_cost = self.begin.elapsed();
        self.say("cost", cost);
    }

    fn better_bound(&mut self, bound: f64) {
        self.say("bound", bound);
    }
}

fn main() {
    let mut effort = Effort { time_limit: Some(Duration::from_secs(8)), ..Effort::default() };
    let mut options = SolveOptions::default();
    let mut trace = false;
    let mut files = vec![];
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut number = || arguments.next().and_then(|value| value.parse::<f64>().ok()).unwrap_or(1.0);
        match argument.as_str() {
            "--time" => effort.time_limit = Some(Duration::from_secs_f64(number())),
            "--threads" => options.threads = number() as usize,
            "--seed" => options.seed = Seed(number() as u64),
            "--trace" => trace = true,
            "--bench" => {}
            file => files.push(file.to_owned()),
        }
    }
    if files.is_empty() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
        let found = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let matrices =
            found.filter(|path| path.extension().is_some_and(|kind| kind == "atsp" || kind == "sop"));
        files = matrices.map(|path| path.display().to_string()).collect();
        files.sort();
    }
    println!("| instance | cost | bound | certified | ended | seconds | cost after | iterations |");
    println!("|---|---|---|---|---|---|---|---|");
    for file in files {
        row(&file, &effort, &options, trace);
    }
}

fn row(file: &str, effort: &Effort, options: &SolveOptions, trace: bool) {
    let name = file.rsplit('/').next().unwrap_or(file);
    let text = std::fs::read_to_string(file).map_err(|error| error.to_string());
    let specification = match text.and_then(|text| read_tsplib(&text).map_err(|error| error.to_string())) {
        Ok(specification) => specification,
        Err(error) => return println!("| {name} | {error} |"),
    };
    let begin = Instant::now();
    let mut watch = Watch { begin, last_cost: Duration::ZERO, trace };
    match solve(&specification, options, &effort.budget_from_now(CancelToken::new()), &mut watch) {
        Ok(answer) => {
            let seconds = begin.elapsed().as_secs_f64();
            let sound = verify_certificate(&specification, &answer.certificate) == Ok(answer.certified_bound);
            println!(
                "| {name} | {} | {} | {}{} | {:?} | {seconds:.3} | {:.3} | {} |",
                answer.tour.as_ref().map_or(String::from("none"), |tour| tour.cost.to_string()),
                answer.lower_bound,
                answer.certified_bound,
                if sound { "" } else { " REFUSED" },
                answer.ending,
                watch.last_cost.as_secs_f64(),
                answer.iterations
            );
        }
        Err(findings) => println!("| {name} | {findings:?} |"),
    }
}
