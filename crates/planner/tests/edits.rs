//! Edits of prepared scenes: all or nothing, and afterwards the scene answers as a fresh one does, bit for bit.
#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{assert_sound, point, query, scene, stars};
use traverse_geometry::{Obstacle, Scene};
use traverse_planner::{Answer, EditRefusal, PreparedScene, SceneEdit, plan_rapid_move};
use traverse_solve::{Budget, CancelToken, Seed, Silent};

fn obstacle(random: &mut impl RngExt, ids: u32, side: f64) -> Obstacle {
    let shape = stars(random, 1, side, 12.0).remove(0);
    Obstacle { id: format!("o{}", random.random_range(0..ids)), shape, clearance_mm: None, top_z_mm: None }
}

/// Edits as a fresh scene would have it.
fn edited(scene: &Scene, edit: &SceneEdit) -> Scene {
    let mut scene = scene.clone();
    for obstacle in &edit.put {
        scene.obstacles.retain(|other| other.id != obstacle.id);
        scene.obstacles.push(obstacle.clone());
    }
    scene.obstacles.retain(|obstacle| !edit.remove.contains(&obstacle.id));
    scene
}

/// An edit of several obstacles; ids at most once each.
fn some_edit(random: &mut impl RngExt, scene: &Scene) -> SceneEdit {
    let mut edit = SceneEdit::default();
    for _ in 0..random.random_range(0..4) {
        let side = if random.random_bool(0.1) { 300.0 } else { 100.0 };
        let obstacle = obstacle(random, 40, side);
        if edit.put.iter().all(|other| other.id != obstacle.id) {
            edit.put.push(obstacle);
        }
    }
    for obstacle in &scene.obstacles {
        if random.random_bool(0.08) && edit.put.iter().all(|other| other.id != obstacle.id) {
            edit.remove.push(obstacle.id.clone());
        }
    }
    edit
}

/// Plans in both scenes are the same, to the bit of every number. How many were plans.
fn assert_same(
    prepared: &mut PreparedScene,
    fresh: &Scene,
    random: &mut impl RngExt,
    count: usize,
    what: &str,
) -> usize {
    let mut plans = 0;
    for _ in 0..count {
        let mut at = || point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        let move_ = query(at(), at());
        let budget = Budget::unlimited();
        let found = prepared.plan(&move_, &budget, &mut Silent).map(|(answer, _)| answer);
        let expected = plan_rapid_move(fresh, &move_, &budget, &mut Silent).map(|(answer, _)| answer);
        assert_eq!(found, expected, "{what}: {move_:?}");
        if let Ok(Answer::Plan(plan)) = &found {
            assert_sound(fresh, move_.start, move_.target, plan);
            plans += 1;
        }
    }
    plans
}

#[test]
fn edits_in_random_order_answer_as_fresh_scenes_bit_for_bit() {
    let mut plans = 0;
    for seed in 0..40 {
        let mut random = Seed(seed).stream();
        let clearance = [0.0, 1.0, 3.0][seed as usize % 3];
        let mut fresh = scene(stars(&mut random, 25, 100.0, 10.0), clearance);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        for step in 0..25 {
            if (seed + step) % 5 == 0 {
                prepared.triangulate(&Budget::unlimited()).unwrap();
            }
            let edit = some_edit(&mut random, &fresh);
            fresh = edited(&fresh, &edit);
            prepared.edit(edit, &Budget::unlimited()).unwrap();
            assert_eq!(prepared.obstacle_count(), fresh.obstacles.len());
            assert_eq!(prepared.vertex_count(), fresh.vertex_count());
            let what = format!("seed {seed} step {step}");
            plans += assert_same(&mut prepared, &fresh, &mut random, 3, &what);
        }
    }
    assert!(plans > 1000, "{plans}");
}

#[test]
fn a_refused_edit_leaves_nothing_behind() {
    for seed in 0..30 {
        let mut random = Seed(seed).stream();
        let fresh = scene(stars(&mut random, 20, 100.0, 10.0), 1.0);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        let what = format!("seed {seed}");
        assert_same(&mut prepared, &fresh, &mut random, 4, &what);
        let mut edit = some_edit(&mut random, &fresh);
        edit.put.push(obstacle(&mut random, 40, 100.0));
        edit.remove.push("nowhere".to_owned());
        let refusal = prepared.edit(edit.clone(), &Budget::unlimited()).unwrap_err();
        assert_eq!(refusal, EditRefusal::UnknownObstacle { id: "nowhere".to_owned() });
        let cancel = CancelToken::new();
        cancel.cancel();
        let over = Budget { cancel, ..Budget::unlimited() };
        assert!(matches!(prepared.edit(edit, &over), Err(EditRefusal::Interrupted(_))));
        assert_eq!(prepared.vertex_count(), fresh.vertex_count());
        for obstacle in &fresh.obstacles {
            assert_eq!(prepared.obstacle(&obstacle.id), Some(obstacle));
        }
        assert_same(&mut prepared, &fresh, &mut random, 6, &what);
    }
}

