//! Sessions by name with proto3 JSON, one step and one answer per line: the Connect protocol's streaming form, in process
//! or on a server.

use crate::caller::{CallError, Caller, connection, procedure, refused, unreachable};
use crate::frame;
use bytes::{Bytes, BytesMut};
use futures_util::{Stream, StreamExt};
use http::{Method, Request, Response, Uri, header};
use http_body::{Body as HttpBody, Frame};
use http_body_util::{BodyExt, StreamBody};
use hyper_util::rt::{TokioExecutor, TokioIo};
use std::convert::Infallible;
use tower::ServiceExt;

/// Largest answer to a step that is read, bytes.
const ANSWER_BYTES: usize = 1 << 30;

/// Connect's flag of the message that ends a call.
const END: u8 = 2;

impl Caller {
    /// Opens the session `method` (`PlanRapidMoves`) and sends it steps, each proto3 JSON, as they come; `answered` gets
    /// each answer, proto3 JSON on one line, when it is there.
    ///
    /// # Errors
    /// See [`CallError`]; answers that came before were given.
    pub async fn session<S>(
        &self,
        method: &str,
        steps: S,
        mut answered: impl FnMut(&str),
    ) -> Result<(), CallError>
    where
        S: Stream<Item = Bytes> + Send + Unpin + 'static,
    {
        let procedure = procedure(method)?;
        if !procedure.is_session() {
            let what = "takes one request and is no session";
            return Err(CallError::OtherForm { name: procedure.name().to_owned(), what });
        }
        let frames = steps.map(|step| Ok::<_, Infallible>(Frame::data(frame::framed(&step))));
        let mut post = Request::new(StreamBody::new(frames));
        *post.method_mut() = Method::POST;
        let content_type = header::HeaderValue::from_static("application/connect+json");
        post.headers_mut().insert(header::CONTENT_TYPE, content_type);
        match self {
            Self::InProcess(server) => {
                *post.uri_mut() = procedure.path().parse().unwrap_or_default();
                let response =
                    server.http_service().oneshot(post).await.unwrap_or_else(|never| match never {});
                read("this process", response, &mut answered).await
            }
            Self::Remote(server) => {
                let mut parts = server.clone().into_parts();
                parts.path_and_query = procedure.path().parse().ok();
                *post.uri_mut() = Uri::from_parts(parts).unwrap_or_default();
                let response = send(server, post).await.map_err(|why| unreachable(server, &*why))?;
                read(&server.to_string(), response, &mut answered).await
            }
        }
    }
}

async fn send<B>(
    server: &Uri,
    post: Request<B>,
) -> Result<Response<hyper::body::Incoming>, Box<dyn std::error::Error + Send + Sync>>
where
    B: HttpBody<Data = Bytes> + Send + Unpin + 'static,
    B::Error: Into<Box<dyn std::error::Error + Send + Sync>>,
{
    let (stream, _) = connection(server).await?;
    let connected = hyper::client::conn::http2::handshake(TokioExecutor::new(), TokioIo::new(stream)).await;
    let (mut sender, connection) = connected?;
    tokio::spawn(connection);
    Ok(sender.send_request(post).await?)
}

async fn read<B>(
    server: &str,
    response: Response<B>,
    answered: &mut impl FnMut(&str),
) -> Result<(), CallError>
where
    B: HttpBody<Data = Bytes> + Unpin,
    B::Error: std::fmt::Display,
{
    let broken = |why: String| CallError::Unreachable { server: server.to_owned(), why };
    let status = response.status();
    if !status.is_success() {
        return Err(broken(format!("it answers {status}: no Traverse server")));
    }
    let mut body = response.into_body();
    let mut read = BytesMut::new();
    loop {
        while let Some(length) = frame::length(&read).filter(|&length| length <= read.len()) {
            let frame = read.split_to(length);
            let text = String::from_utf8_lossy(&frame[frame::HEADER..]);
            if frame[0] & END == 0 {
                answered(&text);
                continue;
            }
            return end(&text).map_err(|why| match why {
                End::Refused(refused) => refused,
                End::Unknown(text) => broken(format!("it ends the session with {text}")),
            });
        }
        if read.len() > ANSWER_BYTES {
            return Err(broken(format!("an answer has more than {ANSWER_BYTES} bytes")));
        }
        let frame = body.frame().await.ok_or_else(|| broken("the session broke off".to_owned()))?;
        if let Ok(data) = frame.map_err(|error| broken(error.to_string()))?.into_data() {
            read.extend_from_slice(&data);
        }
    }
}

enum End {
    Refused(CallError),
    Unknown(String),
}

/// What the message says that ends a call.
fn end(text: &str) -> Result<(), End> {
    let end: serde_json::Value = serde_json::from_str(text).map_err(|_| End::Unknown(text.to_owned()))?;
    match end.get("error") {
        None => Ok(()),
        Some(error) => Err(refused(error.to_string()).map_or_else(End::Unknown, End::Refused)),
    }
}
