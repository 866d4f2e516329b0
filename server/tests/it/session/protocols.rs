//! Sessions over gRPC-Web and over Connect with JSON and protobuf, by good and bad callers.

use super::{one_block, past};
use crate::http::{post, send};
use crate::request::PAST_A_BLOCK;
use crate::running::Running;
use bytes::{BufMut, Bytes, BytesMut};
use http::StatusCode;
use prost::Message;
use traverse_proto::v1::plan_rapid_moves_request::Step;
use traverse_proto::v1::plan_rapid_moves_response::Outcome;
use traverse_proto::v1::{PlanRapidMovesRequest, PlanRapidMovesResponse};
use traverse_server::{CallError, Caller, Config, Server};

const PATH: &str = "/traverse.v1.PlannerService/PlanRapidMoves";

fn steps() -> Vec<Bytes> {
    let steps = [Step::Scene(one_block()), Step::Query(past()), Step::Query(past())];
    let steps = steps.into_iter().enumerate();
    let steps = steps.map(|(i, step)| PlanRapidMovesRequest { step_id: i.to_string(), step: Some(step) });
    steps.map(|step| step.encode_to_vec().into()).collect()
}

fn framed(flag: u8, message: &[u8]) -> Bytes {
    let mut frame = BytesMut::new();
    frame.put_u8(flag);
    frame.put_u32(message.len() as u32);
    frame.put_slice(message);
    frame.freeze()
}

/// Flags and messages of a body.
fn frames(mut body: &[u8]) -> Vec<(u8, &[u8])> {
    let mut frames = Vec::new();
    while let Some((&[flag, a, b, c, d], rest)) = body.split_first_chunk() {
        let (message, rest) = rest.split_at(u32::from_be_bytes([a, b, c, d]) as usize);
        frames.push((flag, message));
        body = rest;
    }
    assert!(body.is_empty(), "whole frames only");
    frames
}

fn reasons(answers: &[(u8, &[u8])]) -> Vec<String> {
    let reason = |message: &[u8]| match PlanRapidMovesResponse::decode(message).expect("an answer").outcome {
        Some(Outcome::Plan(_)) => "plan".to_owned(),
        Some(Outcome::SceneChanged(_)) => "changed".to_owned(),
        Some(Outcome::Problem(problem)) => problem.reason,
        other => format!("{other:?}"),
    };
    answers.iter().map(|&(_, message)| reason(message)).collect()
}

#[tokio::test]
async fn grpc_web_carries_sessions() {
    let server = Running::start().await;
    let body: Vec<Bytes> = steps().iter().map(|step| framed(0, step)).collect();
    let answer = send(server.address, post(PATH, "application/grpc-web+proto", body.concat())).await;
    assert_eq!(answer.status, StatusCode::OK);
    let frames = frames(&answer.body);
    let (trailers, answers) = frames.split_last().expect("trailers");
    assert_eq!(reasons(answers), ["changed", "plan", "plan"]);
    assert_eq!(trailers.0, 0x80);
    assert!(String::from_utf8_lossy(trailers.1).contains("grpc-status:0"));
}

#[tokio::test]
async fn connect_carries_sessions_with_protobuf() {
    let server = Running::start().await;
    let body: Vec<Bytes> = steps().iter().map(|step| framed(0, step)).collect();
    let answer = send(server.address, post(PATH, "application/connect+proto", body.concat())).await;
    assert_eq!(answer.headers["content-type"], "application/connect+proto");
    let frames = frames(&answer.body);
    let (end, answers) = frames.split_last().expect("an end");
    assert_eq!(reasons(answers), ["changed", "plan", "plan"]);
    assert_eq!(*end, (2, &b"{}"[..]));
}

#[tokio::test]
async fn bytes_that_are_no_step_fail_alone() {
    let server = Running::start().await;
    let steps = steps();
    let named = PlanRapidMovesRequest { step_id: "named".to_owned(), step: None }.encode_to_vec();
    // A scene whose bytes end too soon.
    let broken = [&named[..], &[0x12, 0x05, 0x0a, 0x7f, 0, 0, 0]].concat();
    let messages =
        [&steps[0][..], &steps[1], b"\xff\xff\xff", &steps[1], &steps[0], &broken, &steps[1], &steps[0]];
    let body: Vec<Bytes> = messages.iter().map(|message| framed(0, message)).collect();
    let answer = send(server.address, post(PATH, "application/connect+proto", body.concat())).await;
    let frames = frames(&answer.body);
    let (end, answers) = frames.split_last().expect("an end");
    let expected = [
        "changed",
        "plan",
        "MALFORMED_MESSAGE",
        "SCENE_STALE",
        "changed",
        "MALFORMED_MESSAGE",
        "SCENE_STALE",
        "changed",
    ];
    assert_eq!(reasons(answers), expected);
    assert_eq!(PlanRapidMovesResponse::decode(answers[5].1).expect("an answer").step_id, "named");
    assert_eq!(*end, (2, &b"{}"[..]));
}