#[test]
fn a_scene_that_grows_from_nothing_answers_as_a_fresh_one() {
    for (seed, at_once) in (0..6).zip([true, false].into_iter().cycle()) {
        let mut random = Seed(seed).stream();
        let mut ids = 0..;
        let many = stars(&mut random, 700, 900.0, 10.0).into_iter().map(|shape| {
            let id = format!("o{}", ids.next().unwrap());
            Obstacle { id, shape, clearance_mm: None, top_z_mm: None }
        });
        let many: Vec<Obstacle> = many.collect();
        let empty = scene([], 1.0);
        let mut prepared = PreparedScene::new(empty.clone(), &Budget::unlimited()).unwrap();
        let put = |put: &[Obstacle]| SceneEdit { put: put.to_vec(), remove: vec!["o3".to_owned()] };
        if at_once {
            prepared.edit(put(&many), &Budget::unlimited()).unwrap();
            let again = prepared.edit(put(&many[..600]), &Budget::unlimited());
            again.unwrap();
            let unknown = SceneEdit { put: many.clone(), remove: vec!["nowhere".to_owned()] };
            let refusal = prepared.edit(unknown, &Budget::unlimited()).unwrap_err();
            assert_eq!(refusal, EditRefusal::UnknownObstacle { id: "nowhere".to_owned() });
        } else {
            many.iter().for_each(|one| prepared.put_obstacle(one.clone(), &Budget::unlimited()).unwrap());
            prepared.remove_obstacle("o3").unwrap();
        }
        let first = if at_once { many[600..].iter().chain(&many[..600]) } else { many.iter().chain(&[]) };
        let obstacles = first.filter(|obstacle| obstacle.id != "o3").cloned().collect();
        let fresh = Scene { obstacles, ..empty };
        assert_eq!(prepared.vertex_count(), fresh.vertex_count());
        assert_same(&mut prepared, &fresh, &mut random, 4, &format!("seed {seed}"));
    }
}

#[test]
fn what_is_put_again_and_again_does_not_pile_up() {
    let mut random = Seed(3).stream();
    let fresh = scene(stars(&mut random, 10, 100.0, 10.0), 1.0);
    let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
    let same = fresh.obstacles[0].clone();
    for _ in 0..10_000 {
        let edit = SceneEdit { put: vec![same.clone()], remove: vec![] };
        prepared.edit(edit, &Budget::unlimited()).unwrap();
    }
    assert_eq!(prepared.vertex_count(), fresh.vertex_count());
    assert!(prepared.kept_vertex_count() < 10_000, "{}", prepared.kept_vertex_count());
    let mut expected = fresh;
    let first = expected.obstacles.remove(0);
    expected.obstacles.push(first);
    assert_same(&mut prepared, &expected, &mut random, 5, "put again");
}

/// A few obstacles come and go, also by edits that are refused and undone, more often than moves are asked for.
#[test]
fn what_came_and_went_between_moves_leaves_no_trace() {
    let mut plans = 0;
    for seed in 0..60 {
        let mut random = Seed(100 + seed).stream();
        let mut fresh = scene(stars(&mut random, 25, 100.0, 10.0), [0.0, 1.0][seed as usize % 2]);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        assert_same(&mut prepared, &fresh, &mut random, 6, "warm");
        for step in 0..60 {
            let id = format!("o{}", random.random_range(0..3));
            let mut edit = SceneEdit::default();
            if fresh.obstacles.iter().any(|obstacle| obstacle.id == id) && random.random_bool(0.6) {
                edit.remove.push(id);
            } else {
                edit.put.push(Obstacle { id, ..obstacle(&mut random, 1, 100.0) });
            }
            if random.random_bool(0.2) {
                edit.remove.push("nowhere".to_owned());
                prepared.edit(edit, &Budget::unlimited()).unwrap_err();
            } else {
                fresh = edited(&fresh, &edit);
                prepared.edit(edit, &Budget::unlimited()).unwrap();
            }
            let count = random.random_range(0..6_usize).saturating_sub(3);
            let what = format!("seed {seed} step {step}");
            plans += assert_same(&mut prepared, &fresh, &mut random, count, &what);
        }
    }
    assert!(plans > 1000, "{plans}");
}
