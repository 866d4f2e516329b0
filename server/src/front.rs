//! The front door, the same for every caller: it tells protocols apart by content type and logs one line per call.

use crate::call::{Call, Protocol};
use crate::call_log::CallLog;
use crate::connect::Connect;
use crate::guard::Guard;
use bytes::Bytes;
use futures_util::future::BoxFuture;
use http::{HeaderMap, Request, Response, header};
use http_body::Body as HttpBody;
use std::convert::Infallible;
use std::sync::Arc;
use std::task::{Context, Poll};
use tonic::body::Body;
use tonic_web::{GrpcWebLayer, GrpcWebService};
use tower::{Layer, Service, ServiceExt};

/// The whole service, over HTTP/1.1 and HTTP/2.
#[derive(Clone)]
pub(crate) struct Front {
    grpc: GrpcWebService<Guard>,
    connect: Connect,
}

impl Front {
    pub(crate) fn new(guard: Guard, connect: Connect) -> Self {
        Self { grpc: GrpcWebLayer::new().layer(guard), connect }
    }

    async fn answer(self, mut request: Request<Body>) -> Response<Body> {
        let protocol = spoken(request.headers());
        let call = Arc::new(Call::new(protocol));
        let log = CallLog::begin(&call, request.uri().path());
        request.extensions_mut().insert(Arc::clone(&call));
        let response = match protocol {
            Protocol::Grpc | Protocol::GrpcWeb => match self.grpc.oneshot(request).await {
                Ok(response) => response,
                Err(never) => match never {},
            },
            Protocol::Json | Protocol::Proto => self.connect.answer(&call, request).await,
        };
        log.end(response)
    }
}

impl<B> Service<Request<B>> for Front
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
        let front = self.clone();
        Box::pin(async move { Ok(front.answer(request.map(Body::new)).await) })
    }
}

/// Whatever is not gRPC is taken for the Connect protocol, which refuses what it does not know.
fn spoken(headers: &HeaderMap) -> Protocol {
    let content_type = headers.get(header::CONTENT_TYPE).map_or(&b""[..], |value| value.as_bytes());
    if content_type.starts_with(b"application/grpc-web") {
        Protocol::GrpcWeb
    } else if content_type.starts_with(b"application/grpc") {
        Protocol::Grpc
    } else if content_type.starts_with(b"application/proto")
        || content_type.starts_with(b"application/connect+proto")
    {
        Protocol::Proto
    } else {
        Protocol::Json
    }
}
