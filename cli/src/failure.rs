//! How a command can end other than well, and with which exit code.

use std::process::ExitCode;
use traverse_server::CallError;

/// How a command can end other than well. The exit codes are documented in docs/cli.md.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// A file, a number or a request that can't be used.
    #[error("{0}")]
    Input(String),
    /// Proven: there is no collision-free path.
    #[error("{0}")]
    NoPath(String),
    /// The checker found violations.
    #[error("{0}")]
    Violations(String),
    /// The server can't be reached.
    #[error("{0}")]
    Unreachable(String),
    /// Not now, but the same may succeed later: time limit, full queue, draining server.
    #[error("{0}")]
    NotNow(String),
    /// A defect, or a system that gives no threads or files.
    #[error("{0}")]
    Internal(String),
}

impl Failure {
    /// The exit code; 2 is what a wrong command line ends with.
    pub(crate) fn code(&self) -> u8 {
        match self {
            Self::Internal(_) => 1,
            Self::Input(_) => 3,
            Self::NoPath(_) => 4,
            Self::Violations(_) => 5,
            Self::Unreachable(_) => 6,
            Self::NotNow(_) => 7,
        }
    }

    /// Says what happened on standard error.
    pub(crate) fn report(&self) -> ExitCode {
        eprintln!("traverse: {self}");
        ExitCode::from(self.code())
    }
}

impl From<CallError> for Failure {
    fn from(error: CallError) -> Self {
        let text = error.to_string();
        match error {
            CallError::Unreachable { .. } => Self::Unreachable(text),
            CallError::UnknownMethod { .. } | CallError::Address { .. } => Self::Input(text),
            CallError::Refused { code, reason, .. } => match (code.as_str(), reason.as_str()) {
                ("internal" | "unknown" | "data_loss", _) => Self::Internal(text),
                (_, "QUEUE_FULL" | "TIME_LIMIT_REACHED" | "SERVER_DRAINING" | "CANCELLED") => {
                    Self::NotNow(text)
                }
                // Something between here and the server.
                ("deadline_exceeded" | "resource_exhausted" | "unavailable" | "canceled", "") => {
                    Self::NotNow(text)
                }
                // What is too large stays so, and so does a search that a limit ends.
                _ => Self::Input(text),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_may_succeed_later_is_not_now() {
        for (code, reason, exit) in [
            ("resource_exhausted", "QUEUE_FULL", 7),
            ("deadline_exceeded", "TIME_LIMIT_REACHED", 7),
            ("unavailable", "SERVER_DRAINING", 7),
            ("unavailable", "", 7),
            ("resource_exhausted", "MESSAGE_TOO_LARGE", 3),
            ("resource_exhausted", "ITERATION_LIMIT_REACHED", 3),
            ("resource_exhausted", "SEARCH_TOO_LARGE", 3),
            ("invalid_argument", "INVALID_REQUEST", 3),
            ("internal", "INTERNAL", 1),
        ] {
            let (code, reason) = (code.to_owned(), reason.to_owned());
            let words = format!("{code} {reason}");
            let error = CallError::Refused { code, reason, message: String::new(), body: String::new() };
            assert_eq!(Failure::from(error).code(), exit, "{words}");
        }
    }
}
