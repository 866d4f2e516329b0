//! What is wrong with a profile file.

use std::fmt;

/// Why a profile can't be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The reader itself failed.
    #[error("{file} can't be read: {message}; check the path and its permissions")]
    Io {
        /// Name of the file.
        file: String,
        /// What the system says.
        message: String,
    },
    /// Longer than [`super::PROFILE_BYTE_LIMIT`].
    #[error("{file} is longer than {limit} bytes; split it")]
    TooLong {
        /// Name of the file.
        file: String,
        /// The limit, bytes.
        limit: u64,
    },
    /// Not text.
    #[error("{file}:{line}: this is not UTF-8 text; save the file as UTF-8")]
    NotUtf8 {
        /// Name of the file.
        file: String,
        /// Counted from 1.
        line: usize,
    },
    /// Something in it is wrong.
    #[error("{}", listed(.file, .findings))]
    Findings {
        /// Name of the file.
        file: String,
        /// At least one.
        findings: Vec<ProfileFinding>,
    },
    /// No machine of that name.
    #[error("{file} has no machine `{name}`; it has: {known}")]
    UnknownMachine {
        /// Name of the file.
        file: String,
        /// The name that was asked for.
        name: String,
        /// The names in the file.
        known: String,
    },
}

/// One thing that is wrong in a profile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfileFinding {
    /// Counted from 1.
    pub line: usize,
    /// Where in the file, such as `machine.plasma-2.gcode.decimals`.
    pub key: String,
    /// The value, the fault and what to do.
    pub message: String,
}

impl fmt::Display for ProfileFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.line, self.key, self.message)
    }
}

fn listed(file: &str, findings: &[ProfileFinding]) -> String {
    findings.iter().map(|finding| format!("{file}:{finding}")).collect::<Vec<_>>().join("\n")
}
