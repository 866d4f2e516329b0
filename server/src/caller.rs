//! Calls by name with proto3 JSON, in process or on a server: what `traverse call` stands on.

use crate::server::Server;
use bytes::Bytes;
use http::{Method, Request, Response, Uri, header};
use http_body_util::{BodyExt, Full, Limited};
use hyper_util::rt::TokioIo;
use tokio::net::TcpStream;
use tower::ServiceExt;
use traverse_proto::Procedure;

/// Largest answer that is read, bytes.
const ANSWER_BYTES: usize = 1 << 30;

/// Port of an `http` address that names none.
const HTTP_PORT: u16 = 80;

/// Calls by name with proto3 JSON.
pub enum Caller {
    /// The engines in this process, with every check and limit of a server.
    InProcess(Box<Server>),
    /// A server somewhere, such as `http://127.0.0.1:50051`.
    Remote(Uri),
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CallError {
    /// The service refused the call.
    #[error("{message} ({code})")]
    Refused {
        /// Connect's name of the code, such as `invalid_argument`.
        code: String,
        /// Of Traverse, as in docs/errors.md, such as `QUEUE_FULL`; empty when something else answered.
        reason: String,
        /// For people.
        message: String,
        /// The whole error as JSON: code, message, details.
        body: String,
    },
    /// There is no such call in the contract.
    #[error("there is no call {name}; choose one of {}", known.join(", "))]
    UnknownMethod {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// The address can't be used.
    #[error("{address} is no address to call; send one like http://127.0.0.1:50051")]
    Address {
        /// What was given.
        address: String,
    },
    /// The server can't be reached, or the connection broke.
    #[error("no answer from {server}: {why}; is `traverse serve` running there?")]
    Unreachable {
        /// Its address.
        server: String,
        /// What happened.
        why: String,
    },
}

impl Caller {
    /// A server at an address such as `http://127.0.0.1:50051`. Nothing is connected yet.
    ///
    /// # Errors
    /// It is no plain `http` address.
    pub fn remote(address: &str) -> Result<Self, CallError> {
        let wrong = || CallError::Address { address: address.to_owned() };
        let spelled = if address.contains("://") { address.to_owned() } else { format!("http://{address}") };
        let uri: Uri = spelled.parse().map_err(|_| wrong())?;
        if uri.scheme_str() != Some("http") || uri.host().is_none() {
            return Err(wrong());
        }
        Ok(Self::Remote(uri))
    }

    /// Calls `method` (`PlanRapidMove`, or with its service) with a request as proto3 JSON; the answer is proto3 JSON.
    ///
    /// # Errors
    /// See [`CallError`].
    pub async fn call(&self, method: &str, request: impl Into<Bytes>) -> Result<String, CallError> {
        let procedure = Procedure::named(method).ok_or_else(|| CallError::UnknownMethod {
            name: method.to_owned(),
            known: Procedure::all().map(|procedure| procedure.name().to_owned()).collect(),
        })?;
        let mut post = Request::new(Full::new(request.into()));
        *post.method_mut() = Method::POST;
        *post.uri_mut() = procedure.path().parse().unwrap_or_default();
        post.headers_mut().insert(header::CONTENT_TYPE, header::HeaderValue::from_static("application/json"));
        match self {
            Self::InProcess(server) => {
                let response =
                    server.http_service().oneshot(post).await.unwrap_or_else(|never| match never {});
                read("this process", response).await
            }
            Self::Remote(server) => {
                let response = send(server, post).await.map_err(|why| unreachable(server, &*why))?;
                read(&server.to_string(), response).await
            }
        }
    }
}

async fn send(
    server: &Uri,
    mut post: Request<Full<Bytes>>,
) -> Result<Response<hyper::body::Incoming>, Box<dyn std::error::Error + Send + Sync>> {
    let host = server.host().unwrap_or_default();
    let port = server.port_u16().unwrap_or(HTTP_PORT);
    let stream = TcpStream::connect((host.trim_matches(['[', ']']), port)).await?;
    let (mut sender, connection) = hyper::client::conn::http1::handshake(TokioIo::new(stream)).await?;
    tokio::spawn(connection);
    post.headers_mut().insert(header::HOST, format!("{host}:{port}").parse()?);
    Ok(sender.send_request(post).await?)
}

async fn read<B>(server: &str, response: Response<B>) -> Result<String, CallError>
where
    B: http_body::Body<Data = Bytes>,
    B::Error: Into<Box<dyn std::error::Error + Send + Sync>>,
{
    let broken = |why: String| CallError::Unreachable { server: server.to_owned(), why };
    let status = response.status();
    let body = Limited::new(response.into_body(), ANSWER_BYTES).collect().await;
    let body = body.map_err(|error| broken(error.to_string()))?.to_bytes();
    let text =
        String::from_utf8(body.into()).map_err(|_| broken(format!("it answers {status} and no text")))?;
    if status.is_success() {
        return Ok(text);
    }
    let error: serde_json::Value = serde_json::from_str(&text).unwrap_or_default();
    let part = |name: &str| error.get(name).and_then(|value| value.as_str()).map(str::to_owned);
    let code = part("code").ok_or_else(|| broken(format!("it answers {status}: no Traverse server")))?;
    let message = part("message").unwrap_or_default();
    Err(CallError::Refused { code, reason: reason(&error), message, body: text })
}

/// What its ErrorInfo says; empty without one.
fn reason(error: &serde_json::Value) -> String {
    let details = error["details"].as_array().into_iter().flatten();
    let info = details.filter(|detail| detail["type"] == "google.rpc.ErrorInfo");
    info.filter_map(|info| info["debug"]["reason"].as_str()).next().unwrap_or_default().to_owned()
}

fn unreachable(server: &Uri, why: &(dyn std::error::Error + Send + Sync)) -> CallError {
    CallError::Unreachable { server: server.to_string(), why: why.to_string() }
}
