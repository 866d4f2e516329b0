//! What an operator can set, checked before a port is bound.

use std::net::{Ipv4Addr, SocketAddr};
use std::num::NonZeroUsize;
use std::time::Duration;
use traverse_proto::Limits;

/// The port that Traverse listens on unless told otherwise.
pub const DEFAULT_PORT: u16 = 50051;

/// What an operator can set. Every limit is explained in docs/limits.md.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Where to listen. Port 0: any free one.
    pub listen: SocketAddr,
    /// Engines that run at once.
    pub workers: usize,
    /// Calls that may wait for a free worker.
    pub queued_call_count: usize,
    /// How large a request may be.
    pub limits: Limits,
    /// Bytes of requests that are read, waiting or being worked on, over all callers.
    pub buffered_bytes: usize,
    /// Connections at once; more wait to be accepted.
    pub connection_count: usize,
    /// Time limit of a request that names none and comes without a deadline.
    pub default_time_limit: Duration,
    /// Longest time limit; a longer one is cut to it.
    pub longest_time_limit: Duration,
    /// How long calls may go on once the server was told to stop.
    pub drain_grace: Duration,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from((Ipv4Addr::LOCALHOST, DEFAULT_PORT)),
            workers: std::thread::available_parallelism().map_or(1, NonZeroUsize::get),
            queued_call_count: 64,
            limits: Limits::default(),
            buffered_bytes: 256 * 1024 * 1024,
            connection_count: 1024,
            default_time_limit: Duration::from_secs(10),
            longest_time_limit: Duration::from_secs(120),
            drain_grace: Duration::from_secs(10),
        }
    }
}

impl Config {
    /// The defaults, on any free port of this machine.
    #[must_use]
    pub fn on_free_port() -> Self {
        Self { listen: SocketAddr::from((Ipv4Addr::LOCALHOST, 0)), ..Self::default() }
    }

    /// Everything that is wrong with the settings, for people.
    ///
    /// # Errors
    /// [`ConfigError`], with every finding.
    pub fn check(&self) -> Result<(), ConfigError> {
        let limits = &self.limits;
        let mut findings = Vec::new();
        let mut at_least = |setting: &'static str, value: usize, least: usize| {
            if value < least {
                findings.push(format!("{setting} is {value}; set it to {least} or more"));
            }
        };
        at_least("workers", self.workers, 1);
        at_least("queued_call_count", self.queued_call_count, 1);
        at_least("connection_count", self.connection_count, 1);
        at_least("limits.message_bytes", limits.message_bytes, 1024);
        at_least("limits.vertex_count", limits.vertex_count, 3);
        at_least("limits.obstacle_count", limits.obstacle_count, 1);
        at_least("limits.step_count", limits.step_count, 1);
        at_least("limits.section_count", limits.section_count, 1);
        at_least("limits.part_count", limits.part_count, 1);
        at_least("buffered_bytes", self.buffered_bytes, limits.message_bytes);
        if u32::try_from(limits.message_bytes).is_err() {
            findings.push(format!(
                "limits.message_bytes is {}; gRPC frames end at {}",
                limits.message_bytes,
                u32::MAX
            ));
        }
        if self.workers > 1024 {
            findings.push(format!("workers is {}; more than 1024 threads serve nobody", self.workers));
        }
        if self.default_time_limit.is_zero() {
            findings.push("default_time_limit is 0; no call could be answered".to_owned());
        }
        if self.default_time_limit > self.longest_time_limit {
            findings.push(format!(
                "default_time_limit ({:?}) is longer than longest_time_limit ({:?}); lower the one or raise the other",
                self.default_time_limit, self.longest_time_limit
            ));
        }
        if findings.is_empty() { Ok(()) } else { Err(ConfigError { findings }) }
    }
}

/// Settings that can't be served.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the configuration can't be used: {}", findings.join("; "))]
pub struct ConfigError {
    /// Everything that is wrong.
    pub findings: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_sound() {
        assert_eq!(Config::default().check(), Ok(()));
        assert_eq!(Config::on_free_port().check(), Ok(()));
    }

    #[test]
    fn every_wrong_setting_is_named_at_once() {
        let config = Config {
            workers: 0,
            buffered_bytes: 1,
            default_time_limit: Duration::from_secs(2),
            longest_time_limit: Duration::from_secs(1),
            ..Config::default()
        };
        let error = config.check().unwrap_err();
        assert_eq!(error.findings.len(), 3, "{error}");
        assert!(error.to_string().contains("workers is 0"), "{error}");
    }
}
