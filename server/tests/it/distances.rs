//! PlanDistances over the socket and as JSON.

use crate::bad_input::reason;
use crate::request::{PAST_A_BLOCK_MM, past_a_block};
use crate::running::Running;
use tonic::Code;
use tonic_types::StatusExt;
use traverse_proto::{Limits, v1};
use traverse_server::{Caller, Config, TraverseEngines};

fn request(from_xy_mm: &[f64], to_xy_mm: &[f64]) -> v1::PlanDistancesRequest {
    v1::PlanDistancesRequest {
        scene: past_a_block().scene,
        from_xy_mm: from_xy_mm.to_vec(),
        to_xy_mm: to_xy_mm.to_vec(),
        rules: None,
    }
}

fn fields(status: &tonic::Status) -> Vec<(String, String)> {
    let found = status.get_details_bad_request().map(|found| found.field_violations).unwrap_or_default();
    found.into_iter().map(|found| (found.field, found.reason)).collect()
}

#[tokio::test]
async fn a_matrix_is_answered() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let answer = client.plan_distances(request(&[-5.0, 2.0, 15.0, 2.0], &[])).await.expect("answered");
    let costs = answer.get_ref().costs.clone();
    assert_eq!(answer.get_ref().cost_unit(), v1::CostUnit::Mm);
    let expected = [0.0, PAST_A_BLOCK_MM, PAST_A_BLOCK_MM, 0.0];
    for (cost, expected) in costs.iter().zip(expected) {
        assert!((cost - expected).abs() < 1e-6, "{costs:?}");
    }
    let rows = client.plan_distances(request(&[-5.0, 2.0], &[15.0, 2.0, -5.0, 9.0])).await.expect("answered");
    assert_eq!(rows.get_ref().costs.len(), 2);
    assert_eq!(rows.get_ref().costs[1], 7.0);
}

#[tokio::test]
async fn no_way_is_infinity_in_json_too() {
    let caller =
        Caller::InProcess(Box::new(traverse_server::Server::new(Config::on_free_port()).expect("sound")));
    let text = r#"{"scene":{"work_area":{"outer":{"xy_mm":[0,0,100,0,100,100,0,100]}},
        "obstacles":[{"id":"wall","shape":{"outer":{"xy_mm":[40,0,60,0,60,100,40,100]}}}],"clearance_mm":1},
        "from_xy_mm":[10,50,90,50],"to_xy_mm":[20,50]}"#;
    let answer = caller.call("PlanDistances", text).await.expect("answered");
    let answer: serde_json::Value = serde_json::from_str(&answer).expect("JSON");
    assert_eq!(answer["costs"], serde_json::json!([10.0, "Infinity"]));
    assert_eq!(answer["costUnit"], "COST_UNIT_MM");
}

#[tokio::test]
async fn every_finding_names_its_number() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let status = client.plan_distances(request(&[0.0, f64::NAN, 1e9, 0.0], &[1.0])).await.expect_err("wrong");
    assert_eq!(status.code(), Code::InvalidArgument);
    let expected = [
        ("from_xy_mm[1]", "NOT_FINITE"),
        ("from_xy_mm[2]", "COORDINATE_TOO_LARGE"),
        ("to_xy_mm", "ODD_COORDINATE_COUNT"),
    ];
    assert_eq!(fields(&status), expected.map(|(field, reason)| (field.to_owned(), reason.to_owned())));
    let status = client.plan_distances(request(&[], &[])).await.expect_err("nothing is asked");
    assert_eq!(fields(&status), [("from_xy_mm".to_owned(), "MISSING_FIELD".to_owned())]);
    let inside = [-5.0, 2.0, 5.0, 5.0, 11.0, 5.0];
    let status = client.plan_distances(request(&inside, &[])).await.expect_err("two lie inside");
    assert_eq!(reason(&status), "END_INSIDE_BARRIER");
    let expected = ["from_xy_mm[2]", "from_xy_mm[4]"];
    assert_eq!(fields(&status).into_iter().map(|found| found.0).collect::<Vec<_>>(), expected);
    let status = client.plan_distances(request(&[-5.0, 2.0], &inside)).await.expect_err("two lie inside");
    assert_eq!(fields(&status)[0].0, "to_xy_mm[2]");
}

#[tokio::test]
async fn there_is_a_limit_of_costs() {
    let limits = Limits { distance_count: 8, ..Limits::default() };
    let server = Running::with(Config { limits, ..Config::on_free_port() }, TraverseEngines).await;
    let mut client = server.client().await;
    let points: Vec<f64> = (0..3).flat_map(|i| [-20.0, f64::from(i)]).collect();
    let status = client.plan_distances(request(&points, &[])).await.expect_err("nine costs");
    assert_eq!(fields(&status), [("from_xy_mm".to_owned(), "TOO_MANY".to_owned())]);
    client.plan_distances(request(&points, &points[..4])).await.expect("six costs");
}
