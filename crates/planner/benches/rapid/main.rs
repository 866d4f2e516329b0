//! Rapid moves against a peer, in the same run: Traverse's one-shot and prepared plans beside navigation meshes by the
//! crate `polyanya` (plain and merged). Prints microseconds and ratios.
//!
//! `cargo bench -p traverse-planner --bench rapid -- [--full] [--alone] [PART…] [N…] [FILE.json…]`. Parts: `one-shot`, `prepared`,
//! `edits`, `distances`, `obstacle`, `memory`; none: all of them. Numbers: only scenes of so many obstacles. `--alone`: prepared moves without the peer, which does not end on every map. A file holds a scene with its optimal lengths (see `scene_file`): every move
//! of it is compared with its optimum, where it stands and 20 m further out, and its prepared moves are measured.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a bench stops where it can't go on"
)]

mod distances;
mod edits;
mod memory;
mod one_obstacle;
mod one_shot;
#[path = "../common/peer.rs"]
mod peer;
#[path = "../common/planned.rs"]
mod planned;
mod prepared;
#[path = "../common/scattered.rs"]
mod scattered;
mod scene_file;
#[path = "../common/timing.rs"]
mod timing;

use std::path::Path;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let full = arguments.iter().any(|argument| argument == "--full");
    let alone = arguments.iter().any(|argument| argument == "--alone");
    let (files, words): (Vec<&String>, Vec<&String>) = arguments
        .iter()
        .filter(|argument| !argument.starts_with("--"))
        .partition(|argument| argument.ends_with(".json"));
    let (numbers, parts): (Vec<&String>, Vec<&String>) =
        words.into_iter().partition(|word| word.parse::<usize>().is_ok());
    let sizes: Vec<usize> = numbers.iter().filter_map(|number| number.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![10, 100, 1000, 10_000] } else { sizes };
    let wants =
        |part: &str| parts.iter().any(|wanted| *wanted == part) || parts.is_empty() && files.is_empty();
    if wants("one-shot") {
        one_shot::table(&sizes, full);
    }
    if wants("prepared") {
        prepared::table(&sizes, full, alone);
    }
    if wants("edits") {
        edits::table(10_000, if full { 400 } else { 100 });
    }
    if wants("distances") {
        distances::table();
    }
    if wants("obstacle") {
        one_obstacle::table();
    }
    if wants("memory") {
        memory::table(10_000, if full { 2000 } else { 200 });
    }
    for file in files {
        scene_file::table(Path::new(file), alone);
    }
}
