//! What the joins of 200 sections cost, envelopes included, at four counts of vertices, without and with a gap, on one
//! thread and on two: the least of several runs.
//!
//! `cargo bench -p traverse-layout-sequencing --bench joins`

mod ragged;

use std::time::Instant;
use traverse_geometry::SectionLayout;
use traverse_layout_sequencing::{EffectModel, joins};
use traverse_solve::Budget;

const SECTIONS: usize = 200;
const RUNS: usize = 7;

fn milliseconds(layout: &SectionLayout, threads: usize) -> f64 {
    let run = || {
        let begin = Instant::now();
        let matrix = joins(layout, EffectModel::Exact, threads, &Budget::unlimited());
        std::hint::black_box(matrix.is_ok());
        begin.elapsed().as_secs_f64() * 1e3
    };
    (0..RUNS).map(|_| run()).fold(f64::INFINITY, f64::min)
}

fn main() {
    println!("| vertices | one thread | two threads | per pair and vertex | with a gap, two threads |");
    println!("|---|---|---|---|---|");
    for vertices in [82, 164, 330, 660] {
        let layout = ragged::layout(SECTIONS, vertices, 1);
        let one = milliseconds(&layout, 1);
        let two = milliseconds(&layout, 2);
        let apart = milliseconds(&SectionLayout { gap_mm: 5.0, ..layout }, 2);
        let each = one * 1e6 / ((SECTIONS * SECTIONS * vertices) as f64);
        println!("| {vertices} | {one:.1} ms | {two:.1} ms | {each:.2} ns | {apart:.1} ms |");
    }
}
