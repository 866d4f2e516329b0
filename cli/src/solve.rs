//! `traverse solve`: orders a TSPLIB matrix and prints one JSON line.

use crate::arguments::Solve;
use crate::failure::Failure;
use crate::input;
use std::time::Instant;
use traverse_solve::{CancelToken, Effort, Interrupt, Seed, Silent};
use traverse_tours::{Ending, SolveOptions, TourAnswer, read_tsplib, solve};

pub(crate) fn run(arguments: &Solve) -> Result<(), Failure> {
    let file = arguments.file.display();
    let text = String::from_utf8_lossy(&input::read(&arguments.file)?).into_owned();
    let specification = read_tsplib(&text).map_err(|error| Failure::Input(format!("{file}: {error}")))?;
    let options = SolveOptions {
        seed: Seed(arguments.seed),
        threads: arguments.threads,
        method: arguments.method.into(),
    };
    let effort =
        Effort { time_limit: Some(arguments.time_limit), iteration_limit: arguments.iteration_limit };
    let begin = Instant::now();
    let answer = solve(&specification, &options, &effort.budget_from_now(CancelToken::new()), &mut Silent)
        .map_err(|findings| {
            let all: Vec<String> = findings.iter().map(ToString::to_string).collect();
            Failure::Input(format!("{file}: {}", all.join("; ")))
        })?;
    say!("{}", line(&answer, begin.elapsed().as_secs_f64(), arguments.tour));
    match (&answer.tour, answer.ending) {
        (Some(_), _) => Ok(()),
        (None, Ending::ProvenInfeasible) => {
            Err(Failure::NoPath(String::from("forbidden arcs and precedence leave no tour: proven")))
        }
        (None, _) => Err(Failure::NotNow(String::from("no tour was found in time; raise --time-limit"))),
    }
}

fn line(answer: &TourAnswer, seconds: f64, with_tour: bool) -> String {
    let cost = answer.tour.as_ref().map_or(String::from("null"), |tour| tour.cost.to_string());
    let ending = match answer.ending {
        Ending::ProvenOptimal => "proven_optimal",
        Ending::ProvenInfeasible => "proven_infeasible",
        Ending::Exhausted => "exhausted",
        Ending::Interrupted(Interrupt::Deadline) => "time_limit",
        Ending::Interrupted(Interrupt::Iterations) => "iteration_limit",
        Ending::Interrupted(Interrupt::Memory) => "memory",
        Ending::Interrupted(Interrupt::Cancelled) => "cancelled",
    };
    let mut line = format!(
        "{{\"cost\":{cost},\"lower_bound\":{},\"certified_bound\":{},\"proven\":{},\"ending\":\"{ending}\",\
         \"seconds\":{seconds:.3},\"iterations\":{}",
        answer.lower_bound,
        answer.certified_bound,
        answer.is_proven(),
        answer.iterations
    );
    if let (true, Some(tour)) = (with_tour, &answer.tour) {
        let visits: Vec<String> = tour.visits.iter().map(ToString::to_string).collect();
        line += &format!(",\"tour\":[{}]", visits.join(","));
    }
    line + "}"
}
