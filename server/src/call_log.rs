//! One line per call: what was asked, how large, what came of it, how long it took.

use crate::call::Call;
use bytes::Bytes;
use http::Response;
use http_body::{Body as HttpBody, Frame};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};
use tonic::body::Body;
use tonic::{Code, Status};
use traverse_proto::Procedure;

/// Writes its line when it ends, or when the call is dropped: then the caller is gone.
pub(crate) struct CallLog {
    call: Arc<Call>,
    method: String,
    ended: bool,
}

impl CallLog {
    pub(crate) fn begin(call: &Arc<Call>, path: &str) -> Self {
        // What the caller made up does not go into the log.
        let method = match Procedure::at_path(path) {
            Some(procedure) => procedure.name().to_owned(),
            None if path.starts_with("/grpc.") => {
                path.rsplit('/').next().unwrap_or_default().chars().take(40).collect()
            }
            None => "unknown".to_owned(),
        };
        Self { call: Arc::clone(call), method, ended: false }
    }

    /// Ends with the response; with the end of its body where the call is a session.
    pub(crate) fn end(mut self, response: Response<Body>) -> Response<Body> {
        if self.call.facts().steps.is_some() {
            return response.map(|body| Body::new(LoggedBody { body, log: Some(self) }));
        }
        self.ended = true;
        let code = response.headers().get("grpc-status").map(|value| Code::from_bytes(value.as_bytes()));
        self.write(code.unwrap_or(Code::Ok), if code.is_none() { "ok" } else { "refused" });
        response
    }

    fn write(&self, code: Code, outcome: &str) {
        let facts = self.call.facts();
        tracing::info!(
            method = self.method,
            protocol = self.call.protocol.as_str(),
            bytes = facts.bytes,
            vertices = facts.vertices,
            obstacles = facts.obstacles,
            steps = facts.steps,
            refused_steps = facts.refused_steps,
            outcome = facts.outcome.unwrap_or(outcome),
            code = ?facts.code.unwrap_or(code),
            queue_ms = milliseconds(facts.queued),
            run_ms = milliseconds(facts.worked),
            total_ms = milliseconds(self.call.arrival.elapsed()),
            "call"
        );
    }
}

impl Drop for CallLog {
    fn drop(&mut self) {
        if !self.ended {
            self.write(Code::Cancelled, "CANCELLED");
        }
    }
}

/// The body of a session's response: its call is over when it is.
struct LoggedBody {
    body: Body,
    log: Option<CallLog>,
}

impl HttpBody for LoggedBody {
    type Data = Bytes;
    type Error = Status;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Status>>> {
        let frame = ready!(Pin::new(&mut self.body).poll_frame(context));
        if (frame.is_none() || self.body.is_end_stream())
            && let Some(mut log) = self.log.take()
        {
            log.ended = true;
            log.write(Code::Ok, "steps");
        }
        Poll::Ready(frame)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }
}

/// To the microsecond.
fn milliseconds(duration: std::time::Duration) -> f64 {
    (duration.as_secs_f64() * 1e6).round() / 1e3
}
