//! Steps, their answers and their refusals.

use super::{Talk, one_block, past, put, query, remove};
use crate::request::{PAST_A_BLOCK_MM, obstacle, point, square};
use crate::running::Running;
use tonic::Code;
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::{EditScene, Problem, RapidQuery, RapidRules, Scene};
use traverse_proto::{Limits, v1};
use traverse_server::{Config, TraverseEngines};

fn fields(problem: &Problem) -> Vec<(&str, &str)> {
    problem.findings.iter().map(|finding| (finding.field.as_str(), finding.reason.as_str())).collect()
}

#[tokio::test]
async fn every_step_is_answered_in_order() {
    let server = Running::start().await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    talk.send("scene", Step::Scene(one_block())).await;
    talk.send("past", Step::Query(past())).await;
    talk.send("inside", Step::Query(query((5.0, 5.0), (15.0, 2.0)))).await;
    talk.send("gone", Step::Edit(remove(&["block"]))).await;
    talk.send("straight", Step::Query(past())).await;
    let mut told = Vec::new();
    for _ in 0..5 {
        let answer = talk.next().await.expect("no end").expect("an answer");
        let what = match answer.outcome.expect("always set") {
            Outcome::Plan(plan) => {
                assert_eq!(plan.cost, plan.lower_bound);
                let stats = answer.stats.expect("of a query");
                assert!(stats.search_duration.is_some() && stats.prepare_duration.is_some());
                format!("{:.6} mm round {}", plan.cost, plan.bending_obstacle_ids.join(" "))
            }
            Outcome::SceneChanged(changed) => format!("{} of {}", changed.revision, changed.obstacle_count),
            Outcome::Problem(problem) => problem.reason,
            Outcome::NoPath(_) => "no path".to_owned(),
        };
        told.push(format!("{}: {what}", answer.step_id));
    }
    let expected = [
        "scene: 1 of 1".to_owned(),
        format!("past: {PAST_A_BLOCK_MM:.6} mm round block"),
        "inside: END_INSIDE_BARRIER".to_owned(),
        "gone: 2 of 0".to_owned(),
        "straight: 20.000000 mm round ".to_owned(),
    ];
    assert_eq!(told, expected);
    let Talk { steps, mut answers } = talk;
    drop(steps);
    assert_eq!(answers.message().await.expect("it ends well"), None);
}

#[tokio::test]
async fn a_refused_query_fails_alone_and_says_all_that_is_wrong() {
    let server = Running::start().await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    talk.changed(Step::Scene(one_block())).await;
    let rules = RapidRules { algorithm: 7, ..Default::default() };
    let wrong = RapidQuery { start: point(f64::NAN, 0.0), target: None, rules: Some(rules) };
    let problem = talk.problem(Step::Query(wrong)).await;
    assert_eq!((problem.code, problem.reason.as_str()), (Code::InvalidArgument.into(), "INVALID_REQUEST"));
    let expected = [
        ("query.start.x_mm", "NOT_FINITE"),
        ("query.target", "MISSING_FIELD"),
        ("query.rules.algorithm", "UNKNOWN_ENUM_VALUE"),
    ];
    assert_eq!(fields(&problem), expected);
    let inside = talk.problem(Step::Query(query((5.0, 5.0), (-1.0, 5.0)))).await;
    assert_eq!(
        fields(&inside),
        [("query.start", "END_INSIDE_BARRIER"), ("query.target", "END_INSIDE_BARRIER")]
    );
    assert!((talk.plan(past()).await.cost - PAST_A_BLOCK_MM).abs() < 1e-6);
}

#[tokio::test]
async fn nothing_is_planned_against_a_scene_that_is_not_meant() {
    let server = Running::start().await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    let stale = async |talk: &mut Talk, step: Step| {
        let problem = talk.problem(step).await;
        let expected = (i32::from(Code::FailedPrecondition), "SCENE_STALE");
        assert_eq!((problem.code, problem.reason.as_str()), expected, "{problem:?}");
    };
    // Before there is a scene.
    stale(&mut talk, Step::Query(past())).await;
    stale(&mut talk, Step::Edit(put("block", 0.0, 0.0, 10.0))).await;
    assert_eq!(talk.changed(Step::Scene(one_block())).await.revision, 1);
    // After a refused edit, until one succeeds.
    assert_eq!(talk.problem(Step::Edit(remove(&["vise"]))).await.reason, "INVALID_REQUEST");
    stale(&mut talk, Step::Query(past())).await;
    let changed = talk.changed(Step::Edit(put("clamp", 0.0, 50.0, 5.0))).await;
    assert_eq!((changed.revision, changed.obstacle_count), (2, 2));
    talk.plan(past()).await;
    // After a refused scene no edit helps, only a scene.
    let unsound = Scene { clearance_mm: -1.0, ..one_block() };
    assert_eq!(fields(&talk.problem(Step::Scene(unsound)).await), [("scene.clearance_mm", "OUT_OF_RANGE")]);
    stale(&mut talk, Step::Query(past())).await;
    stale(&mut talk, Step::Edit(put("clamp", 0.0, 50.0, 5.0))).await;
    stale(&mut talk, Step::Query(past())).await;
    assert_eq!(talk.changed(Step::Scene(one_block())).await.revision, 3);
    talk.plan(past()).await;
    // A step without content may have been anything.
    talk.send("empty", None).await;
    let answer = talk.next().await.expect("no end").expect("an answer");
    let Some(Outcome::Problem(problem)) = answer.outcome else { panic!("{:?}", answer.outcome) };
    assert_eq!(fields(&problem), [("step", "MISSING_FIELD")]);
    stale(&mut talk, Step::Query(past())).await;
}

