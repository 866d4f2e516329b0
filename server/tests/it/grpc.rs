//! gRPC: the calls, health, reflection.

use crate::request::{PAST_A_BLOCK_MM, obstacle, past_a_block, point, square};
use crate::running::Running;
use tokio_stream::StreamExt;
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;
use traverse_proto::v1::plan_rapid_move_response::Outcome;
use traverse_proto::v1::{self, GetLimitsRequest};

#[tokio::test]
async fn a_rapid_move_is_planned_and_its_check_finds_it_sound() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let request = past_a_block();
    let answer = client.plan_rapid_move(request.clone()).await.expect("sound").into_inner();
    let Some(Outcome::Plan(plan)) = answer.outcome else { panic!("{answer:?}") };
    assert!((plan.cost - PAST_A_BLOCK_MM).abs() < 1e-6, "{}", plan.cost);
    assert_eq!(plan.cost, plan.lower_bound);
    assert_eq!(plan.cost_unit(), v1::CostUnit::Mm);
    assert_eq!(plan.bending_obstacle_ids, ["block"]);
    let stats = answer.stats.expect("told");
    assert!(stats.barrier_vertex_count > 0 && stats.search_duration.is_some());

    let check = v1::CheckRapidMoveRequest { request: Some(request), path: plan.path, tolerance_mm: None };
    let found = client.check_rapid_move(check).await.expect("sound").into_inner();
    assert_eq!(found.violations, []);
    assert!((found.cost - plan.cost).abs() < 1e-9);
}

#[tokio::test]
async fn a_path_through_an_obstacle_is_reported() {
    let server = Running::start().await;
    let step = v1::PathStep { end: point(15.0, 2.0), arc: None, ..Default::default() };
    let path = v1::Path { start: point(-5.0, 2.0), steps: vec![step], length_mm: 0.0, start_z_mm: None };
    let check =
        v1::CheckRapidMoveRequest { request: Some(past_a_block()), path: Some(path), tolerance_mm: None };
    let found = server.client().await.check_rapid_move(check).await.expect("sound").into_inner();
    let [violation] = found.violations.as_slice() else { panic!("{found:?}") };
    assert_eq!((violation.field.as_str(), violation.obstacle_id.as_str()), ("path.steps[0]", "block"));
    assert!((found.cost - 20.0).abs() < 1e-9);
}

#[tokio::test]
async fn an_enclosed_target_is_an_answer() {
    let server = Running::start().await;
    let mut wall = square(-20.0, -20.0, 40.0);
    wall.holes.extend(square(-10.0, -10.0, 20.0).outer);
    let request = v1::PlanRapidMoveRequest {
        scene: Some(v1::Scene {
            obstacles: vec![obstacle("wall", wall)],
            clearance_mm: 1.0,
            ..Default::default()
        }),
        start: point(0.0, 0.0),
        target: point(50.0, 0.0),
        ..Default::default()
    };
    let answer = server.client().await.plan_rapid_move(request).await.expect("an answer").into_inner();
    let Some(Outcome::NoPath(no_path)) = answer.outcome else { panic!("{answer:?}") };
    assert_eq!(no_path.separating_obstacle_ids, ["wall"]);
}

#[tokio::test]
async fn validation_alone_has_no_outcome_and_still_refuses() {
    let server = Running::start().await;
    let mut client = server.client().await;
    let request = v1::PlanRapidMoveRequest { validate_only: true, ..past_a_block() };
    let answer = client.plan_rapid_move(request.clone()).await.expect("sound").into_inner();
    assert_eq!(answer, v1::PlanRapidMoveResponse { outcome: None, stats: None });
    let inside = v1::PlanRapidMoveRequest { start: point(5.0, 5.0), ..request };
    let status = client.plan_rapid_move(inside).await.expect_err("start lies inside");
    assert_eq!(status.code(), tonic::Code::InvalidArgument, "{status}");
}

#[tokio::test]
async fn limits_are_told() {
    let server = Running::start().await;
    let limits = server.client().await.get_limits(GetLimitsRequest {}).await.expect("told").into_inner();
    assert_eq!(limits.server_version, env!("CARGO_PKG_VERSION"));
    assert!(limits.message_bytes > 0 && limits.vertex_count > 0 && limits.default_time_limit.is_some());
}

#[tokio::test]
async fn health_says_serving() {
    let server = Running::start().await;
    let mut health = HealthClient::new(server.channel().await);
    for service in ["", "traverse.v1.PlannerService"] {
        let request = HealthCheckRequest { service: service.to_owned() };
        let answer = health.check(request).await.expect("an answer").into_inner();
        assert_eq!(answer.status(), ServingStatus::Serving, "{service}");
    }
}

#[tokio::test]
async fn a_call_that_does_not_exist_is_refused_with_its_reason() {
    let server = Running::start().await;
    let mut grpc = tonic::client::Grpc::new(server.channel().await);
    grpc.ready().await.expect("connected");
    let codec = traverse_proto::codec::WireCodec::<GetLimitsRequest, v1::GetLimitsResponse>::default();
    let path = http::uri::PathAndQuery::from_static("/traverse.v1.PlannerService/PlanEverything");
    let status =
        grpc.unary(tonic::Request::new(GetLimitsRequest {}), path, codec).await.expect_err("there is none");
    assert_eq!(status.code(), tonic::Code::Unimplemented);
    assert_eq!(crate::bad_input::reason(&status), "UNKNOWN_METHOD");
}

macro_rules! reflection_test {
    ($name:ident, $version:ident) => {
        #[tokio::test]
        async fn $name() {
            use tonic_reflection::pb::$version::ServerReflectionRequest;
            use tonic_reflection::pb::$version::server_reflection_client::ServerReflectionClient;
            use tonic_reflection::pb::$version::server_reflection_request::MessageRequest;
            use tonic_reflection::pb::$version::server_reflection_response::MessageResponse;
            let server = Running::start().await;
            let mut client = ServerReflectionClient::new(server.channel().await);
            let list = MessageRequest::ListServices(String::new());
            let list = ServerReflectionRequest { host: String::new(), message_request: Some(list) };
            let stream = client.server_reflection_info(tokio_stream::once(list)).await.expect("served");
            let answer = stream.into_inner().next().await.expect("one answer").expect("sound");
            let Some(MessageResponse::ListServicesResponse(list)) = answer.message_response else {
                panic!("{answer:?}")
            };
            let mut names: Vec<String> = list.service.into_iter().map(|service| service.name).collect();
            names.sort();
            let own = ["grpc.health.v1.Health", "traverse.v1.PlannerService"];
            assert!(own.iter().all(|name| names.iter().any(|found| found == name)), "{names:?}");
        }
    };
}

reflection_test!(reflection_v1_lists_the_services, v1);
reflection_test!(reflection_v1alpha_lists_the_services, v1alpha);
