//! A validated scene in, one path out.

use crate::peer::{mesh, to_vec2};
use crate::planned::plan;
use crate::scattered::{moves, scattered};
use crate::timing::{share, sorted, timed};
use traverse_geometry::Scene;

/// Prints a row for each size.
pub(crate) fn table(sizes: &[usize], full: bool) {
    println!("one shot: a validated scene in, one path out; µs, median (90th percentile)");
    println!(
        "{:>6} {:>20} {:>20} {:>8} {:>9}",
        "N", "traverse", "polyanya build+query", "ratio", "clearance"
    );
    for &n in sizes {
        row(
            n,
            if n < 1000 {
                400
            } else if n < 10_000 {
                100
            } else if full {
                40
            } else {
                20
            },
        );
    }
}

fn row(n: usize, queries: usize) {
    let scene = scattered(n, 0.0);
    let cleared = Scene { clearance_mm: 1.5, ..scene.clone() };
    let moves = moves(&scene, queries);
    let (mut ours, mut theirs, mut round) = (Vec::new(), Vec::new(), Vec::new());
    for (at, query) in moves.iter().enumerate() {
        let least = |scene| (0..3).map(|_| timed(|| plan(scene, query)).0).fold(f64::INFINITY, f64::min);
        ours.push(least(&scene));
        round.push(least(&cleared));
        // Building a mesh takes far longer than a query: some of them do for the median.
        if at % (1 + n / 500) == 0 {
            theirs.push(timed(|| mesh(&scene, false).path(to_vec2(query.start), to_vec2(query.target))).0);
        }
    }
    let [ours, theirs, round] = [ours, theirs, round].map(sorted);
    println!(
        "{n:>6} {:>11.1} ({:>6.0}) {:>11.1} ({:>6.0}) {:>8} {:>8.2}x",
        share(&ours, 0.5),
        share(&ours, 0.9),
        share(&theirs, 0.5),
        share(&theirs, 0.9),
        format!("1/{:.0}", share(&theirs, 0.5) / share(&ours, 0.5)),
        share(&round, 0.5) / share(&ours, 0.5)
    );
}
