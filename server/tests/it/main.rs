//! The server from outside: over real sockets, in every protocol, with good and bad callers.

mod bad_input;
mod documents;
mod drain;
mod gate;
mod generated;
mod grpc;
mod http;
mod json;
mod load;
mod log;
mod request;
mod running;
mod web;
