//! A session's answers as they go out: a body that is fed through a channel of one piece.

use super::Framing;
use bytes::Bytes;
use http_body::{Body as HttpBody, Frame};
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tonic::Status;

/// What a session says: answers, and then how it ended.
pub(super) enum Said {
    Answers(Bytes),
    End(Status),
}

/// The body of a session's response. Dropping it tells the session that its caller is gone.
pub(super) struct FramesOut {
    said: Receiver<Said>,
    framing: Framing,
    is_over: bool,
}

/// A body, and what feeds it. There is room for one piece beside the one that is being sent.
pub(super) fn frames_out(framing: Framing) -> (Sender<Said>, FramesOut) {
    let (feed, said) = channel(1);
    (feed, FramesOut { said, framing, is_over: false })
}

impl HttpBody for FramesOut {
    type Data = Bytes;
    type Error = Status;

    fn poll_frame(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Status>>> {
        let this = self.get_mut();
        if this.is_over {
            return Poll::Ready(None);
        }
        let frame = match ready!(this.said.poll_recv(context)) {
            Some(Said::Answers(answers)) => Frame::data(answers),
            Some(Said::End(status)) => {
                this.is_over = true;
                this.framing.end(&status)
            }
            // A session that ends without a word was cut short by the end of the runtime.
            None => {
                this.is_over = true;
                this.framing.end(&Status::unavailable("the server is stopping"))
            }
        };
        Poll::Ready(Some(Ok(frame)))
    }

    fn is_end_stream(&self) -> bool {
        self.is_over
    }
}
