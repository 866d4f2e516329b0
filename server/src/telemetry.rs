//! Where the log goes and what it looks like.

use std::str::FromStr;
use tracing_subscriber::EnvFilter;

/// What is logged when `RUST_LOG` is not set.
const DEFAULT_FILTER: &str = "info";

/// What a line of the log looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LogFormat {
    /// For people.
    #[default]
    Text,
    /// One JSON object per line, for machines.
    Json,
}

impl FromStr for LogFormat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "text" => Ok(Self::Text),
            "json" => Ok(Self::Json),
            other => Err(format!("{other} is no log format; choose text or json")),
        }
    }
}

/// Why nothing can be logged.
#[derive(Debug, thiserror::Error)]
pub enum TelemetryError {
    /// `RUST_LOG` can't be read.
    #[error("RUST_LOG can't be read: {0}; set it to something like info or traverse_server=debug")]
    Filter(#[from] tracing_subscriber::filter::ParseError),
    /// Telemetry has been started before.
    #[error("telemetry is started already: {0}")]
    Started(Box<dyn std::error::Error + Send + Sync>),
}

/// Starts logging to standard error, by `RUST_LOG` (`info` when it is not set). Once per process.
///
/// # Errors
/// `RUST_LOG` is wrong, or it is not the first time.
pub fn start_telemetry(format: LogFormat) -> Result<(), TelemetryError> {
    let wanted = std::env::var(EnvFilter::DEFAULT_ENV).unwrap_or_default();
    let wanted = if wanted.trim().is_empty() { DEFAULT_FILTER } else { &wanted };
    let filter = EnvFilter::try_new(wanted)?;
    let subscriber = tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr);
    match format {
        LogFormat::Text => subscriber.try_init(),
        LogFormat::Json => subscriber.json().flatten_event(true).try_init(),
    }
    .map_err(TelemetryError::Started)
}
