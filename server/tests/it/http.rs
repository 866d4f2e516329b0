//! A bare HTTP client: what curl would send.

use bytes::Bytes;
use http::{HeaderMap, Method, Request, StatusCode, header};
use http_body_util::{BodyExt, Full};
use hyper_util::rt::TokioIo;
use std::net::SocketAddr;
use tokio::net::TcpStream;

pub(crate) struct Answer {
    pub(crate) status: StatusCode,
    pub(crate) headers: HeaderMap,
    pub(crate) body: Bytes,
}

impl Answer {
    pub(crate) fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| {
            panic!("{} is no JSON ({error}): {}", self.status, String::from_utf8_lossy(&self.body))
        })
    }

    /// The readable form of the error detail of a type.
    pub(crate) fn detail(&self, kind: &str) -> serde_json::Value {
        let error = self.json();
        let details = error["details"].as_array().cloned().unwrap_or_default();
        let found = details.into_iter().find(|detail| detail["type"] == kind);
        found.unwrap_or_else(|| panic!("no {kind} in {error}"))["debug"].clone()
    }

    pub(crate) fn reason(&self) -> String {
        self.detail("google.rpc.ErrorInfo")["reason"].as_str().unwrap_or_default().to_owned()
    }
}

pub(crate) async fn send(address: SocketAddr, request: Request<Full<Bytes>>) -> Answer {
    let stream = TcpStream::connect(address).await.expect("it listens");
    let (mut sender, connection) =
        hyper::client::conn::http1::handshake(TokioIo::new(stream)).await.expect("HTTP/1.1");
    tokio::spawn(connection);
    let (head, body) = sender.send_request(request).await.expect("an answer").into_parts();
    let body = body.collect().await.expect("all of it").to_bytes();
    Answer { status: head.status, headers: head.headers, body }
}

pub(crate) fn post(path: &str, content_type: &str, body: impl Into<Bytes>) -> Request<Full<Bytes>> {
    let request =
        Request::builder().method(Method::POST).uri(path).header(header::CONTENT_TYPE, content_type);
    request.header(header::HOST, "localhost").body(Full::new(body.into())).expect("a request")
}

/// A JSON call.
pub(crate) async fn call(address: SocketAddr, method: &str, body: impl Into<Bytes>) -> Answer {
    let path = format!("/traverse.v1.PlannerService/{method}");
    send(address, post(&path, "application/json", body)).await
}
