//! The same calls as JSON (or protobuf) over HTTP POST: the Connect protocol's unary form, <https://connectrpc.com/docs/protocol>.
//!
//! A request is transcoded into a gRPC call on the very same guarded service, so limits, deadlines and errors are shared; its
//! answer is transcoded back.

mod error;
mod headers;
mod transcode;

pub(crate) use transcode::Connect;
