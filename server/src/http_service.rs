//! The whole service as one tower service, for a socket or for calls in process.

use crate::front::Front;
use bytes::Bytes;
use futures_util::future::BoxFuture;
use http::{HeaderName, Method, Request, Response};
use http_body::Body as HttpBody;
use std::convert::Infallible;
use std::task::{Context, Poll};
use std::time::Duration;
use tonic::body::Body;
use tower::{Layer, Service, ServiceExt};
use tower_http::cors::{AllowHeaders, AllowOrigin, Cors, CorsLayer};

/// What a page of another origin may read of an answer.
const EXPOSED: [HeaderName; 3] = [
    HeaderName::from_static("grpc-status"),
    HeaderName::from_static("grpc-message"),
    HeaderName::from_static("grpc-status-details-bin"),
];

/// How long a browser may remember that it is welcome.
const PREFLIGHT_AGE: Duration = Duration::from_secs(3600);

/// The whole service: every protocol, every call. Clones share one pool. A generated client takes it in place of a channel.
#[derive(Clone)]
pub struct HttpService(Cors<Front>);

impl HttpService {
    /// Any origin may call: the calls are pure and answer nothing that a caller does not send.
    pub(crate) fn new(front: Front) -> Self {
        let cors = CorsLayer::new()
            .allow_origin(AllowOrigin::any())
            .allow_headers(AllowHeaders::any())
            .allow_methods([Method::POST])
            .expose_headers(EXPOSED)
            .max_age(PREFLIGHT_AGE);
        Self(cors.layer(front))
    }
}

impl<B> Service<Request<B>> for HttpService
where
    B: HttpBody<Data = Bytes> + Send + 'static,
    B::Error: Into<tonic::codegen::StdError>,
{
    type Response = Response<Body>;
    type Error = Infallible;
    type Future = BoxFuture<'static, Result<Response<Body>, Infallible>>;

    fn poll_ready(&mut self, _: &mut Context<'_>) -> Poll<Result<(), Infallible>> {
        Poll::Ready(Ok(()))
    }

    fn call(&mut self, request: Request<B>) -> Self::Future {
        let service = self.0.clone();
        Box::pin(async move { service.oneshot(request.map(Body::new)).await })
    }
}
