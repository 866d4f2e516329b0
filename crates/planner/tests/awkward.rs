//! Prepared scenes of awkward kinds, edited in awkward ways, answer what fresh ones answer. More seeds:
//! `AWKWARD_SEEDS=0..2000 cargo test -p traverse-planner --test awkward`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test stops where it can't go on"
)]

mod support;

use std::ops::Range;

use rand::RngExt;
use support::awkward::{awkward_obstacle, awkward_point, awkward_scene};
use support::{assert_sound, query};
use traverse_geometry::{Obstacle, Scene, Vector};
use traverse_planner::{Answer, EditRefusal, PreparedScene, SceneEdit, plan_rapid_move};
use traverse_solve::{Budget, Seed, Silent};

fn seeds() -> Range<u64> {
    let Ok(range) = std::env::var("AWKWARD_SEEDS") else { return 0..50 };
    let (first, end) = range.split_once("..").expect("FIRST..END");
    first.parse().unwrap()..end.parse().unwrap()
}

/// What the two answers disagree in; nothing if they agree.
fn disagreement(
    prepared: &mut PreparedScene,
    fresh: &Scene,
    random: &mut impl RngExt,
    origin: Vector,
) -> Option<String> {
    let move_ = query(awkward_point(random, fresh, origin), awkward_point(random, fresh, origin));
    let budget = Budget::unlimited();
    let found = prepared.plan(&move_, &budget, &mut Silent).map(|(answer, _)| answer);
    let expected = plan_rapid_move(fresh, &move_, &budget, &mut Silent).map(|(answer, _)| answer);
    let same = match (&found, &expected) {
        (Ok(Answer::Plan(found)), Ok(Answer::Plan(expected))) => {
            assert_sound(fresh, move_.start, move_.target, found);
            (found.cost - expected.cost).abs() <= 1e-9 * expected.cost.max(1.0)
        }
        (found, expected) => found == expected,
    };
    (!same).then(|| format!("{} {}: {found:?}\n  fresh: {expected:?}", move_.start, move_.target))
}

/// One edit, sometimes refused; `gone` holds what was taken away and may be put back as it was.
fn edit(
    prepared: &mut PreparedScene,
    fresh: &mut Scene,
    gone: &mut Vec<Obstacle>,
    random: &mut impl RngExt,
    origin: Vector,
) {
    let mut edit = SceneEdit::default();
    for _ in 0..random.random_range(1..3) {
        match random.random_range(0..3) {
            0 if !gone.is_empty() => edit.put.push(gone[random.random_range(0..gone.len())].clone()),
            1 if !fresh.obstacles.is_empty() => {
                let i = random.random_range(0..fresh.obstacles.len());
                edit.remove.push(fresh.obstacles[i].id.clone());
            }
            _ => {
                let id = format!("o{}", random.random_range(0..30));
                edit.put.push(awkward_obstacle(random, origin, id));
            }
        }
    }
    edit.put.sort_by(|a, b| a.id.cmp(&b.id));
    edit.put.dedup_by(|a, b| a.id == b.id);
    edit.remove.sort();
    edit.remove.dedup();
    edit.remove.retain(|id| edit.put.iter().all(|put| put.id != *id));
    if random.random_bool(0.2) {
        let refused = SceneEdit { remove: vec!["nowhere".to_owned()], ..edit.clone() };
        let refusal = prepared.edit(refused, &Budget::unlimited()).unwrap_err();
        assert_eq!(refusal, EditRefusal::UnknownObstacle { id: "nowhere".to_owned() });
        return;
    }
    for put in &edit.put {
        gone.extend(fresh.obstacles.extract_if(.., |obstacle| obstacle.id == put.id));
        fresh.obstacles.push(put.clone());
    }
    gone.extend(fresh.obstacles.extract_if(.., |obstacle| edit.remove.contains(&obstacle.id)));
    prepared.edit(edit, &Budget::unlimited()).unwrap();
}

#[test]
fn awkward_scenes_answer_prepared_and_edited_as_fresh_ones() {
    let mut wrong = Vec::new();
    for seed in seeds() {
        let mut random = Seed(seed).stream();
        let far = if random.random_bool(0.3) { 20_000.0 } else { 0.0 };
        let origin = Vector::new(far, -far);
        let mut fresh = awkward_scene(&mut random, origin);
        let mut prepared = PreparedScene::new(fresh.clone(), &Budget::unlimited()).unwrap();
        let mut gone = Vec::new();
        for step in 0..12 {
            if random.random_bool(0.4) {
                prepared.triangulate(&Budget::unlimited()).unwrap();
            }
            for _ in 0..4 {
                let disagreement = disagreement(&mut prepared, &fresh, &mut random, origin);
                wrong.extend(disagreement.map(|what| format!("seed {seed} step {step}: {what}")));
            }
            edit(&mut prepared, &mut fresh, &mut gone, &mut random, origin);
        }
    }
    assert!(wrong.is_empty(), "{} disagreements\n{}", wrong.len(), wrong.join("\n"));
}
