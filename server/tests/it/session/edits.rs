//! Edits in random order: over the socket a session answers, to the bit, what a fresh scene would.

use super::{Talk, query};
use crate::request::{obstacle, point};
use crate::running::Running;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus as Stream;
use traverse_proto::v1::plan_rapid_move_response::Outcome as Fresh;
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::{EditScene, Obstacle, PlanRapidMoveRequest, Polygon, Ring, Scene};

/// A star somewhere in a square of 100 mm.
fn star(stream: &mut Stream, id: usize) -> Obstacle {
    let (x, y) = (stream.random_range(0.0..100.0), stream.random_range(0.0..100.0));
    let corners = stream.random_range(3..8);
    let mut xy_mm = Vec::new();
    for i in 0..corners {
        let angle =
            std::f64::consts::TAU * (f64::from(i) + stream.random_range(0.1..0.9)) / f64::from(corners);
        let radius = stream.random_range(3.0..9.0);
        xy_mm.extend([x + radius * angle.cos(), y + radius * angle.sin()]);
    }
    let outer = Ring { xy_mm, bulges: vec![] };
    obstacle(&format!("o{id}"), Polygon { outer: Some(outer), holes: vec![] })
}

fn edit(stream: &mut Stream, scene: &mut Scene) -> EditScene {
    let mut edit = EditScene::default();
    for _ in 0..stream.random_range(0..3) {
        let number = stream.random_range(0..30);
        let put = star(stream, number);
        if edit.put_obstacles.iter().all(|other| other.id != put.id) {
            edit.put_obstacles.push(put);
        }
    }
    let is_put = |id: &String| edit.put_obstacles.iter().any(|put| put.id == *id);
    for obstacle in &scene.obstacles {
        if stream.random_bool(0.05) && !is_put(&obstacle.id) {
            edit.remove_obstacle_ids.push(obstacle.id.clone());
        }
    }
    scene
        .obstacles
        .retain(|obstacle| !is_put(&obstacle.id) && !edit.remove_obstacle_ids.contains(&obstacle.id));
    scene.obstacles.extend(edit.put_obstacles.iter().cloned());
    edit
}

#[tokio::test]
async fn a_session_answers_as_fresh_scenes_do_to_the_bit() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let mut plans = 0;
    for seed in 0..6 {
        let mut stream = Stream::seed_from_u64(seed);
        let obstacles = (0..20).map(|id| star(&mut stream, id)).collect();
        let clearance_mm = [0.0, 1.0, 2.5][seed as usize % 3];
        let mut scene = Scene { obstacles, clearance_mm, ..Default::default() };
        let mut talk = Talk::open(&mut client).await.expect("opened");
        talk.changed(Step::Scene(scene.clone())).await;
        for _ in 0..20 {
            let edit = edit(&mut stream, &mut scene);
            let changed = talk.changed(Step::Edit(edit)).await;
            assert_eq!(changed.obstacle_count as usize, scene.obstacles.len());
            let ends = [0; 4].map(|_| stream.random_range(-10.0..110.0));
            let [start, target] = [(ends[0], ends[1]), (ends[2], ends[3])];
            let outcome = talk.ask(Step::Query(query(start, target))).await;
            let fresh = PlanRapidMoveRequest {
                scene: Some(scene.clone()),
                start: point(start.0, start.1),
                target: point(target.0, target.1),
                ..Default::default()
            };
            match (outcome, client.plan_rapid_move(fresh).await) {
                (Outcome::Plan(found), Ok(fresh)) => {
                    assert_eq!(Some(Fresh::Plan(found)), fresh.into_inner().outcome, "seed {seed}");
                    plans += 1;
                }
                (Outcome::NoPath(found), Ok(fresh)) => {
                    assert_eq!(Some(Fresh::NoPath(found)), fresh.into_inner().outcome, "seed {seed}");
                }
                (Outcome::Problem(problem), Err(status)) => {
                    assert_eq!(problem.code, i32::from(status.code()), "seed {seed}");
                    assert_eq!(problem.reason, crate::bad_input::reason(&status), "seed {seed}");
                }
                (found, fresh) => panic!("seed {seed}: {found:?} is not {fresh:?}"),
            }
        }
    }
    assert!(plans > 50, "{plans}");
}
