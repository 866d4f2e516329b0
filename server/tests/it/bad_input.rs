//! Whatever arrives gets a status that names field and value and says what to do.

use crate::http::{call, post, send};
use crate::request::{obstacle, past_a_block, point, square, with_time_limit};
use crate::running::Running;
use crate::web::framed;
use prost::Message;
use tonic::{Code, Status};
use tonic_types::StatusExt;
use traverse_proto::{Limits, v1};
use traverse_server::{Config, TraverseEngines};

pub(crate) fn reason(status: &Status) -> String {
    status.get_details_error_info().map(|info| info.reason).unwrap_or_default()
}

/// Field and reason of every finding.
pub(crate) fn findings(status: &Status) -> Vec<(String, String)> {
    let violations =
        status.get_details_bad_request().map(|request| request.field_violations).unwrap_or_default();
    violations.into_iter().map(|violation| (violation.field, violation.reason)).collect()
}

pub(crate) fn found(expected: &[(&str, &str)]) -> Vec<(String, String)> {
    expected.iter().map(|&(field, reason)| (field.to_owned(), reason.to_owned())).collect()
}

#[tokio::test]
async fn every_finding_comes_at_once() {
    let server = Running::start().await;
    let ring = |xy_mm: Vec<f64>| Some(v1::Ring { xy_mm, bulges: vec![] });
    let polygon = |xy_mm| v1::Polygon { outer: ring(xy_mm), holes: vec![] };
    let mut negative = obstacle("g", square(0.0, 0.0, 1.0));
    negative.clearance_mm = Some(-1.0);
    negative.top_z_mm = Some(f64::NAN);
    let obstacles = vec![
        obstacle("a", polygon(vec![0.0, 0.0, 1e308, 0.0, f64::NAN, 1.0])),
        obstacle("a", square(20.0, 0.0, 1.0)),
        obstacle("", polygon(vec![0.0, 0.0, 1.0, 0.0, 1.0])),
        obstacle("work_area", polygon(vec![0.0, 0.0, 4.0, 4.0, 4.0, 0.0, 0.0, 2.0])),
        v1::Obstacle { id: "e".to_owned(), ..Default::default() },
        obstacle("f", v1::Polygon::default()),
        negative,
    ];
    let request = v1::PlanRapidMoveRequest {
        scene: Some(v1::Scene {
            obstacles,
            clearance_mm: f64::INFINITY,
            corner_style: 7,
            miter_limit: Some(0.5),
            work_area: Some(polygon(vec![])),
            ..Default::default()
        }),
        start: point(f64::NAN, 2e6),
        target: None,
        rules: Some(v1::RapidRules {
            algorithm: -3,
            options: Some(v1::SolveOptions {
                time_limit: Some(prost_types::Duration { seconds: -1, nanos: 0 }),
                iteration_limit: -5,
                ..Default::default()
            }),
            heights: Some(v1::HeightRule {
                start_z_mm: f64::NAN,
                clearance_z_mm: -2.0,
                ..Default::default()
            }),
            clearances_mm: vec![2.0, 3.0, -1.0],
            leave: Some(v1::EndRule { rule: Some(v1::end_rule::Rule::Direction(v1::Point::default())) }),
            ..Default::default()
        }),
        validate_only: false,
    };
    let status = server.client().await.plan_rapid_move(request).await.expect_err("all of it is wrong");
    assert_eq!((status.code(), reason(&status).as_str()), (Code::InvalidArgument, "INVALID_REQUEST"));
    let findings = findings(&status);
    for expected in found(&[
        ("start.x_mm", "NOT_FINITE"),
        ("start.y_mm", "COORDINATE_TOO_LARGE"),
        ("target", "MISSING_FIELD"),
        ("rules.algorithm", "UNKNOWN_ENUM_VALUE"),
        ("rules.options.time_limit", "OUT_OF_RANGE"),
        ("rules.options.iteration_limit", "OUT_OF_RANGE"),
        ("rules.heights.start_z_mm", "NOT_FINITE"),
        ("rules.heights.clearance_z_mm", "OUT_OF_RANGE"),
        ("rules.clearances_mm[1]", "OUT_OF_RANGE"),
        ("rules.clearances_mm[2]", "OUT_OF_RANGE"),
        ("rules.leave.direction", "OUT_OF_RANGE"),
        ("scene.obstacles[6].top_z_mm", "NOT_FINITE"),
        ("scene.clearance_mm", "NOT_FINITE"),
        ("scene.corner_style", "UNKNOWN_ENUM_VALUE"),
        ("scene.miter_limit", "OUT_OF_RANGE"),
        ("scene.work_area.outer.xy_mm", "TOO_FEW_VERTICES"),
        ("scene.obstacles[0].shape.outer.xy_mm[2]", "COORDINATE_TOO_LARGE"),
        ("scene.obstacles[0].shape.outer.xy_mm[4]", "NOT_FINITE"),
        ("scene.obstacles[1].id", "DUPLICATE_ID"),
        ("scene.obstacles[2].id", "MISSING_FIELD"),
        ("scene.obstacles[2].shape.outer.xy_mm", "ODD_COORDINATE_COUNT"),
        ("scene.obstacles[3].id", "OUT_OF_RANGE"),
        ("scene.obstacles[3].shape.outer.xy_mm", "EDGES_CROSS"),
        ("scene.obstacles[4].shape", "MISSING_FIELD"),
        ("scene.obstacles[5].shape.outer", "MISSING_FIELD"),
        ("scene.obstacles[6].clearance_mm", "OUT_OF_RANGE"),
    ]) {
        assert!(findings.contains(&expected), "{expected:?} is not in {findings:#?}");
    }
}

