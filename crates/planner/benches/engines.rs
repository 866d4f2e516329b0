//! Traverse beside navigation meshes by the crate `polyanya` (plain and merged), by divan: one shot, a query of a prepared
//! scene, and an edit, among 10, 100 and 1000 scattered obstacles. `cargo bench -p traverse-planner --bench engines`, with
//! a part of a name for some of them.
//!
//! Divan runs one engine after the other, so what else the machine does meanwhile may favour one of them. `--bench rapid` measures the
//! same scenes in turns, move by move, and prints ratios: those are the ones that docs/benchmarks.md tells.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    missing_docs,
    reason = "a bench stops where it can't go on"
)]

#[path = "common/peer.rs"]
mod peer;
#[path = "common/planned.rs"]
mod planned;
#[path = "common/scattered.rs"]
mod scattered;

use divan::Bencher;
use peer::{mesh, to_vec2};
use polyanya::Mesh;
use traverse_geometry::Scene;
use traverse_planner::{PreparedScene, RapidMove};
use traverse_solve::{Budget, Silent};

/// How many obstacles a scene has.
const SIZES: [usize; 3] = [10, 100, 1000];

/// Different moves in a scene, one after the other.
const MOVES: usize = 64;

/// Most samples that one line of the table takes.
const SAMPLES: u32 = 1000;

/// Most seconds that one line of the table takes.
const SECONDS: u64 = 1;

fn main() {
    divan::main();
}

/// A scene and moves in it without end.
fn scene_and_moves(n: usize) -> (Scene, impl Iterator<Item = RapidMove>) {
    let scene = scattered::scattered(n, 0.0);
    let moves = scattered::moves(&scene, MOVES);
    (scene, moves.into_iter().cycle())
}

fn length(mesh: &Mesh, query: &RapidMove) -> Option<f32> {
    mesh.path(to_vec2(query.start), to_vec2(query.target)).map(|path| path.length)
}

fn ask(kept: &mut PreparedScene, query: &RapidMove) -> bool {
    kept.plan(query, &Budget::unlimited(), &mut Silent).is_ok()
}

/// A prepared scene that every move was asked of once.
fn prepared(scene: Scene, moves: &mut impl Iterator<Item = RapidMove>) -> PreparedScene {
    let mut kept = PreparedScene::new(scene, &Budget::unlimited()).unwrap();
    moves.take(MOVES).for_each(|query| assert!(ask(&mut kept, &query)));
    kept
}

/// A validated scene in, one path out.
#[divan::bench_group(sample_count = SAMPLES, max_time = SECONDS)]
mod one_shot {
    use super::*;

    #[divan::bench(args = SIZES)]
    fn traverse(bencher: Bencher<'_, '_>, n: usize) {
        let (scene, mut moves) = scene_and_moves(n);
        bencher.with_inputs(|| moves.next().unwrap()).bench_local_refs(|query| planned::plan(&scene, query));
    }

    #[divan::bench(args = SIZES)]
    fn polyanya(bencher: Bencher<'_, '_>, n: usize) {
        build_and_query(bencher, n, false);
    }

    #[divan::bench(args = SIZES)]
    fn polyanya_merged(bencher: Bencher<'_, '_>, n: usize) {
        build_and_query(bencher, n, true);
    }

    fn build_and_query(bencher: Bencher<'_, '_>, n: usize, merged: bool) {
        let (scene, mut moves) = scene_and_moves(n);
        bencher
            .with_inputs(|| moves.next().unwrap())
            .bench_local_refs(|query| length(&mesh(&scene, merged), query));
    }
}

/// One of many moves in one scene.
#[divan::bench_group(sample_count = SAMPLES, max_time = SECONDS)]
mod prepared_query {
    use super::*;

    #[divan::bench(args = SIZES)]
    fn traverse(bencher: Bencher<'_, '_>, n: usize) {
        let (scene, mut moves) = scene_and_moves(n);
        let mut kept = prepared(scene, &mut moves);
        bencher.with_inputs(|| moves.next().unwrap()).bench_local_refs(|query| ask(&mut kept, query));
    }

    #[divan::bench(args = SIZES)]
    fn polyanya(bencher: Bencher<'_, '_>, n: usize) {
        query(bencher, n, false);
    }

    #[divan::bench(args = SIZES)]
    fn polyanya_merged(bencher: Bencher<'_, '_>, n: usize) {
        query(bencher, n, true);
    }

    fn query(bencher: Bencher<'_, '_>, n: usize, merged: bool) {
        let (scene, mut moves) = scene_and_moves(n);
        let mesh = mesh(&scene, merged);
        bencher.with_inputs(|| moves.next().unwrap()).bench_local_refs(|query| length(&mesh, query));
    }
}

/// The obstacle in the middle is taken out, a move is planned, it is put back, the move is planned again. A mesh is
/// built anew each time.
#[divan::bench_group(sample_count = SAMPLES, max_time = SECONDS)]
mod edit {
    use super::*;

    #[divan::bench(args = SIZES)]
    fn traverse(bencher: Bencher<'_, '_>, n: usize) {
        let (scene, mut moves) = scene_and_moves(n);
        let obstacle = scene.obstacles[n / 2].clone();
        let mut kept = prepared(scene, &mut moves);
        bencher.with_inputs(|| (obstacle.clone(), moves.next().unwrap())).bench_local_values(
            |(obstacle, query)| {
                let was_there = kept.remove_obstacle(&obstacle.id);
                let without = ask(&mut kept, &query);
                let is_valid = kept.put_obstacle(obstacle, &Budget::unlimited()).is_ok();
                (was_there, without, is_valid, ask(&mut kept, &query))
            },
        );
    }

    #[divan::bench(args = SIZES)]
    fn polyanya(bencher: Bencher<'_, '_>, n: usize) {
        build_twice(bencher, n, false);
    }

    #[divan::bench(args = SIZES)]
    fn polyanya_merged(bencher: Bencher<'_, '_>, n: usize) {
        build_twice(bencher, n, true);
    }

    fn build_twice(bencher: Bencher<'_, '_>, n: usize, merged: bool) {
        let (scene, mut moves) = scene_and_moves(n);
        let mut less = scene.clone();
        less.obstacles.remove(n / 2);
        bencher
            .with_inputs(|| moves.next().unwrap())
            .bench_local_refs(|query| [&less, &scene].map(|scene| length(&mesh(scene, merged), query)));
    }
}
