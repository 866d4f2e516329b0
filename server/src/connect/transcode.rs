//! From a Connect request to a gRPC call and back.

use super::error::{error_body, http_status};
use super::headers::{Encoding, session_framing, timeout};
use crate::buffered::{Buffered, Wanted};
use crate::call::Call;
use crate::config::Config;
use crate::deadline::to_grpc_timeout;
use crate::dispatch::Dispatcher;
use crate::frame;
use crate::guard::Guard;
use crate::session::{Opening, Sessions};
use bytes::Bytes;
use futures_util::FutureExt;
use http::{HeaderMap, HeaderValue, Method, Request, Response, StatusCode, header};
use http_body_util::{BodyExt, Full};
use std::panic::AssertUnwindSafe;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tonic::body::Body;
use tonic::{Code, Status};
use tower::ServiceExt;
use traverse_proto::json::{answer_to_json, request_from_json};
use traverse_proto::{Procedure, Refused};

/// Larger texts are parsed and written by a worker, not by the async runtime.
const INLINE_BYTES: usize = 64 * 1024;

/// Answers Connect requests.
#[derive(Clone)]
pub(crate) struct Connect {
    pub(crate) grpc: Guard,
    pub(crate) config: Arc<Config>,
    pub(crate) dispatcher: Arc<Dispatcher>,
    pub(crate) buffered: Buffered,
    pub(crate) sessions: Arc<Sessions>,
}

impl Connect {
    pub(crate) async fn answer(&self, call: &Arc<Call>, request: Request<Body>) -> Response<Body> {
        let Some(procedure) = Procedure::at_path(request.uri().path()) else {
            let refused = Refused::UnknownMethod { path: request.uri().path().to_owned() };
            call.refused(&refused);
            return failure(&refused.to_status(), StatusCode::NOT_FOUND);
        };
        if request.method() != Method::POST {
            return bare(call, StatusCode::METHOD_NOT_ALLOWED, header::ALLOW, "POST");
        }
        if procedure.is_session() {
            return self.session(call, procedure, request);
        }
        let Some(encoding) = Encoding::of(request.headers()) else {
            let known = "application/json, application/proto";
            return bare(
                call,
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                header::HeaderName::from_static("accept-post"),
                known,
            );
        };
        let transcoded = AssertUnwindSafe(self.transcode(call, &procedure, encoding, request)).catch_unwind();
        match transcoded.await.unwrap_or_else(|panic| Err(crate::fault::of_panic(&*panic).into())) {
            Ok(body) => response(StatusCode::OK, encoding.content_type(), body),
            Err(Failure::Refused(refused)) => {
                call.refused(&refused);
                failure(&refused.to_status(), http_status(refused.code()))
            }
            Err(Failure::Status(status)) => failure(&status, http_status(status.code())),
        }
    }

    /// Opens a session; what refuses it comes as the end of its stream.
    fn session(&self, call: &Arc<Call>, procedure: Procedure, request: Request<Body>) -> Response<Body> {
        let Some(framing) = session_framing(request.headers()) else {
            let known = "application/connect+json, application/connect+proto";
            return bare(
                call,
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                header::HeaderName::from_static("accept-post"),
                known,
            );
        };
        let encoding = header::HeaderName::from_static("connect-content-encoding");
        let opened = timeout(request.headers(), &encoding).and_then(|timeout| {
            let (call, body) = (Arc::clone(call), request.into_body());
            self.sessions.open(Opening { call, procedure, framing, timeout, encoding: None, body })
        });
        opened.unwrap_or_else(|refused| {
            call.refused(&refused);
            framing.ended(&refused.to_status())
        })
    }

    async fn transcode(
        &self,
        call: &Arc<Call>,
        procedure: &Procedure,
        encoding: Encoding,
        request: Request<Body>,
    ) -> Result<Bytes, Failure> {
        let timeout = timeout(request.headers(), &header::CONTENT_ENCODING)?;
        let patience = timeout.unwrap_or(self.config.longest_time_limit).min(self.config.longest_time_limit);
        let deadline = call.arrival.checked_add(patience);
        let limit = self.config.limits.message_bytes;
        let read = self.buffered.read(request.into_body(), 0, limit, |_| Ok(Wanted::Rest));
        let late = |_| Refused::TimeLimitReached { lower_bound: None };
        let (body, held) = tokio::time::timeout(patience, read).await.map_err(late)??;
        call.note(|facts| facts.bytes = body.len() as u64);
        let message = match encoding {
            Encoding::Proto => body,
            Encoding::Json => self.parse(call, procedure, body, deadline).await?,
        };
        drop(held);
        let grpc = grpc_request(call, procedure, &message, timeout);
        let answer = self.grpc.clone().oneshot(grpc).await.unwrap_or_else(|never| match never {});
        let message = message_of(answer).await?;
        match encoding {
            Encoding::Proto => Ok(message),
            Encoding::Json => write(procedure, message).await,
        }
    }