#[tokio::test]
async fn an_empty_request_says_what_is_missing() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let plan = client.plan_rapid_move(v1::PlanRapidMoveRequest::default()).await.expect_err("empty");
    assert_eq!(findings(&plan), found(&[("start", "MISSING_FIELD"), ("target", "MISSING_FIELD")]));
    assert!(plan.message().contains("start"), "{plan}");
    let check = client.check_rapid_move(v1::CheckRapidMoveRequest::default()).await.expect_err("empty");
    assert_eq!(findings(&check), found(&[("path", "MISSING_FIELD"), ("request", "MISSING_FIELD")]));
}

#[tokio::test]
async fn a_path_to_check_is_validated_too() {
    let server = Running::start().await;
    let arc = v1::Arc { center: point(f64::NAN, 0.0), clockwise: true, sweep_rad: -1.0 };
    let steps = vec![
        v1::PathStep { z_mm: Some(1e9), ..Default::default() },
        v1::PathStep { end: point(0.0, 0.0), arc: Some(arc), ..Default::default() },
        v1::PathStep {
            end: point(0.0, 0.0),
            arc: Some(v1::Arc { sweep_rad: 7.0, ..Default::default() }),
            ..Default::default()
        },
    ];
    let check = v1::CheckRapidMoveRequest {
        request: Some(v1::PlanRapidMoveRequest { start: None, ..past_a_block() }),
        path: Some(v1::Path { start: None, steps, length_mm: f64::NAN, start_z_mm: Some(f64::NAN) }),
        tolerance_mm: Some(0.0),
    };
    let status = server.client().await.check_rapid_move(check).await.expect_err("all of it is wrong");
    let expected = found(&[
        ("path.start", "MISSING_FIELD"),
        ("path.start_z_mm", "NOT_FINITE"),
        ("path.steps[0].end", "MISSING_FIELD"),
        ("path.steps[0].z_mm", "COORDINATE_TOO_LARGE"),
        ("path.steps[1].arc.center.x_mm", "NOT_FINITE"),
        ("path.steps[1].arc.sweep_rad", "OUT_OF_RANGE"),
        ("path.steps[2].arc.center", "MISSING_FIELD"),
        ("path.steps[2].arc.sweep_rad", "OUT_OF_RANGE"),
        ("tolerance_mm", "OUT_OF_RANGE"),
        ("request.start", "MISSING_FIELD"),
    ]);
    let mut findings = findings(&status);
    assert_eq!(findings.len(), expected.len(), "{findings:#?}");
    findings.retain(|finding| !expected.contains(finding));
    assert_eq!(findings, []);
}

#[tokio::test]
async fn ends_inside_barriers_are_refused_with_obstacle_and_depth() {
    let server = Running::start().await;
    let request =
        v1::PlanRapidMoveRequest { start: point(5.0, 9.0), target: point(12.0, 5.0), ..past_a_block() };
    let status = server.client().await.plan_rapid_move(request).await.expect_err("both lie inside");
    assert_eq!((status.code(), reason(&status).as_str()), (Code::InvalidArgument, "END_INSIDE_BARRIER"));
    let inside = "END_INSIDE_BARRIER";
    assert_eq!(findings(&status), found(&[("start", inside), ("target", inside)]));
    let metadata = status.get_details_error_info().expect("there").metadata;
    assert_eq!(metadata["obstacle_id"], "block");
    let depth: f64 = metadata["depth_mm"].parse().expect("a number");
    assert!((depth - 4.0).abs() < 1e-9, "{depth}");
}

