//! What every gRPC call passes before tonic: there is such a call, the request fits, its frame is whole, it holds no more
//! items than permitted. Faults that escape a handler end here.

use crate::buffered::{Buffered, Held, Wanted};
use crate::call::{Call, Protocol};
use crate::config::Config;
use crate::deadline::grpc_timeout;
use crate::ends_at_drain::EndsAtDrain;
use crate::frame;
use crate::planner_service::Reading;
use crate::session::{Framing, Opening, Sessions};
use bytes::Bytes;
use futures_util::FutureExt;
use futures_util::future::BoxFuture;
use http::{Request, Response, Version};
use http_body_util::Full;
use std::convert::Infallible;
use std::panic::AssertUnwindSafe;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Instant;
use tokio_util::sync::CancellationToken;
use tonic::body::Body;
use tonic::service::Routes;
use tower::{Service, ServiceExt};
use traverse_proto::{Procedure, Refused, check_counts};

/// Calls that are none of ours: passed on as they are, until the server drains. tonic bounds them.
const PASSED: &[&str] = &["/grpc.health.v1.Health/", "/grpc.reflection.v1.", "/grpc.reflection.v1alpha."];

/// Guards the routes.
#[derive(Clone)]
pub(crate) struct Guard {
    pub(crate) routes: Routes,
    pub(crate) config: Arc<Config>,
    pub(crate) buffered: Buffered,
    pub(crate) sessions: Arc<Sessions>,
    /// Raised when the server begins to drain.
    pub(crate) drain: CancellationToken,
}

impl Service<Request<Body>> for Guard {
    type Response = Response<Body>;
    type Error = Infallible;
    type Future = BoxFuture<'static, Result<Response<Body>, Infallible>>;

    fn poll_ready(&mut self, _: &mut Context<'_>) -> Poll<Result<(), Infallible>> {
        Poll::Ready(Ok(()))
    }

    fn call(&mut self, request: Request<Body>) -> Self::Future {
        let guard = self.clone();
        Box::pin(async move { Ok(guard.answer(request).await) })
    }
}

impl Guard {
    async fn answer(self, mut request: Request<Body>) -> Response<Body> {
        let call = request.extensions().get::<Arc<Call>>().cloned();
        let call = call.unwrap_or_else(|| Arc::new(Call::new(Protocol::Grpc)));
        request.extensions_mut().insert(Arc::clone(&call));
        let answered = AssertUnwindSafe(self.admit_and_route(&call, request)).catch_unwind().await;
        match answered.unwrap_or_else(|panic| Err(crate::fault::of_panic(&*panic))) {
            Ok(response) => response,
            Err(refused) => {
                call.refused(&refused);
                refused.to_status().into_http()
            }
        }
    }

    async fn admit_and_route(
        self,
        call: &Arc<Call>,
        request: Request<Body>,
    ) -> Result<Response<Body>, Refused> {
        let path = request.uri().path();
        if PASSED.iter().any(|passed| path.starts_with(passed)) {
            let drain = self.drain.clone();
            return Ok(self.route(request).await.map(|body| EndsAtDrain::wrap(body, &drain)));
        }
        let unknown = || Refused::UnknownMethod { path: path.to_owned() };
        let procedure = Procedure::at_path(path).ok_or_else(unknown)?;
        if procedure.is_session() {
            let (head, body) = request.into_parts();
            let encoding = head.headers.get("grpc-encoding").and_then(|value| value.to_str().ok());
            return self.sessions.open(Opening {
                call: Arc::clone(call),
                procedure,
                framing: Framing::Grpc,
                timeout: grpc_timeout(&head.headers)?,
                encoding: encoding.map(str::to_owned),
                body,
            });
        }
        let (request, held) = self.admit(call, &procedure, request).await?;
        let response = self.route(request).await;
        drop(held);
        Ok(response)
    }

    async fn admit(
        &self,
        call: &Call,
        procedure: &Procedure,
        request: Request<Body>,
    ) -> Result<(Request<Body>, Held), Refused> {
        let limits = &self.config.limits;
        let (mut head, body) = request.into_parts();
        let timeout = grpc_timeout(&head.headers)?;
        let encoding = head.headers.get("grpc-encoding").and_then(|value| value.to_str().ok());
        // Clients send the end of an HTTP/2 stream behind the message, in a packet of its own: it is not waited for.
        let ends_late = head.version == Version::HTTP_2;
        let inspect = |read: &[u8]| {
            frame::check_head(read, limits.message_bytes, encoding)?;
            let is_whole = ends_late && frame::length(read).is_some_and(|length| read.len() >= length);
            Ok(if is_whole { Wanted::Nothing } else { Wanted::Rest })
        };
        let read = self.buffered.read(body, frame::HEADER, limits.message_bytes, inspect);
        let patience = timeout.unwrap_or(self.config.longest_time_limit).min(self.config.longest_time_limit);
        let late = |_| Refused::TimeLimitReached { lower_bound: None };
        let (bytes, held) = tokio::time::timeout(patience, read).await.map_err(late)??;
        call.note(|facts| facts.bytes = facts.bytes.max(bytes.len() as u64));
        check_counts(&procedure.input(), frame::message(&bytes)?, limits)?;
        head.extensions.insert(Reading { timeout, read_at: Instant::now() });
        Ok((Request::from_parts(head, whole(bytes)), held))
    }

    async fn route(self, request: Request<Body>) -> Response<Body> {
        match self.routes.oneshot(request).await {
            Ok(response) => response,
            Err(never) => match never {},
        }
    }
}

fn whole(bytes: Bytes) -> Body {
    Body::new(Full::new(bytes))
}
