//! Many moves in one prepared scene.

use crate::peer::{mesh, to_vec2};
use crate::scattered::{moves, scattered};
use crate::timing::{share, sorted, timed};
use polyanya::Mesh;
use traverse_geometry::Scene;
use traverse_planner::{PreparedScene, RapidMove};
use traverse_solve::{Budget, Silent};

/// Rounds over all moves: the first works out what is seen from where and does not count.
const ROUNDS: usize = 4;

/// Prints a row for each size.
pub(crate) fn table(sizes: &[usize], full: bool, alone: bool) {
    println!("\nprepared: µs per query, least of 3 repeats, median (99th percentile)");
    head();
    for &n in sizes {
        let queries = if n < 1000 {
            400
        } else if n < 10_000 || full {
            200
        } else {
            50
        };
        let scene = scattered(n, 0.0);
        let moves = moves(&scene, queries);
        row(&n.to_string(), &[(scene, moves)], alone);
    }
}

/// Prints the head of the table.
pub(crate) fn head() {
    println!(
        "{:>8} {:>18} {:>18} {:>18} {:>9} {:>6} {:>9} {:>10}",
        "N", "traverse", "polyanya", "merged", "ratio", "tail", "clearance", "links"
    );
}

/// One scene prepared by everyone.
struct Contest {
    kept: PreparedScene,
    round: PreparedScene,
    /// Plain and merged.
    peers: Option<[Mesh; 2]>,
}

impl Contest {
    fn of(scene: &Scene, alone: bool) -> Self {
        let prepared = |scene: Scene| PreparedScene::new(scene, &Budget::unlimited()).unwrap();
        Self {
            kept: prepared(scene.clone()),
            round: prepared(Scene { clearance_mm: 1.5, ..scene.clone() }),
            peers: (!alone).then(|| [false, true].map(|merged| mesh(scene, merged))),
        }
    }

    /// Microseconds of Traverse, of both meshes and of Traverse with a clearance.
    fn times(&mut self, query: &RapidMove) -> [f64; 4] {
        let (from, to) = (to_vec2(query.start), to_vec2(query.target));
        let peer = |which: usize| {
            let mesh = self.peers.as_ref().map(|peers| &peers[which]);
            mesh.map_or(f64::NAN, |mesh| timed(|| mesh.path(from, to).map(|path| path.length)).0)
        };
        [
            timed(|| self.kept.plan(query, &Budget::unlimited(), &mut Silent).is_ok()).0,
            peer(0),
            peer(1),
            timed(|| self.round.plan(query, &Budget::unlimited(), &mut Silent).is_ok()).0,
        ]
    }
}

/// Prints the row of some scenes and the moves in each. *Tail*: 99th percentile over median; *ratio*: to the merged mesh.
pub(crate) fn row(name: &str, scenes: &[(Scene, Vec<RapidMove>)], alone: bool) {
    let mut least: Vec<[f64; 4]> = Vec::new();
    let mut links = 0;
    for (scene, moves) in scenes {
        let mut contest = Contest::of(scene, alone);
        let first = least.len();
        least.resize(first + moves.len(), [f64::INFINITY; 4]);
        for round in 0..ROUNDS {
            for (query, least) in moves.iter().zip(&mut least[first..]) {
                let times = contest.times(query);
                if round > 0 {
                    least
                        .iter_mut()
                        .zip(times)
                        .for_each(|(least, time)| *least = if time < *least { time } else { *least });
                }
            }
        }
        links += contest.kept.link_count();
    }
    let of = |which: usize| sorted(least.iter().map(|times| times[which]).collect());
    let [ours, plain, merged, round] = [of(0), of(1), of(2), of(3)];
    let cell = |times: &[f64]| format!("{:>8.1} ({:>7.0})", share(times, 0.5), share(times, 0.99));
    println!(
        "{name:>8} {} {} {} {:>9} {:>5.1}x {:>8.2}x {:>10}",
        cell(&ours),
        cell(&plain),
        cell(&merged),
        format!("1/{:.2}", share(&merged, 0.5) / share(&ours, 0.5)),
        share(&ours, 0.99) / share(&ours, 0.5),
        share(&round, 0.5) / share(&ours, 0.5),
        links
    );
}