#[tokio::test]
async fn an_end_that_is_shut_in_is_refused_with_why() {
    let server = Running::start().await;
    let towards_it =
        v1::EndRule { rule: Some(v1::end_rule::Rule::Direction(v1::Point { x_mm: 1.0, y_mm: 0.0 })) };
    let rules = v1::RapidRules { leave: Some(towards_it), ..Default::default() };
    let request = v1::PlanRapidMoveRequest {
        start: point(-1.0, 5.0),
        target: point(5.0, -2.0),
        rules: Some(rules),
        ..past_a_block()
    };
    let status = server.client().await.plan_rapid_move(request).await.expect_err("into the block");
    assert_eq!((status.code(), reason(&status).as_str()), (Code::InvalidArgument, "END_SHUT_IN"));
    assert_eq!(findings(&status), found(&[("start", "END_SHUT_IN"), ("target", "END_INSIDE_BARRIER")]));
    let metadata = status.get_details_error_info().expect("there").metadata;
    assert_eq!((metadata["obstacle_id"].as_str(), metadata["field"].as_str()), ("block", "start"));
    assert!(metadata["why"].contains("crosses an obstacle"), "{metadata:?}");
}

#[tokio::test]
async fn the_published_scan_says_what_it_does_not_cover() {
    let server = Running::start().await;
    let rules =
        v1::RapidRules { algorithm: v1::RapidAlgorithm::SupportingLines.into(), ..Default::default() };
    let request = v1::PlanRapidMoveRequest { rules: Some(rules), ..past_a_block() };
    let status = server.client().await.plan_rapid_move(request).await.expect_err("round corners");
    assert_eq!(reason(&status), "PUBLISHED_METHOD_NOT_APPLICABLE");
    assert_eq!(findings(&status), found(&[("rules.algorithm", "PUBLISHED_METHOD_NOT_APPLICABLE")]));
}

#[tokio::test]
async fn a_million_wrong_numbers_make_a_small_answer() {
    let server = Running::start().await;
    let ring = v1::Ring { xy_mm: vec![f64::NAN; 400_000], bulges: vec![] };
    let shape = v1::Polygon { outer: Some(ring), holes: vec![v1::Ring::default(); 1000] };
    let scene = v1::Scene { obstacles: vec![obstacle("a", shape)], ..Default::default() };
    let request = v1::PlanRapidMoveRequest { scene: Some(scene), ..past_a_block() };
    let status = server.client().await.plan_rapid_move(request).await.expect_err("wrong");
    assert_eq!(reason(&status), "INVALID_REQUEST");
    assert!(status.details().len() < 6 * 1024, "{}", status.details().len());
    let omitted = &status.get_details_error_info().expect("there").metadata["findings_omitted"];
    assert!(omitted.parse::<usize>().expect("a count") > 10, "{omitted}");
}

fn small() -> Config {
    let limits = Limits {
        message_bytes: 4096,
        vertex_count: 10,
        obstacle_count: 3,
        step_count: 2,
        ..Limits::default()
    };
    Config { limits, ..Config::on_free_port() }
}

#[tokio::test]
async fn counts_beyond_the_limits_are_named() {
    let server = Running::with(small(), TraverseEngines).await;
    let mut client = server.client().await;
    let refused = async |client: &mut v1::planner_service_client::PlannerServiceClient<_>, count: usize| {
        let obstacles =
            (0..count).map(|i| obstacle(&format!("o{i}"), square(9.0 * i as f64, 0.0, 1.0))).collect();
        let scene = v1::Scene { obstacles, ..Default::default() };
        let request = v1::PlanRapidMoveRequest { scene: Some(scene), ..past_a_block() };
        client.plan_rapid_move(request).await.expect_err("too many")
    };
    assert_eq!(findings(&refused(&mut client, 3).await), found(&[("scene", "TOO_MANY")]));
    assert_eq!(findings(&refused(&mut client, 4).await), found(&[("scene.obstacles", "TOO_MANY")]));
    let steps = vec![v1::PathStep { end: point(0.0, 0.0), arc: None, ..Default::default() }; 3];
    let path = v1::Path { start: point(0.0, 0.0), steps, length_mm: 0.0, start_z_mm: None };
    let check =
        v1::CheckRapidMoveRequest { request: Some(past_a_block()), path: Some(path), tolerance_mm: None };
    let status = client.check_rapid_move(check).await.expect_err("too many");
    assert_eq!(findings(&status), found(&[("path.steps", "TOO_MANY")]));
}

