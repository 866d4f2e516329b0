//! The Traverse server: gRPC, gRPC-Web and JSON over HTTP on one port, engines on a pool of their own.
//!
//! A request passes, in order: `accept` (connections, drain), `front` (which protocol, one log line), `connect` (JSON and
//! protobuf over POST, transcoded to gRPC), `guard` (sizes and counts before decoding), tonic, `planner_service`,
//! `dispatch` and `pool` (admission, deadline, cancel, panics), and there the engines.
//!
//! ```no_run
//! use traverse_server::{Config, Server, shutdown_signal};
//!
//! # async fn example() -> Result<(), Box<dyn std::error::Error>> {
//! let server = Server::new(Config::default())?;
//! let listener = server.bind().await?;
//! println!("listening on {}", listener.local_addr()?);
//! server.serve(listener, shutdown_signal()).await?;
//! # Ok(())
//! # }
//! ```

mod accept;
mod buffered;
mod call;
mod call_log;
mod caller;
mod config;
mod connect;
mod deadline;
mod dispatch;
mod ends_at_drain;
mod engines;
mod fault;
mod frame;
mod front;
mod guard;
mod http_service;
mod improvements;
mod limits_answer;
mod planner_service;
mod pool;
mod sections_service;
mod server;
mod signal;
mod telemetry;
mod tool_change;

pub use caller::{CallError, Caller};
pub use config::{Config, ConfigError, DEFAULT_PORT};
pub use deadline::ANSWER_RESERVE;
pub use dispatch::RETRY_AFTER;
pub use engines::{Engines, TraverseEngines};
pub use http_service::HttpService;
pub use server::{Server, StartError};
pub use signal::shutdown_signal;
pub use telemetry::{LogFormat, TelemetryError, start_telemetry};
