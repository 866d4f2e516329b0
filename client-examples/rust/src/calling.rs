//! Calls with a deadline, tried again when the server can't be reached (UNAVAILABLE), and where it says when (RetryInfo, such as
//! with a full queue). Everything else is the same the next time, and a call that may have been served is not repeated blindly.

use crate::traverse::planner_service_client::PlannerServiceClient;
use crate::traverse::{PlanRapidMoveRequest, PlanRapidMoveResponse};
use std::time::{Duration, Instant};
use tonic::transport::{Channel, Endpoint};
use tonic::{Code, Request, Status};
use tonic_types::StatusExt;

/// Waiting doubles from here, for each try.
const FIRST_PAUSE: Duration = Duration::from_millis(100);

/// No pause is longer.
const LONGEST_PAUSE: Duration = Duration::from_secs(2);

/// A client of the server at an address such as `http://127.0.0.1:50051`. Connects with the first call, and again when
/// the connection broke.
///
/// # Errors
/// It is no address.
pub fn connect(address: &str) -> Result<PlannerServiceClient<Channel>, tonic::transport::Error> {
    let endpoint: Endpoint = Channel::from_shared(address.to_owned())
        .map_or_else(|_| Endpoint::new(address.to_owned()), Ok)?
        .connect_timeout(Duration::from_secs(5));
    // GetLimits.message_bytes is the server's limit; tonic's own is 4 MiB.
    Ok(PlannerServiceClient::new(endpoint.connect_lazy()).max_decoding_message_size(64 << 20))
}

/// Plans one rapid move within `patience`, tries included.
///
/// # Errors
/// The last try's status.
pub async fn plan_rapid_move(
    client: &mut PlannerServiceClient<Channel>,
    request: &PlanRapidMoveRequest,
    patience: Duration,
) -> Result<PlanRapidMoveResponse, Status> {
    let end = Instant::now() + patience;
    let mut pause = FIRST_PAUSE;
    loop {
        let left = end.saturating_duration_since(Instant::now());
        let mut call = Request::new(request.clone());
        // Sent along as grpc-timeout: the server stops in time by itself, and answers shortly before.
        call.set_timeout(left);
        let status = match client.plan_rapid_move(call).await {
            Ok(response) => return Ok(response.into_inner()),
            Err(status) => status,
        };
        // With jitter, so that clients that were cut off together do not come back together.
        let jittered = pause.mul_f64(0.5 + fastrand::f64() / 2.0);
        let Some(wait) = delay(&status).map(|delay| delay.saturating_add(jittered)) else {
            return Err(status);
        };
        if wait >= end.saturating_duration_since(Instant::now()) {
            return Err(status);
        }
        tokio::time::sleep(wait).await;
        pause = (pause * 2).min(LONGEST_PAUSE);
    }
}

/// What the server asks to be waited before the call is tried again; none where that does not help.
fn delay(status: &Status) -> Option<Duration> {
    let asked = status.get_details_retry_info().and_then(|info| info.retry_delay);
    asked.or((status.code() == Code::Unavailable).then_some(Duration::ZERO))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tonic_types::ErrorDetails;

    #[test]
    fn what_helps_to_repeat_is_waited_for() {
        let second = Duration::from_secs(1);
        let details = ErrorDetails::with_retry_info(Some(second));
        let full = Status::with_error_details(Code::ResourceExhausted, "full", details);
        assert_eq!(delay(&full), Some(second));
        assert_eq!(delay(&Status::unavailable("gone")), Some(Duration::ZERO));
        assert_eq!(delay(&Status::resource_exhausted("too large")), None);
        assert_eq!(delay(&Status::invalid_argument("wrong")), None);
    }
}
