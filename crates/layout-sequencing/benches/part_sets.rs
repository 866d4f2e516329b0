//! How near the bound the true length comes, for sections built from part sets of the literature: the mean and the
//! worst over the sets, and how many are proven.
//!
//! `cargo bench -p traverse-layout-sequencing --bench part_sets -- [--time SECONDS] [--free] [--each] FILE…` with files
//! in the form that `read_part_set` takes. Without files the sets that the crate `traverse-drawing` tests with.

use std::time::{Duration, Instant};
use traverse_drawing::{BlockRules, build_blocks, read_part_set};
use traverse_geometry::{Pose, SectionLayout, SlideRule};
use traverse_layout_sequencing::{LayoutAnswer, OrderOptions, order_sections, place};
use traverse_solve::{CancelToken, Effort, Observer};

/// Says when what was found.
struct Watch {
    begin: Instant,
    trace: bool,
}

impl Observer for Watch {
    fn better_cost(&mut self, cost: f64) {
        if self.trace {
            println!("    {:7.3} s length {cost}", self.begin.elapsed().as_secs_f64());
        }
    }

    fn better_bound(&mut self, bound: f64) {
        if self.trace {
            println!("    {:7.3} s bound {bound}", self.begin.elapsed().as_secs_f64());
        }
    }
}

struct Arguments {
    seconds: f64,
    rule: SlideRule,
    each: bool,
    trace: bool,
    threads: usize,
    only: Option<usize>,
    files: Vec<String>,
}

fn arguments() -> Arguments {
    let mut read = Arguments {
        seconds: 10.0,
        rule: SlideRule::KeepOrder,
        each: false,
        trace: false,
        threads: 1,
        only: None,
        files: vec![],
    };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        let mut number = || arguments.next().and_then(|value| value.parse::<f64>().ok());
        match argument.as_str() {
            "--time" => read.seconds = number().unwrap_or(read.seconds),
            "--threads" => read.threads = number().map_or(1, |threads| threads as usize),
            "--row" => read.only = number().map(|row| row as usize),
            "--free" => read.rule = SlideRule::Free,
            "--each" => read.each = true,
            "--trace" => read.trace = true,
            _ => read.files.push(argument),
        }
    }
    read
}

fn main() {
    let arguments = arguments();
    println!(
        "| sections | poses | length, boxes = 100 | as sent | bound | gap, mean | gap, worst | proven | seconds, mean |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let turns = [Pose::AsIs, Pose::HalfTurn];
    let rows: [(usize, &str, &[Pose]); 6] = [
        (10, "as is", &turns[..1]),
        (10, "half turns", &turns),
        (10, "mirrors", &Pose::ALL),
        (20, "as is", &turns[..1]),
        (20, "half turns", &turns),
        (20, "mirrors", &Pose::ALL),
    ];
    for (number, (count, name, poses)) in rows.into_iter().enumerate() {
        if arguments.only.is_some_and(|only| only != number) {
            continue;
        }
        let (mut length, mut sent, mut bound, mut gaps, mut proven, mut seconds) =
            (0.0, 0.0, 0.0, vec![], 0, 0.0);
        for file in &arguments.files {
            let Ok(bytes) = std::fs::read(file) else { continue };
            let Ok(set) = read_part_set(&bytes) else { continue };
            let rules = BlockRules { count: Some(count), poses: poses.to_vec(), ..BlockRules::default() };
            let Ok(sections) = build_blocks(&set, &rules) else { continue };
            let layout = SectionLayout {
                sections,
                gap_mm: 0.0,
                strip_height_mm: Some(set.strip_height_mm),
                first: None,
                last: None,
                precedences: vec![],
                forbidden_joins: vec![],
                slide_rule: arguments.rule,
            };
            let begin = Instant::now();
            let effort =
                Effort { time_limit: Some(Duration::from_secs_f64(arguments.seconds)), ..Effort::default() };
            let budget = effort.budget_from_now(CancelToken::new());
            let options = OrderOptions { threads: arguments.threads, ..OrderOptions::default() };
            let mut watch = Watch { begin, trace: arguments.trace };
            let answer: LayoutAnswer = match order_sections(&layout, &options, &budget, &mut watch) {
                Ok(answer) => answer,
                Err(findings) => {
                    println!("{file}: {}", findings[0]);
                    continue;
                }
            };
            let Some(plan) = &answer.plan else { continue };
            let taken = begin.elapsed().as_secs_f64();
            let gap = 100.0 * (plan.length_mm - answer.lower_bound_mm) / plan.length_mm;
            let mut given = plan.order.clone();
            given.sort_by_key(|placed| placed.section);
            given.iter_mut().for_each(|placed| placed.pose = Pose::AsIs);
            let boxes = plan.bounding_box_length_mm;
            let as_sent = traverse_layout_sequencing::layout_length_mm(&layout, &place(&layout, &given));
            if arguments.each {
                println!(
                    "  {file} {count} {name}: {:.2} as sent {:.2} gap {gap:.2} % {:?} {taken:.1} s {} iterations",
                    100.0 * plan.length_mm / boxes,
                    100.0 * as_sent / boxes,
                    answer.ending,
                    answer.iterations
                );
            }
            length += 100.0 * plan.length_mm / boxes;
            sent += 100.0 * as_sent / boxes;
            bound += 100.0 * answer.lower_bound_mm / boxes;
            gaps.push(gap);
            proven += usize::from(answer.is_proven());
            seconds += taken;
        }
        let sets = gaps.len() as f64;
        println!(
            "| {count} | {name} | {:.1} | {:.1} | {:.1} | {:.2} % | {:.2} % | {proven} of {} | {:.1} |",
            length / sets,
            sent / sets,
            bound / sets,
            gaps.iter().sum::<f64>() / sets,
            gaps.iter().copied().fold(0.0, f64::max),
            gaps.len(),
            seconds / sets
        );
    }
}