#[tokio::test]
async fn oversized_requests_are_refused_with_the_limit_in_every_protocol() {
    let server = Running::with(small(), TraverseEngines).await;
    let xy_mm = vec![0.0; 100_000];
    let shape = v1::Polygon { outer: Some(v1::Ring { xy_mm, bulges: vec![] }), holes: vec![] };
    let scene = v1::Scene { obstacles: vec![obstacle("a", shape)], ..Default::default() };
    let request = v1::PlanRapidMoveRequest { scene: Some(scene), ..past_a_block() };
    let status = server.client().await.plan_rapid_move(request.clone()).await.expect_err("too large");
    assert_eq!(
        (status.code(), reason(&status).as_str()),
        (Code::ResourceExhausted, "MESSAGE_TOO_LARGE"),
        "{status}"
    );
    assert_eq!(status.get_details_error_info().expect("there").metadata["limit_bytes"], "4096");

    let bytes = request.encode_to_vec();
    let path = "/traverse.v1.PlannerService/PlanRapidMove";
    let web = send(server.address, post(path, "application/grpc-web+proto", framed(&bytes))).await;
    assert_eq!(web.headers["grpc-status"], "8");
    let json = call(server.address, "PlanRapidMove", format!("{{}}{}", " ".repeat(5000))).await;
    assert_eq!((json.status.as_u16(), json.reason().as_str()), (429, "MESSAGE_TOO_LARGE"));
    let proto = send(server.address, post(path, "application/proto", bytes)).await;
    assert_eq!(proto.reason(), "MESSAGE_TOO_LARGE");
}

#[tokio::test]
async fn bytes_that_are_no_message_are_the_callers_fault() {
    let server = Running::start().await;
    let path = "/traverse.v1.PlannerService/PlanRapidMove";
    let whole = past_a_block().encode_to_vec();
    let cut = whole[..whole.len() - 3].to_vec();
    let bad_messages =
        [vec![0xff; 64], cut, b"<!doctype html>".to_vec(), vec![0x0a, 0xff, 0xff, 0xff, 0xff, 0x0f]];
    for message in bad_messages {
        let answer = send(server.address, post(path, "application/proto", message.clone())).await;
        assert_eq!(
            (answer.status.as_u16(), answer.reason().as_str()),
            (400, "MALFORMED_MESSAGE"),
            "{message:?}"
        );
        let answer = send(server.address, post(path, "application/grpc-web+proto", framed(&message))).await;
        assert_eq!(answer.headers["grpc-status"], "3", "{message:?}");
    }
    let frame = framed(&whole);
    let bad_frames = [
        &b""[..],
        b"\0",
        b"<html></html>",
        &frame[..frame.len() - 1],
        &[frame.to_vec(), frame.to_vec()].concat(),
    ];
    for frame in bad_frames {
        let answer = send(server.address, post(path, "application/grpc-web+proto", frame.to_vec())).await;
        assert_eq!(answer.headers["grpc-status"], "3", "{frame:?}");
    }
    let compressed =
        send(server.address, post(path, "application/grpc-web+proto", &b"\x01\0\0\0\x01x"[..])).await;
    assert_eq!(compressed.headers["grpc-status"], "12");
}

#[tokio::test]
async fn text_that_is_not_the_requests_json_is_named_with_its_place() {
    let server = Running::start().await;
    for (text, expected) in [
        (&b"<html>"[..], "line 1"),
        (b"", "EOF"),
        (b"[]", "expected"),
        (b"{\"scene\":{\"obstacle\":[]}}", "obstacle"),
        (b"{\"start\":{\"x_mm\":\"1,5\"}}", "start.x_mm"),
        (b"{\"start\":{\"x_mm\":1e400}}", "out of range"),
        (b"{\"rules\":{\"algorithm\":\"RAPID_ALGORITHM_MAGIC\"}}", "RAPID_ALGORITHM_MAGIC"),
        (b"{\"scene\":\"\xff\xfe\"}", "scene"),
    ] {
        let answer = call(server.address, "PlanRapidMove", text).await;
        assert_eq!((answer.status.as_u16(), answer.reason().as_str()), (400, "MALFORMED_JSON"), "{text:?}");
        let message = answer.json()["message"].as_str().expect("text").to_owned();
        assert!(message.contains(expected), "{message}");
    }
    let deep = format!("{}{}", "{\"scene\":".repeat(100_000), "}".repeat(100_000));
    assert_eq!(call(server.address, "PlanRapidMove", deep).await.reason(), "MALFORMED_JSON");
}

#[tokio::test]
async fn a_timeout_header_that_is_none_is_refused() {
    let server = Running::start().await;
    let mut request = tonic::Request::new(with_time_limit(5, 0));
    request.metadata_mut().insert("grpc-timeout", "soon".parse().expect("ascii"));
    let status = server.client().await.plan_rapid_move(request).await.expect_err("no timeout");
    assert_eq!(
        (status.code(), reason(&status).as_str()),
        (Code::InvalidArgument, "MALFORMED_HEADER"),
        "{status}"
    );
}
