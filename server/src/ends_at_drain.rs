//! Streams without an end of their own (Health/Watch, reflection) end when the server drains: they must not hold the
//! grace that is meant for calls at work.

use bytes::Bytes;
use http::{HeaderMap, HeaderValue};
use http_body::{Body as HttpBody, Frame};
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use tokio_util::sync::{CancellationToken, WaitForCancellationFutureOwned};
use tonic::body::Body;
use tonic::{Code, Status};

/// A body that says what it has to say, and ends with UNAVAILABLE once the server drains.
pub(crate) struct EndsAtDrain {
    body: Body,
    drain: Pin<Box<WaitForCancellationFutureOwned>>,
    ended: bool,
}

impl EndsAtDrain {
    /// `body`, until `drain` is raised.
    pub(crate) fn wrap(body: Body, drain: &CancellationToken) -> Body {
        Body::new(Self { body, drain: Box::pin(drain.clone().cancelled_owned()), ended: false })
    }
}

impl HttpBody for EndsAtDrain {
    type Data = Bytes;
    type Error = Status;

    fn poll_frame(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Status>>> {
        let this = self.get_mut();
        if this.ended {
            return Poll::Ready(None);
        }
        // What is ready is said first: that it is no longer serving.
        if let Poll::Ready(frame) = Pin::new(&mut this.body).poll_frame(context) {
            return Poll::Ready(frame);
        }
        ready!(this.drain.as_mut().poll(context));
        this.ended = true;
        let mut trailers = HeaderMap::new();
        trailers.insert("grpc-status", HeaderValue::from(Code::Unavailable as i32));
        trailers.insert("grpc-message", HeaderValue::from_static("the server is stopping"));
        Poll::Ready(Some(Ok(Frame::trailers(trailers))))
    }

    fn is_end_stream(&self) -> bool {
        self.ended || self.body.is_end_stream()
    }
}
