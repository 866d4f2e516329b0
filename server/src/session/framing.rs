//! How a session's messages travel: both protocols put a flag and a length before each, and differ in how a call ends.

use crate::connect::end_of_stream;
use crate::frame;
use bytes::{BufMut, Bytes, BytesMut};
use http::{HeaderMap, HeaderValue, Response, header};
use http_body::Frame;
use http_body_util::StreamBody;
use prost::Message;
use tonic::Status;
use tonic::body::Body;
use traverse_proto::json::{answer_to_json, request_from_json};
use traverse_proto::v1::PlanRapidMovesResponse;
use traverse_proto::{Limits, Procedure, Refused};

/// Connect's flag of the message that ends a call.
const END: u8 = 2;

/// How a session's messages travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Framing {
    /// gRPC, and gRPC-Web translated to it.
    Grpc,
    /// Connect's streaming form with protobuf.
    ConnectProto,
    /// Connect's streaming form with JSON.
    ConnectJson,
}

impl Framing {
    fn content_type(self) -> &'static str {
        match self {
            Self::Grpc => "application/grpc",
            Self::ConnectProto => "application/connect+proto",
            Self::ConnectJson => "application/connect+json",
        }
    }

    /// The encoded step that a message stands for.
    pub(super) fn step(
        self,
        procedure: &Procedure,
        message: Bytes,
        limits: &Limits,
    ) -> Result<Bytes, Refused> {
        match self {
            Self::Grpc | Self::ConnectProto => Ok(message),
            Self::ConnectJson => request_from_json(procedure, &message, limits).map(Bytes::from),
        }
    }

    /// Adds an answer of at most `limit` bytes.
    pub(super) fn put(
        self,
        procedure: &Procedure,
        answer: &PlanRapidMovesResponse,
        limit: usize,
        out: &mut BytesMut,
    ) -> Result<(), Refused> {
        let fits = |bytes| match bytes {
            bytes if bytes > limit => Err(Refused::AnswerTooLarge { bytes, limit }),
            _ => Ok(()),
        };
        let bytes = answer.encoded_len();
        fits(bytes)?;
        match self {
            Self::Grpc | Self::ConnectProto => {
                put_head(0, bytes, out);
                // A buffer that grows takes everything.
                answer.encode(out).map_err(|error| crate::fault::of(&error.to_string()))
            }
            Self::ConnectJson => {
                let text = answer_to_json(procedure, &answer.encode_to_vec())?;
                fits(text.len())?;
                put_head(0, text.len(), out);
                out.put_slice(&text);
                Ok(())
            }
        }
    }

    /// A response that ends at once.
    pub(crate) fn ended(self, status: &Status) -> Response<Body> {
        self.response(Body::new(StreamBody::new(futures_util::stream::iter([Ok::<_, Status>(
            self.end(status),
        )]))))
    }

    pub(super) fn response(self, body: Body) -> Response<Body> {
        let mut response = Response::new(body);
        let content_type = HeaderValue::from_static(self.content_type());
        response.headers_mut().insert(header::CONTENT_TYPE, content_type);
        response
    }

    /// How the call ends: the last frame of its body.
    pub(super) fn end(self, status: &Status) -> Frame<Bytes> {
        if self == Self::Grpc {
            let mut trailers = HeaderMap::new();
            if status.add_header(&mut trailers).is_err() {
                trailers.insert("grpc-status", HeaderValue::from_static("13"));
            }
            return Frame::trailers(trailers);
        }
        let text = end_of_stream(status);
        let mut out = BytesMut::with_capacity(frame::HEADER + text.len());
        put_head(END, text.len(), &mut out);
        out.put_slice(&text);
        Frame::data(out.freeze())
    }
}

fn put_head(flag: u8, bytes: usize, out: &mut BytesMut) {
    out.reserve(frame::HEADER + bytes);
    out.put_u8(flag);
    // Below 4 GiB: configuration sees to it.
    out.put_u32(u32::try_from(bytes).unwrap_or(u32::MAX));
}