#[tokio::test]
async fn every_finding_of_an_edit_comes_at_once_and_nothing_of_it_is_done() {
    let limits = Limits { obstacle_count: 5, vertex_count: 24, ..Limits::default() };
    let config = Config { limits, ..Config::on_free_port() };
    let server = Running::with(config, TraverseEngines).await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    talk.changed(Step::Scene(one_block())).await;
    let far = |id: &str, x: f64| obstacle(id, square(x, 100.0, 1.0));
    let bad = v1::Obstacle { clearance_mm: Some(-2.0), ..far("bad", 0.0) };
    let edit = EditScene {
        put_obstacles: vec![far("a", 10.0), far("a", 20.0), far("", 30.0), bad],
        remove_obstacle_ids: ["block", "block", "a", "nowhere", ""].map(str::to_owned).to_vec(),
    };
    let problem = talk.problem(Step::Edit(edit)).await;
    let expected = [
        ("edit.put_obstacles[1].id", "DUPLICATE_ID"),
        ("edit.put_obstacles[2].id", "MISSING_FIELD"),
        ("edit.put_obstacles[3].clearance_mm", "OUT_OF_RANGE"),
        ("edit.remove_obstacle_ids[1]", "DUPLICATE_ID"),
        ("edit.remove_obstacle_ids[2]", "DUPLICATE_ID"),
        ("edit.remove_obstacle_ids[3]", "UNKNOWN_ID"),
        ("edit.remove_obstacle_ids[4]", "MISSING_FIELD"),
    ];
    assert_eq!(fields(&problem), expected);
    // An edit of nothing makes the scene count again: it is as it was.
    assert_eq!(talk.changed(Step::Edit(EditScene::default())).await.obstacle_count, 1);
    assert!((talk.plan(past()).await.cost - PAST_A_BLOCK_MM).abs() < 1e-6);
    // The whole scene has to fit, not only the edit.
    let too_many = EditScene {
        put_obstacles: ["a", "b", "c", "d", "e"].map(|id| far(id, 9.0)).to_vec(),
        ..Default::default()
    };
    let problem = talk.problem(Step::Edit(too_many)).await;
    assert_eq!(fields(&problem), [("edit.put_obstacles", "TOO_MANY")], "{problem:?}");
    let swapped = EditScene {
        put_obstacles: ["a", "b", "c", "d", "e"].map(|id| far(id, 9.0)).to_vec(),
        remove_obstacle_ids: vec!["block".to_owned()],
    };
    assert_eq!(talk.changed(Step::Edit(swapped)).await.obstacle_count, 5);
    let replaced = EditScene { put_obstacles: vec![far("a", 0.0), far("d", 5.0)], ..Default::default() };
    assert_eq!(talk.changed(Step::Edit(replaced)).await.obstacle_count, 5);
}

#[tokio::test]
async fn no_path_is_an_answer() {
    let server = Running::start().await;
    let mut talk = Talk::open(&mut server.client().await).await.expect("opened");
    let walls = [("w", -20.0, -20.0), ("x", 10.0, -20.0), ("y", -20.0, 10.0), ("z", -20.0, -50.0)];
    let walls = walls.map(|(id, x, y)| obstacle(id, square(x, y, 30.0)));
    talk.changed(Step::Scene(Scene { obstacles: walls.to_vec(), clearance_mm: 1.0, ..Default::default() }))
        .await;
    let ask = Step::Query(query((-40.0, -5.0), (60.0, 60.0)));
    assert!(matches!(talk.ask(ask).await, Outcome::Plan(_)));
    let area = square(-60.0, -60.0, 200.0);
    let moat = v1::Polygon {
        outer: square(100.0, 100.0, 30.0).outer,
        holes: vec![square(105.0, 105.0, 20.0).outer.expect("set")],
    };
    let scene =
        Scene { work_area: Some(area), obstacles: vec![obstacle("moat", moat)], ..Default::default() };
    talk.changed(Step::Scene(scene)).await;
    let Outcome::NoPath(no_path) = talk.ask(Step::Query(query((0.0, 0.0), (115.0, 115.0)))).await else {
        panic!("there is a path")
    };
    assert_eq!(no_path.separating_obstacle_ids, ["moat"]);
}
