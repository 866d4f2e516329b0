//! Costs in seconds, dog-legs and chords over the wire, planned and checked; what is wrong with them.

use crate::request::{past_a_block, point};
use crate::running::Running;
use tonic::Code;
use tonic_types::StatusExt;
use traverse_proto::v1::{self, plan_rapid_move_response::Outcome, travel_cost::Measure};

fn axis_speeds(x: f64, y: f64) -> Option<v1::TravelCost> {
    let speeds = v1::travel_cost::AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 0.0 };
    Some(v1::TravelCost { measure: Some(Measure::AxisSpeeds(speeds)) })
}

fn kinematics(acceleration: f64) -> Option<v1::TravelCost> {
    let limits = v1::travel_cost::Kinematics {
        speed_mm_per_s: 200.0,
        z_mm_per_s: 0.0,
        acceleration_mm_per_s2: acceleration,
        junction_deviation_mm: 0.02,
        feed_mm_per_s: 50.0,
    };
    Some(v1::TravelCost { measure: Some(Measure::Kinematics(limits)) })
}

async fn planned(server: &Running, rules: v1::RapidRules) -> v1::RapidPlan {
    let request = v1::PlanRapidMoveRequest { rules: Some(rules), ..past_a_block() };
    let mut client = server.client().await;
    let answer = client.plan_rapid_move(request.clone()).await.expect("sound").into_inner();
    let Some(Outcome::Plan(plan)) = answer.outcome else { panic!("a block parts nothing") };
    let path = plan.path.clone();
    let check = v1::CheckRapidMoveRequest { request: Some(request), path, tolerance_mm: None };
    let checked = client.check_rapid_move(check).await.expect("sound").into_inner();
    assert_eq!(checked.violations, []);
    assert_eq!(checked.cost_unit, plan.cost_unit);
    assert!((checked.cost - plan.cost).abs() <= 1e-9 * plan.cost);
    plan
}

fn motions(plan: &v1::RapidPlan) -> Vec<(bool, v1::StepMotion)> {
    let steps = plan.path.iter().flat_map(|path| &path.steps);
    steps.map(|step| (step.arc.is_some(), step.motion())).collect()
}

#[tokio::test]
async fn seconds_are_planned_proven_or_bounded_and_checked() {
    let server = Running::start().await;
    let shortest = planned(&server, v1::RapidRules::default()).await;
    assert_eq!(shortest.cost_unit(), v1::CostUnit::Mm);
    for (is_arc, motion) in motions(&shortest) {
        assert_eq!(motion, if is_arc { v1::StepMotion::Feed } else { v1::StepMotion::Rapid });
    }
    let quick =
        planned(&server, v1::RapidRules { cost: axis_speeds(200.0, 50.0), ..Default::default() }).await;
    assert_eq!((quick.cost_unit(), quick.cost), (v1::CostUnit::Seconds, quick.lower_bound));
    let limited = planned(&server, v1::RapidRules { cost: kinematics(1000.0), ..Default::default() }).await;
    assert_eq!(limited.cost_unit(), v1::CostUnit::Seconds);
    assert!(limited.lower_bound >= shortest.cost / 200.0 && limited.lower_bound < limited.cost);
}

#[tokio::test]
async fn dog_legs_and_chords_are_planned_and_checked_as_they_run() {
    let server = Running::start().await;
    let rules = v1::RapidRules {
        cost: axis_speeds(100.0, 80.0),
        motion: v1::RapidMotion::DogLeg.into(),
        arcs: v1::ArcOutput::Chords.into(),
        ..Default::default()
    };
    let plan = planned(&server, rules.clone()).await;
    assert_eq!(plan.cost, plan.lower_bound);
    assert!(motions(&plan).iter().all(|step| *step == (false, v1::StepMotion::Rapid)));
    // A line past the block's corner is no way for a machine that runs dog-legs.
    let steps = [(-3.5, 12.0), (10.0, 13.2), (15.0, 2.0)];
    let steps = steps.map(|(x, y)| v1::PathStep { end: point(x, y), ..Default::default() }).to_vec();
    let path = Some(v1::Path { start: past_a_block().start, steps, ..Default::default() });
    let reasons = async |rules: v1::RapidRules| {
        let request = Some(v1::PlanRapidMoveRequest { rules: Some(rules), ..past_a_block() });
        let check = v1::CheckRapidMoveRequest { request, path: path.clone(), tolerance_mm: None };
        let checked = server.client().await.check_rapid_move(check).await.expect("sound").into_inner();
        checked
            .violations
            .into_iter()
            .map(|violation| (violation.field, violation.reason))
            .collect::<Vec<_>>()
    };
    let linear = reasons(v1::RapidRules { motion: 0, ..rules.clone() }).await;
    let dog_leg = reasons(rules).await;
    assert!(dog_leg.iter().all(|(field, _)| field.starts_with("path.steps[")));
    assert_ne!(linear, dog_leg);
}

