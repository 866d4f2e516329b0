//! Memory of a prepared scene after many moves, as the operating system counts it (Linux).

use crate::scattered::{moves, scattered};
use traverse_planner::PreparedScene;
use traverse_solve::{Budget, Silent};

/// Prints megabytes that a prepared scene of `n` obstacles takes.
pub(crate) fn table(n: usize, queries: usize) {
    println!("\nmemory of a prepared scene, N = {n}: MB beside the scene that came in, and links kept");
    let scene = scattered(n, 0.0);
    let moves = moves(&scene, queries);
    let vertices = scene.vertex_count();
    let ours = scene.clone();
    let Some(before) = resident_mb() else {
        println!("not known here");
        return;
    };
    let mut kept = PreparedScene::new(ours, &Budget::unlimited()).unwrap();
    println!("{:>22} {:>9.1}", format!("{vertices} vertices, new"), resident_mb().unwrap_or(before) - before);
    for (at, query) in moves.iter().enumerate() {
        kept.plan(query, &Budget::unlimited(), &mut Silent).unwrap();
        if [queries / 20, queries / 2, queries].contains(&(at + 1)) {
            let took = resident_mb().unwrap_or(before) - before;
            println!("{:>22} {took:>9.1} {:>9}", format!("after {} queries", at + 1), kept.link_count());
        }
    }
}

fn resident_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes / 1024.0)
}