#[tokio::test]
async fn what_is_no_frame_ends_the_session() {
    let limits = traverse_proto::Limits { message_bytes: 2048, ..Default::default() };
    let config = Config { limits, ..Config::on_free_port() };
    let server = Running::with(config, traverse_server::TraverseEngines).await;
    let scene = framed(0, &steps()[0]);
    for (rest, reason) in [
        (&[0, 0, 0, 9, 0][..], "MESSAGE_TOO_LARGE"),
        (&[1, 0, 0, 0, 0], "UNSUPPORTED_ENCODING"),
        (&[7, 0, 0, 0, 0], "MALFORMED_MESSAGE"),
        (&[0, 0, 0, 0, 9, 1, 2], "MALFORMED_MESSAGE"),
    ] {
        let body = [&scene[..], rest].concat();
        let answer = send(server.address, post(PATH, "application/connect+proto", body)).await;
        let frames = frames(&answer.body);
        let (end, answers) = frames.split_last().expect("an end");
        assert_eq!(reasons(answers), ["changed"], "what came before is answered");
        let text = String::from_utf8_lossy(end.1);
        assert!(end.0 == 2 && text.contains(reason), "{reason}: {text}");
    }
    let unary = send(server.address, post(PATH, "application/json", "{}")).await;
    assert_eq!(unary.status, StatusCode::UNSUPPORTED_MEDIA_TYPE);
}

async fn told(caller: &Caller, lines: &[&str]) -> (Vec<serde_json::Value>, Result<(), CallError>) {
    let lines: Vec<Bytes> = lines.iter().map(|line| Bytes::copy_from_slice(line.as_bytes())).collect();
    let mut answers = Vec::new();
    let answered = |text: &str| answers.push(serde_json::from_str(text).expect("JSON"));
    let ended = caller.session("PlanRapidMoves", tokio_stream::iter(lines), answered).await;
    (answers, ended)
}

#[tokio::test]
async fn lines_of_json_in_and_out_in_process_and_on_a_server() {
    let server = Running::start().await;
    let remote = Caller::remote(&format!("http://{}", server.address)).expect("an address");
    let here = Caller::InProcess(Box::new(Server::new(Config::on_free_port()).expect("sound")));
    let scene: serde_json::Value = serde_json::from_str(PAST_A_BLOCK).expect("JSON");
    let scene = serde_json::json!({"stepId": "1", "scene": scene["scene"]}).to_string();
    let query = r#"{"step_id":"2","query":{"start":{"x_mm":-5,"y_mm":2},"target":{"x_mm":15,"y_mm":2}}}"#;
    for caller in [&remote, &here] {
        let (answers, ended) =
            told(caller, &[&scene, query, r#"{"querry":{}}"#, query, "<html>", &scene, query]).await;
        assert_eq!(ended, Ok(()));
        let outcome = |answer: &serde_json::Value| match answer["problem"]["reason"].as_str() {
            Some(reason) => reason.to_owned(),
            None => ["plan", "sceneChanged"]
                .into_iter()
                .find(|name| answer.get(name).is_some())
                .unwrap_or("?")
                .to_owned(),
        };
        let outcomes: Vec<String> = answers.iter().map(outcome).collect();
        let expected = [
            "sceneChanged",
            "plan",
            "MALFORMED_JSON",
            "SCENE_STALE",
            "MALFORMED_JSON",
            "sceneChanged",
            "plan",
        ];
        assert_eq!(outcomes, expected);
        assert!(answers[2]["problem"]["message"].as_str().is_some_and(|text| text.contains("querry")));
        assert_eq!(answers[1]["stepId"], "2");
        assert!((answers[1]["plan"]["cost"].as_f64().expect("a number") - 24.772_546_673).abs() < 1e-6);
        let wrong_form = caller.call("PlanRapidMoves", "{}").await.unwrap_err();
        assert!(wrong_form.to_string().contains("session"), "{wrong_form}");
    }
    drop(remote);
}

/// Every step in a frame of its own, as fast as they go: HTTP/2 libraries take many small frames for an attack.
#[tokio::test]
async fn thousands_of_small_steps_are_all_answered() {
    const QUERIES: usize = 30_000;
    let server = Running::start().await;
    let remote = Caller::remote(&format!("http://{}", server.address)).expect("an address");
    let query = r#"{"query":{"start":{"x_mm":-5,"y_mm":2},"target":{"x_mm":15,"y_mm":2}}}"#;
    let mut lines = vec![query; QUERIES + 1];
    lines[0] = r#"{"scene":{}}"#;
    let (answers, ended) = told(&remote, &lines).await;
    assert_eq!((answers.len(), ended), (QUERIES + 1, Ok(())));
    assert!(answers[1..].iter().all(|answer| answer.get("plan").is_some()));
}
