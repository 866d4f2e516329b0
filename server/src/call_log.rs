//! One line per call: what was asked, how large, what came of it, how long it took.

use crate::call::Call;
use http::Response;
use std::sync::Arc;
use tonic::Code;
use tonic::body::Body;
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

    pub(crate) fn end(mut self, response: &Response<Body>) {
        self.ended = true;
        let code = response.headers().get("grpc-status").map(|value| Code::from_bytes(value.as_bytes()));
        self.write(code.unwrap_or(Code::Ok), if code.is_none() { "ok" } else { "refused" });
    }

    fn write(&self, code: Code, outcome: &str) {
        let facts = self.call.facts();
        tracing::info!(
            method = self.method,
            protocol = self.call.protocol.as_str(),
            bytes = facts.bytes,
            vertices = facts.vertices,
            obstacles = facts.obstacles,
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

/// To the microsecond.
fn milliseconds(duration: std::time::Duration) -> f64 {
    (duration.as_secs_f64() * 1e6).round() / 1e3
}