    async fn parse(
        &self,
        call: &Arc<Call>,
        procedure: &Procedure,
        text: Bytes,
        deadline: Option<Instant>,
    ) -> Result<Bytes, Refused> {
        if text.len() <= INLINE_BYTES {
            return request_from_json(procedure, &text, &self.config.limits).map(Bytes::from);
        }
        let (procedure, config) = (procedure.clone(), Arc::clone(&self.config));
        let work = move |_: &_| request_from_json(&procedure, &text, &config.limits).map(Bytes::from);
        self.dispatcher.run(call, deadline, work).await
    }
}

/// A call that fails before tonic has it, or in tonic.
enum Failure {
    Refused(Refused),
    Status(Status),
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

/// Answers are bounded by the message limit and by what all calls at work may give, so threads for them are too.
async fn write(procedure: &Procedure, message: Bytes) -> Result<Bytes, Failure> {
    if message.len() <= INLINE_BYTES {
        return Ok(answer_to_json(procedure, &message).map(Bytes::from)?);
    }
    let procedure = procedure.clone();
    let written = tokio::task::spawn_blocking(move || answer_to_json(&procedure, &message).map(Bytes::from));
    let broken = |error: tokio::task::JoinError| crate::fault::of(&format!("writing JSON failed: {error}"));
    Ok(written.await.map_err(broken)??)
}

fn grpc_request(
    call: &Arc<Call>,
    procedure: &Procedure,
    message: &[u8],
    timeout: Option<Duration>,
) -> Request<Body> {
    let mut request = Request::new(Body::new(Full::new(frame::framed(message))));
    *request.method_mut() = Method::POST;
    *request.version_mut() = http::Version::HTTP_2;
    // Paths of the contract are plain identifiers.
    *request.uri_mut() = procedure.path().parse().unwrap_or_default();
    let headers = request.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("application/grpc"));
    headers.insert(header::TE, HeaderValue::from_static("trailers"));
    if let Some(value) = timeout.and_then(|timeout| HeaderValue::from_str(&to_grpc_timeout(timeout)).ok()) {
        headers.insert("grpc-timeout", value);
    }
    request.extensions_mut().insert(Arc::clone(call));
    request
}

async fn message_of(answer: Response<Body>) -> Result<Bytes, Failure> {
    let (head, body) = answer.into_parts();
    if let Some(status) = refused_status(&head.headers) {
        return Err(Failure::Status(status));
    }
    let collected = body.collect().await.map_err(Failure::Status)?;
    if let Some(status) = collected.trailers().and_then(refused_status) {
        return Err(Failure::Status(status));
    }
    let bytes = collected.to_bytes();
    let message = frame::message(&bytes).map_err(|refused| {
        crate::fault::of(&format!("tonic answered no whole message: {}", refused.message()))
    })?;
    Ok(bytes.slice_ref(message))
}

fn refused_status(headers: &HeaderMap) -> Option<Status> {
    Status::from_header_map(headers).filter(|status| status.code() != Code::Ok)
}

fn failure(status: &Status, http: StatusCode) -> Response<Body> {
    response(http, "application/json", Bytes::from(error_body(status)))
}

fn bare(call: &Call, status: StatusCode, name: header::HeaderName, value: &'static str) -> Response<Body> {
    call.note(|facts| {
        facts.outcome = Some("NOT_CONNECT");
        facts.code = Some(Code::Unknown);
    });
    let mut response = Response::new(Body::empty());
    *response.status_mut() = status;
    response.headers_mut().insert(name, HeaderValue::from_static(value));
    response
}

fn response(status: StatusCode, content_type: &'static str, body: Bytes) -> Response<Body> {
    let mut response = Response::new(Body::new(Full::new(body)));
    *response.status_mut() = status;
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static(content_type));
    response
}