#[tokio::test]
async fn what_is_wrong_with_costs_is_said_all_at_once() {
    let server = Running::start().await;
    let refused = async |rules: v1::RapidRules| {
        let request = v1::PlanRapidMoveRequest { rules: Some(rules), ..past_a_block() };
        let status = server.client().await.plan_rapid_move(request).await.expect_err("wrong");
        assert_eq!(status.code(), Code::InvalidArgument);
        let details = status.get_error_details();
        let violations = details.bad_request().expect("findings").field_violations.clone();
        violations.into_iter().map(|violation| (violation.field, violation.reason)).collect::<Vec<_>>()
    };
    let expect = |pairs: &[(&str, &str)]| {
        pairs.iter().map(|(field, reason)| ((*field).to_owned(), (*reason).to_owned())).collect::<Vec<_>>()
    };
    let rules =
        v1::RapidRules { cost: axis_speeds(0.0, f64::INFINITY), motion: 7, arcs: -1, ..Default::default() };
    let expected = [
        ("rules.motion", "UNKNOWN_ENUM_VALUE"),
        ("rules.arcs", "UNKNOWN_ENUM_VALUE"),
        ("rules.cost.axis_speeds.x_mm_per_s", "OUT_OF_RANGE"),
        ("rules.cost.axis_speeds.y_mm_per_s", "NOT_FINITE"),
    ];
    assert_eq!(refused(rules).await, expect(&expected));
    let rules = v1::RapidRules {
        cost: kinematics(-1.0),
        motion: v1::RapidMotion::DogLeg.into(),
        ..Default::default()
    };
    let expected =
        [("rules.cost.kinematics.acceleration_mm_per_s2", "OUT_OF_RANGE"), ("rules.motion", "MISSING_FIELD")];
    assert_eq!(refused(rules).await, expect(&expected));
    let heights =
        v1::HeightRule { start_z_mm: 0.0, target_z_mm: 0.0, highest_z_mm: 1.0, clearance_z_mm: 0.0 };
    let rules = v1::RapidRules { cost: axis_speeds(1.0, 1.0), heights: Some(heights), ..Default::default() };
    assert_eq!(refused(rules).await, expect(&[("rules.cost.axis_speeds.z_mm_per_s", "OUT_OF_RANGE")]));
}

#[tokio::test]
async fn a_passage_without_room_for_dog_legs_is_refused_by_its_name() {
    let server = Running::start().await;
    // A slanted channel in the work area, exactly twice the clearance wide.
    let (along, up) = ((0.8, 0.6), (-0.6, 0.8));
    let at = |a: f64, u: f64| [along.0 * a + up.0 * u, along.1 * a + up.1 * u];
    let channel = [at(-20.0, -2.0), at(20.0, -2.0), at(20.0, 2.0), at(-20.0, 2.0)];
    let outer = Some(v1::Ring { xy_mm: channel.concat(), bulges: Vec::new() });
    let scene = v1::Scene {
        work_area: Some(v1::Polygon { outer, holes: Vec::new() }),
        clearance_mm: 2.0,
        ..Default::default()
    };
    let rules = v1::RapidRules {
        cost: axis_speeds(100.0, 100.0),
        motion: v1::RapidMotion::DogLeg.into(),
        ..Default::default()
    };
    let request = v1::PlanRapidMoveRequest {
        scene: Some(scene),
        start: point(along.0 * -15.0, along.1 * -15.0),
        target: point(along.0 * 15.0, along.1 * 15.0),
        rules: Some(rules),
        validate_only: false,
    };
    let status = server.client().await.plan_rapid_move(request).await.expect_err("no room");
    let details = status.get_error_details();
    assert_eq!(details.error_info().expect("always").reason, "NO_ROOM_FOR_DOG_LEGS");
    assert_eq!(details.bad_request().expect("the rule").field_violations[0].field, "rules.motion");
}
