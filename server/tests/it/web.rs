//! gRPC-Web over HTTP/1.1, from another origin.

use crate::http::{post, send};
use crate::request::{PAST_A_BLOCK_MM, past_a_block};
use crate::running::Running;
use bytes::{BufMut, Bytes, BytesMut};
use http::{HeaderValue, Method, StatusCode, header};
use prost::Message;
use traverse_proto::v1::PlanRapidMoveResponse;
use traverse_proto::v1::plan_rapid_move_response::Outcome;

const PATH: &str = "/traverse.v1.PlannerService/PlanRapidMove";
const ORIGIN: HeaderValue = HeaderValue::from_static("https://cam.example");

pub(crate) fn framed(message: &[u8]) -> Bytes {
    let mut frame = BytesMut::new();
    frame.put_u8(0);
    frame.put_u32(message.len() as u32);
    frame.put_slice(message);
    frame.freeze()
}

#[tokio::test]
async fn a_page_of_another_origin_plans_a_move() {
    let server = Running::start().await;
    let mut request = post(PATH, "application/grpc-web+proto", framed(&past_a_block().encode_to_vec()));
    request.headers_mut().insert(header::ORIGIN, ORIGIN);
    let answer = send(server.address, request).await;
    assert_eq!(answer.status, StatusCode::OK);
    assert_eq!(answer.headers[header::ACCESS_CONTROL_ALLOW_ORIGIN], "*");
    let length =
        u32::from_be_bytes([answer.body[1], answer.body[2], answer.body[3], answer.body[4]]) as usize;
    let message = PlanRapidMoveResponse::decode(&answer.body[5..5 + length]).expect("the answer");
    let Some(Outcome::Plan(plan)) = message.outcome else { panic!("{message:?}") };
    assert!((plan.cost - PAST_A_BLOCK_MM).abs() < 1e-6);
    let trailers = String::from_utf8_lossy(&answer.body[5 + length + 5..]);
    assert!(trailers.contains("grpc-status:0"), "{trailers}");
}

#[tokio::test]
async fn errors_are_exposed_to_pages() {
    let server = Running::start().await;
    let mut request = post(PATH, "application/grpc-web+proto", framed(&[]));
    request.headers_mut().insert(header::ORIGIN, ORIGIN);
    let answer = send(server.address, request).await;
    assert_eq!(answer.headers["grpc-status"], "3");
    let exposed = answer.headers[header::ACCESS_CONTROL_EXPOSE_HEADERS].to_str().expect("text").to_owned();
    for name in ["grpc-status", "grpc-message", "grpc-status-details-bin"] {
        assert!(exposed.contains(name), "{exposed}");
        assert!(answer.headers.contains_key(name), "{name}");
    }
}

#[tokio::test]
async fn a_preflight_is_welcome() {
    let server = Running::start().await;
    let mut request = post(PATH, "text/plain", "");
    *request.method_mut() = Method::OPTIONS;
    request.headers_mut().insert(header::ORIGIN, ORIGIN);
    request.headers_mut().insert(header::ACCESS_CONTROL_REQUEST_METHOD, HeaderValue::from_static("POST"));
    let asked = HeaderValue::from_static("content-type,x-grpc-web,connect-protocol-version");
    request.headers_mut().insert(header::ACCESS_CONTROL_REQUEST_HEADERS, asked);
    let answer = send(server.address, request).await;
    assert_eq!(answer.status, StatusCode::OK);
    assert_eq!(answer.headers[header::ACCESS_CONTROL_ALLOW_METHODS], "POST");
    assert_eq!(answer.headers[header::ACCESS_CONTROL_ALLOW_HEADERS], "*");
}
