//! When a call has to be answered: the shortest of what the request's body says, what the caller's transport says less a reserve,
//! and what the server permits. Waiting in the queue counts.

use http::HeaderMap;
use std::time::{Duration, Instant};
use traverse_proto::Refused;

/// What is kept of the caller's own deadline so that the answer arrives before the caller gives up.
pub const ANSWER_RESERVE: Duration = Duration::from_millis(50);

/// How long an engine that was told to stop may take before its caller is answered without it.
pub(crate) const STOP_GRACE: Duration = Duration::from_millis(25);

const GRPC_TIMEOUT: &str = "grpc-timeout";

/// How long a call may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimeLimits {
    /// When neither body nor transport says anything.
    pub(crate) default: Duration,
    /// At most.
    pub(crate) longest: Duration,
}

impl TimeLimits {
    /// When a call has to be answered. `arrival` is when its head came, `read_at` when all of it was there: a slow line does
    /// not use up what the request gives the engine. Absent: the clock can't express it.
    pub(crate) fn deadline(&self, asked: &Asked) -> Option<Instant> {
        let own = match (asked.body, asked.transport) {
            (None, Some(_)) => self.longest,
            (body, _) => body.unwrap_or(self.default).min(self.longest),
        };
        let own = asked.read_at.checked_add(own);
        let transport = asked.transport.and_then(|timeout| asked.arrival.checked_add(less_reserve(timeout)));
        match (own, transport) {
            (Some(own), Some(transport)) => Some(own.min(transport)),
            (one, other) => one.or(other),
        }
    }
}

/// How long a caller is ready to wait.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    /// When the head of the call came.
    pub(crate) arrival: Instant,
    /// When all of it had come.
    pub(crate) read_at: Instant,
    /// The time limit in the request.
    pub(crate) body: Option<Duration>,
    /// The timeout of the call.
    pub(crate) transport: Option<Duration>,
}

/// A timeout so short that the reserve would eat it is halved instead.
pub(crate) fn less_reserve(timeout: Duration) -> Duration {
    timeout.saturating_sub(ANSWER_RESERVE).max(timeout / 2)
}

/// The timeout that a gRPC caller sends along.
pub(crate) fn grpc_timeout(headers: &HeaderMap) -> Result<Option<Duration>, Refused> {
    let Some(value) = headers.get(GRPC_TIMEOUT) else { return Ok(None) };
    value.to_str().ok().and_then(parsed_grpc_timeout).map(Some).ok_or_else(|| Refused::MalformedHeader {
        detail: format!(
            "{GRPC_TIMEOUT} is {value:?}; send at most 8 digits and a unit of H, M, S, m, u or n"
        ),
    })
}

fn parsed_grpc_timeout(text: &str) -> Option<Duration> {
    let (digits, unit) = text.split_at_checked(text.len().checked_sub(1)?)?;
    if digits.is_empty() || digits.len() > 8 || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let count: u64 = digits.parse().ok()?;
    Some(match unit {
        "H" => Duration::from_secs(count * 3600),
        "M" => Duration::from_secs(count * 60),
        "S" => Duration::from_secs(count),
        "m" => Duration::from_millis(count),
        "u" => Duration::from_micros(count),
        "n" => Duration::from_nanos(count),
        _ => return None,
    })
}

/// The same timeout as a gRPC caller would send it.
pub(crate) fn to_grpc_timeout(timeout: Duration) -> String {
    const MOST: u128 = 99_999_999;
    match timeout.as_micros() {
        micros if micros <= MOST => format!("{micros}u"),
        micros if micros / 1000 <= MOST => format!("{}m", micros / 1000),
        micros => format!("{}S", (micros / 1_000_000).min(MOST)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: TimeLimits =
        TimeLimits { default: Duration::from_secs(10), longest: Duration::from_secs(60) };

    #[test]
    fn the_shortest_counts() {
        let arrival = Instant::now();
        let read_at = arrival + Duration::from_secs(1);
        let after_arrival = |body, transport| {
            let deadline = LIMITS.deadline(&Asked { arrival, read_at, body, transport });
            deadline.expect("near enough").duration_since(arrival)
        };
        let seconds = |s| Some(Duration::from_secs(s));
        assert_eq!(after_arrival(None, None), Duration::from_secs(11));
        assert_eq!(after_arrival(seconds(20), None), Duration::from_secs(21));
        assert_eq!(after_arrival(seconds(100), None), Duration::from_secs(61));
        assert_eq!(after_arrival(seconds(5), seconds(30)), Duration::from_secs(6));
        assert_eq!(after_arrival(seconds(5), seconds(2)), Duration::from_secs(2) - ANSWER_RESERVE);
        assert_eq!(after_arrival(None, seconds(30)), Duration::from_secs(30) - ANSWER_RESERVE);
        assert_eq!(after_arrival(None, Some(Duration::from_millis(60))), Duration::from_millis(30));
        assert_eq!(after_arrival(seconds(0), None), Duration::from_secs(1));
        assert_eq!(after_arrival(None, Some(Duration::MAX)), Duration::from_secs(61));
    }

    #[test]
    fn grpc_timeouts_are_read_as_specified() {
        let read = |text: &str| {
            let mut headers = HeaderMap::new();
            headers.insert(GRPC_TIMEOUT, text.parse().expect("a header"));
            grpc_timeout(&headers)
        };
        assert_eq!(read("150m"), Ok(Some(Duration::from_millis(150))));
        assert_eq!(read("99999999H"), Ok(Some(Duration::from_secs(99_999_999 * 3600))));
        for wrong in ["", "m", "1", "1x", "-1S", "123456789S", "1.5S", "1 S"] {
            assert_eq!(read(wrong).map_err(|refused| refused.reason()), Err("MALFORMED_HEADER"), "{wrong}");
        }
        for timeout in
            [Duration::from_micros(1), Duration::from_millis(123_456_789), Duration::from_secs(1 << 40)]
        {
            assert!(parsed_grpc_timeout(&to_grpc_timeout(timeout)).is_some_and(|read| read <= timeout));
        }
    }
}
