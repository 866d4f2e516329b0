//! Heights, ways out of barriers and lists of clearances over the wire, planned and checked.

use crate::request::{obstacle, past_a_block, point, square};
use crate::running::Running;
use traverse_proto::v1::{self, plan_rapid_move_response::Outcome};

async fn planned(server: &Running, request: &v1::PlanRapidMoveRequest) -> Outcome {
    let mut client = server.client().await;
    let answer = client.plan_rapid_move(request.clone()).await.expect("sound").into_inner();
    let outcome = answer.outcome.expect("not only validated");
    if let Outcome::Plan(plan) = &outcome {
        let check = v1::CheckRapidMoveRequest {
            request: Some(request.clone()),
            path: plan.path.clone(),
            tolerance_mm: None,
        };
        let checked = client.check_rapid_move(check).await.expect("sound").into_inner();
        assert_eq!(checked.violations, []);
        assert!((checked.cost - plan.cost).abs() < 1e-9);
        assert_eq!(checked.clearance_mm, plan.clearance_mm);
    }
    outcome
}

fn plan_of(outcome: Outcome) -> v1::RapidPlan {
    match outcome {
        Outcome::Plan(plan) => plan,
        Outcome::NoPath(no_path) => panic!("{no_path:?}"),
    }
}

fn low_block() -> v1::PlanRapidMoveRequest {
    let mut request = past_a_block();
    if let Some(scene) = &mut request.scene {
        scene.obstacles[0].top_z_mm = Some(0.5);
    }
    let heights =
        v1::HeightRule { start_z_mm: 0.0, target_z_mm: 0.25, highest_z_mm: 5.0, clearance_z_mm: 0.5 };
    request.rules = Some(v1::RapidRules { heights: Some(heights), ..Default::default() });
    request
}

#[tokio::test]
async fn a_low_block_is_passed_over() {
    let server = Running::start().await;
    let plan = plan_of(planned(&server, &low_block()).await);
    assert_eq!((plan.cost, plan.lower_bound), (1.0 + 20.0 + 0.75, 21.75));
    let path = plan.path.expect("there");
    assert_eq!((path.start_z_mm, path.length_mm), (Some(0.0), 21.75));
    let heights: Vec<Option<f64>> = path.steps.iter().map(|step| step.z_mm).collect();
    assert_eq!(heights, [Some(1.0), Some(1.0), Some(0.25)]);
    // Lower by ten tolerances: seen.
    let mut path = path;
    path.steps[0].z_mm = Some(1.0 - 1e-5);
    path.steps[1].z_mm = Some(1.0 - 1e-5);
    let check =
        v1::CheckRapidMoveRequest { request: Some(low_block()), path: Some(path), tolerance_mm: None };
    let checked = server.client().await.check_rapid_move(check).await.expect("sound").into_inner();
    let reasons: Vec<&str> = checked.violations.iter().map(|violation| violation.reason.as_str()).collect();
    assert_eq!(reasons, ["TOO_LOW"]);
}

#[tokio::test]
async fn an_end_is_left_by_its_rule() {
    let server = Running::start().await;
    let nearest = v1::EndRule { rule: Some(v1::end_rule::Rule::Nearest(v1::end_rule::NearestWay {})) };
    let rules = v1::RapidRules { leave: Some(nearest), ..Default::default() };
    let request = v1::PlanRapidMoveRequest { start: point(-1.0, 5.0), rules: Some(rules), ..past_a_block() };
    let path = plan_of(planned(&server, &request).await).path.expect("there");
    assert_eq!(path.steps[0].end, point(-3.0, 5.0));
}

#[tokio::test]
async fn a_smaller_clearance_is_tried_and_told_and_so_is_the_feasible_one() {
    let server = Running::start().await;
    let obstacles = vec![
        obstacle(
            "low",
            v1::Polygon {
                outer: Some(v1::Ring {
                    xy_mm: vec![0.0, -50.0, 9.0, -50.0, 9.0, -2.0, 0.0, -2.0],
                    bulges: vec![],
                }),
                holes: vec![],
            },
        ),
        obstacle(
            "high",
            v1::Polygon {
                outer: Some(v1::Ring {
                    xy_mm: vec![0.0, 2.0, 9.0, 2.0, 9.0, 50.0, 0.0, 50.0],
                    bulges: vec![],
                }),
                holes: vec![],
            },
        ),
    ];
    let area = v1::Ring { xy_mm: vec![-30.0, -50.0, 40.0, -50.0, 40.0, 50.0, -30.0, 50.0], bulges: vec![] };
    let scene = v1::Scene {
        obstacles,
        work_area: Some(v1::Polygon { outer: Some(area), holes: vec![] }),
        clearance_mm: 5.0,
        ..Default::default()
    };
    let mut request = v1::PlanRapidMoveRequest {
        scene: Some(scene),
        start: point(-20.0, 0.0),
        target: point(30.0, 0.0),
        ..Default::default()
    };
    let Outcome::NoPath(shut) = planned(&server, &request).await else { panic!("5 mm is too much") };
    let feasible = shut.feasible_clearance_mm.expect("a narrow way");
    assert!(feasible <= 2.0 && feasible > 2.0 - 1e-6, "{feasible}");
    assert!(!shut.feasible_clearance_unknown);
    request.rules = Some(v1::RapidRules { clearances_mm: vec![5.0, 2.5, 1.5, 1.0], ..Default::default() });
    assert_eq!(plan_of(planned(&server, &request).await).clearance_mm, 1.5);
}

#[tokio::test]
async fn rules_validate_without_planning() {
    let server = Running::start().await;
    let request = v1::PlanRapidMoveRequest { validate_only: true, ..low_block() };
    let answer = server.client().await.plan_rapid_move(request).await.expect("sound").into_inner();
    assert_eq!(answer, v1::PlanRapidMoveResponse::default());
    let _ = square(0.0, 0.0, 1.0);
}
