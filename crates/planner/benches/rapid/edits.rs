//! Obstacles that come and go in a prepared scene.

use crate::scattered::{moves, scattered};
use crate::timing::{share, sorted, timed};
use rand::RngExt;
use traverse_planner::PreparedScene;
use traverse_solve::{Budget, Seed, Silent};

/// Prints what edits cost, and by how much the same query is slower after one.
pub(crate) fn table(n: usize, count: usize) {
    println!("\nedits at N = {n}: µs, median (90th percentile)");
    let scene = scattered(n, 0.0);
    let moves = moves(&scene, 50);
    let mut kept = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
    let ask =
        |kept: &mut PreparedScene, query| timed(|| kept.plan(query, &Budget::unlimited(), &mut Silent)).0;
    for query in &moves {
        ask(&mut kept, query);
    }
    let mut random = Seed(5).stream();
    let (mut removed, mut put, mut slower) = (Vec::new(), Vec::new(), Vec::new());
    for round in 0..count {
        let obstacle = &scene.obstacles[random.random_range(0..n)];
        let query = &moves[round % moves.len()];
        // The first of these takes in the edits of former rounds.
        ask(&mut kept, query);
        let before = ask(&mut kept, query);
        removed.push(timed(|| kept.remove_obstacle(&obstacle.id)).0);
        slower.push(ask(&mut kept, query) - before);
        let again = obstacle.clone();
        put.push(timed(|| kept.put_obstacle(again, &Budget::unlimited())).0);
        slower.push(ask(&mut kept, query) - before);
    }
    for (name, times) in [("remove", removed), ("put", put), ("next query slower by", slower)] {
        let times = sorted(times);
        println!("{name:>22} {:>9.1} ({:>7.1})", share(&times, 0.5), share(&times, 0.9));
    }
}
