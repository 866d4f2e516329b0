//! gRPC statuses as Connect errors: a code by name, HTTP's status for it, details encoded and readable.

use base64::Engine;
use base64::prelude::BASE64_STANDARD_NO_PAD;
use http::StatusCode;
use prost::Message;
use serde_json::value::RawValue;
use tonic::{Code, Status};
use traverse_proto::json::error_detail_to_json;

/// The body of a Connect error.
pub(super) fn error_body(status: &Status) -> Vec<u8> {
    let error =
        Error { code: name(status.code()), message: status.message(), details: details(status.details()) };
    serde_json::to_vec(&error).unwrap_or_else(|_| br#"{"code":"internal"}"#.to_vec())
}

/// The message that ends a streaming call: empty, or with the error.
pub(crate) fn end_of_stream(status: &Status) -> Vec<u8> {
    if status.code() == Code::Ok {
        return b"{}".to_vec();
    }
    [&br#"{"error":"#[..], &error_body(status), b"}"].concat()
}

#[derive(serde::Serialize)]
struct Error<'a> {
    code: &'static str,
    message: &'a str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    details: Vec<Detail>,
}

#[derive(serde::Serialize)]
struct Detail {
    r#type: String,
    value: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    debug: Option<Box<RawValue>>,
}

fn details(encoded: &[u8]) -> Vec<Detail> {
    let Ok(status) = tonic_types::Status::decode(encoded) else { return Vec::new() };
    let detail = |any: prost_types::Any| {
        let name = any.type_url.rsplit('/').next().unwrap_or_default().to_owned();
        let debug = error_detail_to_json(&name, &any.value);
        Detail { r#type: name, value: BASE64_STANDARD_NO_PAD.encode(&any.value), debug }
    };
    status.details.into_iter().map(detail).collect()
}

/// Connect's name of a gRPC code.
fn name(code: Code) -> &'static str {
    match code {
        Code::Cancelled => "canceled",
        Code::InvalidArgument => "invalid_argument",
        Code::DeadlineExceeded => "deadline_exceeded",
        Code::NotFound => "not_found",
        Code::AlreadyExists => "already_exists",
        Code::PermissionDenied => "permission_denied",
        Code::ResourceExhausted => "resource_exhausted",
        Code::FailedPrecondition => "failed_precondition",
        Code::Aborted => "aborted",
        Code::OutOfRange => "out_of_range",
        Code::Unimplemented => "unimplemented",
        Code::Internal => "internal",
        Code::Unavailable => "unavailable",
        Code::DataLoss => "data_loss",
        Code::Unauthenticated => "unauthenticated",
        Code::Ok | Code::Unknown => "unknown",
    }
}

/// HTTP's status for a gRPC code, as Connect maps it.
pub(super) fn http_status(code: Code) -> StatusCode {
    match code {
        // Not in HTTP's own list.
        Code::Cancelled => StatusCode::from_u16(499).unwrap_or(StatusCode::BAD_REQUEST),
        Code::InvalidArgument | Code::FailedPrecondition | Code::OutOfRange => StatusCode::BAD_REQUEST,
        Code::DeadlineExceeded => StatusCode::GATEWAY_TIMEOUT,
        Code::NotFound => StatusCode::NOT_FOUND,
        Code::AlreadyExists | Code::Aborted => StatusCode::CONFLICT,
        Code::PermissionDenied => StatusCode::FORBIDDEN,
        Code::ResourceExhausted => StatusCode::TOO_MANY_REQUESTS,
        Code::Unimplemented => StatusCode::NOT_IMPLEMENTED,
        Code::Unavailable => StatusCode::SERVICE_UNAVAILABLE,
        Code::Unauthenticated => StatusCode::UNAUTHORIZED,
        Code::Ok | Code::Unknown | Code::Internal | Code::DataLoss => StatusCode::INTERNAL_SERVER_ERROR,
    }
}
