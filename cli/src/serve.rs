//! `traverse serve`.

use crate::arguments::{LogStyle, Serve};
use crate::failure::Failure;
use std::io::Write;
use traverse_server::{Config, LogFormat, Server, StartError, shutdown_signal, start_telemetry};

pub(crate) async fn run(arguments: Serve) -> Result<(), Failure> {
    let format = match arguments.log_format {
        LogStyle::Text => LogFormat::Text,
        LogStyle::Json => LogFormat::Json,
    };
    start_telemetry(format).map_err(|error| Failure::Input(error.to_string()))?;
    let mut config = Config { listen: arguments.listen, ..Config::default() };
    if let Some(workers) = arguments.workers {
        config.workers = workers;
    }
    let server = Server::new(config).map_err(start_failure)?;
    let listener = server.bind().await.map_err(start_failure)?;
    let address = listener.local_addr().map_err(|error| Failure::Internal(error.to_string()))?;
    // One line for whoever waits for the port; the log goes to standard error.
    let mut out = std::io::stdout().lock();
    writeln!(out, "traverse listens on http://{address}").and_then(|()| out.flush()).ok();
    drop(out);
    server.serve(listener, shutdown_signal()).await.map_err(|error| Failure::Internal(error.to_string()))
}

pub(crate) fn start_failure(error: StartError) -> Failure {
    match error {
        StartError::Config(_) | StartError::Listen { .. } => Failure::Input(error.to_string()),
        StartError::Workers { .. } | StartError::Reflection(_) => Failure::Internal(error.to_string()),
    }
}
