//! JSON (and protobuf) over HTTP POST, as Connect specifies it.

use crate::http::{call, post, send};
use crate::request::{PAST_A_BLOCK, PAST_A_BLOCK_MM, past_a_block};
use crate::running::Running;
use http::{HeaderName, HeaderValue, Method, StatusCode, header};
use prost::Message;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use traverse_proto::v1;
use traverse_proto::v1::plan_rapid_move_response::Outcome;
use traverse_server::{CallError, Caller, Config, Server};

const PATH: &str = "/traverse.v1.PlannerService/PlanRapidMove";

#[tokio::test]
async fn curl_plans_a_move() {
    let server = Running::start().await;
    let answer = call(server.address, "PlanRapidMove", PAST_A_BLOCK).await;
    assert_eq!(answer.status, StatusCode::OK);
    assert_eq!(answer.headers[header::CONTENT_TYPE], "application/json");
    let plan = &answer.json()["plan"];
    let cost = plan["cost"].as_f64().expect("a number");
    assert!((cost - PAST_A_BLOCK_MM).abs() < 1e-6, "{plan}");
    assert_eq!(plan["costUnit"], "COST_UNIT_MM");
    let arc = plan["path"]["steps"].as_array().expect("steps").iter().find_map(|step| step.get("arc"));
    assert!(arc.expect("a round corner")["clockwise"].is_boolean(), "false is written out: {plan}");
    assert!(answer.json()["stats"]["expandedNodeCount"].is_string(), "64-bit integers are strings");
}

#[tokio::test]
async fn protobuf_over_post_is_the_same_call() {
    let server = Running::start().await;
    let answer = send(server.address, post(PATH, "application/proto", past_a_block().encode_to_vec())).await;
    assert_eq!(
        (answer.status, &answer.headers[header::CONTENT_TYPE]),
        (StatusCode::OK, &HeaderValue::from_static("application/proto"))
    );
    let message = v1::PlanRapidMoveResponse::decode(answer.body).expect("the answer");
    assert!(matches!(message.outcome, Some(Outcome::Plan(_))));
}

#[tokio::test]
async fn errors_are_connects() {
    let server = Running::start().await;
    let answer = call(server.address, "PlanRapidMove", r#"{"start":{"x_mm":"NaN"}}"#).await;
    assert_eq!(answer.status, StatusCode::BAD_REQUEST);
    assert_eq!(answer.json()["code"], "invalid_argument");
    assert_eq!(answer.reason(), "INVALID_REQUEST");
    let violations = answer.detail("google.rpc.BadRequest")["fieldViolations"].clone();
    let fields: Vec<&str> =
        violations.as_array().expect("a list").iter().filter_map(|v| v["field"].as_str()).collect();
    assert_eq!(fields, ["start.x_mm", "target"]);
    let value = answer.json()["details"][0]["value"].as_str().expect("encoded").to_owned();
    assert!(!value.contains('='), "no padding: {value}");
}

#[tokio::test]
async fn what_is_no_call_is_answered_as_the_protocol_says() {
    let server = Running::start().await;
    let unknown =
        send(server.address, post("/traverse.v1.PlannerService/Nothing", "application/json", "{}")).await;
    assert_eq!(
        (unknown.status, unknown.json()["code"].as_str()),
        (StatusCode::NOT_FOUND, Some("unimplemented"))
    );
    let mut get = post(PATH, "application/json", "");
    *get.method_mut() = Method::GET;
    let get = send(server.address, get).await;
    assert_eq!(
        (get.status, &get.headers[header::ALLOW]),
        (StatusCode::METHOD_NOT_ALLOWED, &HeaderValue::from_static("POST"))
    );
    let form = send(server.address, post(PATH, "application/x-www-form-urlencoded", PAST_A_BLOCK)).await;
    assert_eq!(form.status, StatusCode::UNSUPPORTED_MEDIA_TYPE);
    assert!(form.headers["accept-post"].to_str().expect("text").contains("application/json"));
}

#[tokio::test]
async fn headers_of_the_protocol_are_read() {
    let server = Running::start().await;
    let with = |name: &'static str, value: &'static str| {
        let mut request = post(PATH, "application/json; charset=utf-8", PAST_A_BLOCK);
        request.headers_mut().insert(HeaderName::from_static(name), HeaderValue::from_static(value));
        send(server.address, request)
    };
    assert_eq!(with("connect-protocol-version", "1").await.status, StatusCode::OK);
    assert_eq!(with("connect-protocol-version", "2").await.reason(), "MALFORMED_HEADER");
    assert_eq!(with("connect-timeout-ms", "60000").await.status, StatusCode::OK);
    assert_eq!(with("connect-timeout-ms", "soon").await.reason(), "MALFORMED_HEADER");
    assert_eq!(with("content-encoding", "identity").await.status, StatusCode::OK);
    let compressed = with("content-encoding", "gzip").await;
    assert_eq!(
        (compressed.status, compressed.reason().as_str()),
        (StatusCode::NOT_IMPLEMENTED, "UNSUPPORTED_ENCODING")
    );
}

#[tokio::test]
async fn a_caller_gets_the_same_in_process_and_from_a_server() {
    let server = Running::start().await;
    let here = Caller::InProcess(Box::new(Server::new(Config::on_free_port()).expect("sound")));
    let there = Caller::remote(&format!("http://{}", server.address)).expect("an address");
    for caller in [&here, &there] {
        let answer = caller.call("PlanRapidMove", PAST_A_BLOCK).await.expect("sound");
        assert!(answer.contains(r#""costUnit":"COST_UNIT_MM""#), "{answer}");
        let Err(CallError::Refused { code, body, .. }) = caller.call("PlanRapidMove", "{}").await else {
            panic!("no ends")
        };
        assert_eq!(code, "invalid_argument");
        assert!(body.contains("MISSING_FIELD"), "{body}");
        assert!(matches!(caller.call("Nothing", "{}").await, Err(CallError::UnknownMethod { .. })));
    }
    assert!(matches!(Caller::remote("ftp://x"), Err(CallError::Address { .. })));
    let nobody = Caller::remote("127.0.0.1:1").expect("an address");
    assert!(matches!(nobody.call("GetLimits", "{}").await, Err(CallError::Unreachable { .. })));
}

/// The first line of the answer to a GET with a header of that many bytes.
async fn status_line(server: &Running, header_bytes: usize) -> String {
    let mut stream = tokio::net::TcpStream::connect(server.address).await.expect("it listens");
    let head = format!("GET / HTTP/1.1\r\nhost: localhost\r\nx: {}\r\n\r\n", "x".repeat(header_bytes));
    // The server may answer and close before it has read all.
    stream.write_all(head.as_bytes()).await.ok();
    let mut answer = Vec::new();
    stream.read_buf(&mut answer).await.ok();
    String::from_utf8_lossy(&answer).lines().next().unwrap_or_default().to_owned()
}

#[tokio::test]
async fn heads_of_http_1_are_bounded() {
    let server = Running::start().await;
    assert!(!status_line(&server, 12 << 10).await.contains(" 431 "));
    assert!(
        status_line(&server, 17 << 10).await.contains(" 431 "),
        "{}",
        status_line(&server, 17 << 10).await
    );
    // Bodies are longer than what is read at once.
    let scene = format!("{}{}", PAST_A_BLOCK, " ".repeat(100_000));
    assert_eq!(call(server.address, "PlanRapidMove", scene).await.status, StatusCode::OK);
}
