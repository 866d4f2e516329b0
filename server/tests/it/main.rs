//! The server from outside: over real sockets, in every protocol, with good and bad callers.

#![allow(clippy::panic, reason = "tests; clippy sees functions that help them as production code")]

mod bad_input;
mod costs;
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
mod rules;
mod running;
mod sections;
mod tool_change;
mod web;
