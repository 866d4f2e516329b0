//! PlaceToolChange and alternatives over the wire: answered, bounded, refused with every finding.

use crate::request::{obstacle, past_a_block, point, square};
use crate::running::Running;
use traverse_proto::v1::{self, place_tool_change_response::Outcome};

/// Past a block, with a change in a square above it.
fn above_a_block() -> v1::PlaceToolChangeRequest {
    v1::PlaceToolChangeRequest {
        scene: past_a_block().scene,
        start: point(-5.0, 2.0),
        target: point(15.0, 2.0),
        regions: vec![square(0.0, 20.0, 10.0)],
        ..Default::default()
    }
}

async fn placed(server: &Running, request: v1::PlaceToolChangeRequest) -> v1::PlaceToolChangeResponse {
    server.client().await.place_tool_change(request).await.expect("sound").into_inner()
}

#[tokio::test]
async fn the_best_place_comes_with_both_moves() {
    let server = Running::start().await;
    let answer = placed(&server, above_a_block()).await;
    assert!(answer.stats.expect("told").expanded_node_count > 0);
    let Some(Outcome::Plan(plan)) = answer.outcome else { panic!("a place") };
    // Symmetric: in the middle of the lower border.
    let place = plan.place.expect("there");
    assert!((place.x_mm - 5.0).abs() < 1e-6 && place.y_mm == 20.0, "{place:?}");
    assert_eq!((plan.cost, plan.cost_unit()), (plan.lower_bound, v1::CostUnit::Mm));
    let [approach, departure] = [plan.approach, plan.departure].map(|plan| plan.expect("there"));
    assert!((approach.cost + departure.cost - plan.cost).abs() < 1e-9);
    for (start, target, found) in
        [(point(-5.0, 2.0), Some(place), approach), (Some(place), point(15.0, 2.0), departure)]
    {
        let request = v1::PlanRapidMoveRequest { start, target, ..past_a_block() };
        let check =
            v1::CheckRapidMoveRequest { request: Some(request), path: found.path, tolerance_mm: None };
        let checked = server.client().await.check_rapid_move(check).await.expect("sound").into_inner();
        assert_eq!(checked.violations, []);
    }
}

fn axis_speeds(x_mm_per_s: f64, y_mm_per_s: f64) -> Option<v1::TravelCost> {
    let speeds = v1::travel_cost::AxisSpeeds { x_mm_per_s, y_mm_per_s, z_mm_per_s: 0.0 };
    Some(v1::TravelCost { measure: Some(v1::travel_cost::Measure::AxisSpeeds(speeds)) })
}

fn kinematics() -> Option<v1::TravelCost> {
    let limits = v1::travel_cost::Kinematics {
        speed_mm_per_s: 300.0,
        acceleration_mm_per_s2: 1500.0,
        junction_deviation_mm: 0.02,
        ..Default::default()
    };
    Some(v1::TravelCost { measure: Some(v1::travel_cost::Measure::Kinematics(limits)) })
}

/// Rules in seconds: of axes, the same by dog-legs, with acceleration.
fn by_seconds() -> [v1::RapidRules; 3] {
    let axes = v1::RapidRules { cost: axis_speeds(10.0, 4.0), ..Default::default() };
    let legs = v1::RapidRules { motion: v1::RapidMotion::DogLeg.into(), ..axes.clone() };
    [axes, legs, v1::RapidRules { cost: kinematics(), ..Default::default() }]
}

async fn checked(
    server: &Running,
    request: v1::PlanRapidMoveRequest,
    path: Option<v1::Path>,
) -> v1::CheckRapidMoveResponse {
    let check = v1::CheckRapidMoveRequest { request: Some(request), path, tolerance_mm: None };
    let checked = server.client().await.check_rapid_move(check).await.expect("sound").into_inner();
    assert_eq!(checked.violations, []);
    checked
}

#[tokio::test]
async fn places_are_found_in_seconds_and_both_moves_pass_the_check() {
    let server = Running::start().await;
    for rules in by_seconds() {
        let request = v1::PlaceToolChangeRequest { rules: Some(rules.clone()), ..above_a_block() };
        let Some(Outcome::Plan(plan)) = placed(&server, request).await.outcome else { panic!("a place") };
        assert_eq!(plan.cost_unit(), v1::CostUnit::Seconds);
        assert!(plan.lower_bound > 0.0 && plan.lower_bound <= plan.cost, "{plan:?}");
        // Up 18 and down 18 at 4 mm/s, and along no slower.
        assert!(rules.cost != axis_speeds(10.0, 4.0) || plan.cost == 9.0 && plan.lower_bound == 9.0);
        let moves =
            [(point(-5.0, 2.0), plan.place, plan.approach), (plan.place, point(15.0, 2.0), plan.departure)];
        let mut cost = 0.0;
        for (start, target, found) in moves {
            let rules = Some(rules.clone());
            let request = v1::PlanRapidMoveRequest { start, target, rules, ..past_a_block() };
            cost += checked(&server, request, found.and_then(|plan| plan.path)).await.cost;
        }
        assert!((cost - plan.cost).abs() < 1e-9);
    }
}

