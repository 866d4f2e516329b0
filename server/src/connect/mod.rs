//! The same calls as JSON (or protobuf) over HTTP POST: the Connect protocol, <https://connectrpc.com/docs/protocol>.
//!
//! A request is transcoded into a gRPC call on the very same guarded service, so limits, deadlines and errors are shared; its
//! answer is transcoded back. Sessions use the protocol's streaming form, whose frames `session` reads and writes.

mod error;
mod headers;
mod transcode;

pub(crate) use error::end_of_stream;
pub(crate) use transcode::Connect;
