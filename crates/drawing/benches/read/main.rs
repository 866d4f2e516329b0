//! How long drawings of 100 000 entities take to be read, and what `traverse inspect` then does with them, on one
//! thread. `cargo bench --workspace --bench read`.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a bench stops where it can't go on")]

mod drawings;
#[path = "../../tests/random/mod.rs"]
mod random;

use std::time::Instant;
use traverse_drawing::{JOIN_TOLERANCE_MM, ReadOptions, Roles, inspect_drawing, read_drawing};

/// Times that each drawing is read; the middle one counts.
const ROUNDS: usize = 5;

fn main() {
    println!("{:<44} {:>6} {:>10} {:>9} {:>9}", "drawing", "MB", "vertices", "read", "inspect");
    for (name, file) in drawings::all() {
        let read = || read_drawing(file.as_bytes(), &ReadOptions::default()).unwrap();
        let mut times: Vec<f64> = (0..ROUNDS)
            .map(|_| {
                let begun = Instant::now();
                std::hint::black_box(read());
                begun.elapsed().as_secs_f64()
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let drawing = read();
        let curves = drawing.layers.iter().flat_map(|layer| &layer.curves);
        let vertices: usize = curves.map(|curve| curve.vertices.len()).sum();
        if std::env::args().any(|argument| argument == "--read-only") {
            println!("{name:<44} {:>6} {vertices:>10} {:>7.3} s", file.len() / 1_000_000, times[ROUNDS / 2]);
            continue;
        }
        let begun = Instant::now();
        std::hint::black_box(inspect_drawing(&drawing, &Roles::default(), JOIN_TOLERANCE_MM));
        let inspected = begun.elapsed().as_secs_f64();
        let megabytes = file.len() / 1_000_000;
        println!("{name:<44} {megabytes:>6} {vertices:>10} {:>7.2} s {inspected:>7.2} s", times[ROUNDS / 2]);
    }
}