#[tokio::test]
async fn alternatives_are_told_in_seconds_and_pass_the_check() {
    let server = Running::start().await;
    for rules in by_seconds() {
        let rules = Some(v1::RapidRules { alternative_count: 3, ..rules });
        let request = v1::PlanRapidMoveRequest { rules, ..past_a_block() };
        let answer = server.client().await.plan_rapid_move(request.clone()).await.expect("sound");
        let outcome = answer.into_inner().outcome;
        let Some(v1::plan_rapid_move_response::Outcome::Plan(plan)) = outcome else { panic!("a plan") };
        let ([way], [cost]) = (&plan.alternatives[..], &plan.alternative_costs[..]) else {
            panic!("one other way: {plan:?}")
        };
        assert!(*cost >= plan.cost);
        let recomputed = checked(&server, request, Some(way.clone())).await;
        assert_eq!(recomputed.cost_unit(), v1::CostUnit::Seconds);
        assert!((recomputed.cost - cost).abs() < 1e-9);
    }
}

#[tokio::test]
async fn points_heights_and_no_place() {
    let server = Running::start().await;
    let points = vec![v1::Point { x_mm: 5.0, y_mm: 5.0 }, v1::Point { x_mm: 30.0, y_mm: 2.0 }];
    let only_points = v1::PlaceToolChangeRequest { regions: vec![], points, ..above_a_block() };
    let Some(Outcome::Plan(plan)) = placed(&server, only_points.clone()).await.outcome else {
        panic!("a place")
    };
    assert_eq!(plan.place, point(30.0, 2.0));
    let inside = v1::PlaceToolChangeRequest { points: only_points.points[..1].to_vec(), ..only_points };
    let Some(Outcome::NoPath(no_path)) = placed(&server, inside).await.outcome else { panic!("no place") };
    assert_eq!(
        (no_path.separating_obstacle_ids, no_path.feasible_clearance_mm),
        (vec!["block".to_owned()], None)
    );
    let heights =
        v1::HeightRule { start_z_mm: 0.0, target_z_mm: 0.0, highest_z_mm: 9.0, clearance_z_mm: 0.0 };
    let rules = v1::RapidRules { heights: Some(heights), ..Default::default() };
    let high = v1::PlaceToolChangeRequest { rules: Some(rules), place_z_mm: Some(4.0), ..above_a_block() };
    let Some(Outcome::Plan(plan)) = placed(&server, high).await.outcome else { panic!("a place") };
    let path = plan.approach.and_then(|plan| plan.path).expect("there");
    assert_eq!(path.steps.last().and_then(|step| step.z_mm), Some(4.0));
}

#[tokio::test]
async fn a_request_is_validated_and_every_finding_comes_at_once() {
    let server = Running::start().await;
    let sound = v1::PlaceToolChangeRequest { validate_only: true, ..above_a_block() };
    assert_eq!(placed(&server, sound).await, v1::PlaceToolChangeResponse::default());
    let rules = v1::RapidRules {
        alternative_count: 2,
        algorithm: v1::RapidAlgorithm::SupportingLines.into(),
        ..Default::default()
    };
    let wrong = v1::PlaceToolChangeRequest {
        start: None,
        regions: vec![v1::Polygon::default()],
        points: vec![v1::Point { x_mm: f64::NAN, y_mm: 0.0 }],
        rules: Some(rules),
        place_z_mm: Some(3.0),
        ..above_a_block()
    };
    let status = server.client().await.place_tool_change(wrong).await.expect_err("findings");
    let fields = crate::bad_input::findings(&status);
    let fields: Vec<&str> = fields.iter().map(|(field, _)| field.as_str()).collect();
    let expected = [
        "start",
        "rules.algorithm",
        "rules.alternative_count",
        "regions[0].outer",
        "points[0].x_mm",
        "place_z_mm",
    ];
    assert_eq!(fields, expected);
    let nowhere = v1::PlaceToolChangeRequest { regions: vec![], ..above_a_block() };
    let status = server.client().await.place_tool_change(nowhere).await.expect_err("no place is given");
    assert_eq!(crate::bad_input::findings(&status), [("regions".to_owned(), "MISSING_FIELD".to_owned())]);
    let inside = v1::PlaceToolChangeRequest { start: point(5.0, 5.0), ..above_a_block() };
    let status = server.client().await.place_tool_change(inside).await.expect_err("inside");
    assert!(status.message().contains("start lies"), "{status:?}");
}

#[tokio::test]
async fn alternatives_are_counted_and_bounded() {
    let server = Running::start().await;
    let with = |count| v1::PlanRapidMoveRequest {
        rules: Some(v1::RapidRules { alternative_count: count, ..Default::default() }),
        scene: past_a_block().scene.map(|scene| v1::Scene {
            obstacles: vec![
                obstacle("block", square(0.0, 0.0, 10.0)),
                obstacle("pin", square(3.0, -20.0, 4.0)),
            ],
            ..scene
        }),
        ..past_a_block()
    };
    let answer = server.client().await.plan_rapid_move(with(9)).await.expect("sound").into_inner();
    let Some(v1::plan_rapid_move_response::Outcome::Plan(plan)) = answer.outcome else { panic!("a plan") };
    // Of below the pin, between both, above the block, and back through the gap, either way, one is the plan.
    assert_eq!(plan.alternatives.len(), 4);
    let mut lengths: Vec<f64> = plan.alternatives.iter().map(|way| way.length_mm).collect();
    lengths.insert(0, plan.cost);
    assert!(lengths.is_sorted(), "{lengths:?}");
    for (count, reason) in [(-1, "OUT_OF_RANGE"), (17, "TOO_MANY")] {
        let status = server.client().await.plan_rapid_move(with(count)).await.expect_err("too many");
        let expected = [("rules.alternative_count".to_owned(), reason.to_owned())];
        assert_eq!(crate::bad_input::findings(&status), expected);
    }
}
