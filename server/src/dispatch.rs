//! From an async handler to a worker and back: admission, deadline, cancel and panics in one place.

use crate::call::Call;
use crate::deadline::STOP_GRACE;
use crate::pool::{Entry, Pool, QueueFull};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::oneshot;
use tokio_util::sync::CancellationToken;
use traverse_proto::Refused;
use traverse_solve::{Budget, CancelToken};

/// When a caller who found the queue full may try again.
pub const RETRY_AFTER: Duration = Duration::from_secs(1);

/// Hands work to the pool and waits for it, as long as anybody wants it.
pub(crate) struct Dispatcher {
    pub(crate) pool: Pool,
    /// Raised when the server's grace is over: every call is answered at once.
    pub(crate) hard_stop: CancellationToken,
}

impl Dispatcher {
    /// Runs `work` on a worker. It gets a budget that ends at `deadline` and when this future is dropped.
    ///
    /// # Errors
    /// What `work` says; that the queue is full; that the deadline has passed; that the server stops; or, when `work`
    /// panics, that it did.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        call: &Arc<Call>,
        deadline: Option<Instant>,
        work: impl FnOnce(&Budget) -> Result<T, Refused> + Send + 'static,
    ) -> Result<T, Refused> {
        self.run_by(Entry::Call, call, deadline, work).await
    }

    /// The same for a turn of a session, which the queue takes in always: there are not more of them than sessions.
    ///
    /// # Errors
    /// As [`Dispatcher::run`], but that the queue is full.
    pub(crate) async fn run_turn<T: Send + 'static>(
        &self,
        call: &Arc<Call>,
        deadline: Option<Instant>,
        work: impl FnOnce(&Budget) -> Result<T, Refused> + Send + 'static,
    ) -> Result<T, Refused> {
        self.run_by(Entry::Turn, call, deadline, work).await
    }

    async fn run_by<T: Send + 'static>(
        &self,
        entry: Entry,
        call: &Arc<Call>,
        deadline: Option<Instant>,
        work: impl FnOnce(&Budget) -> Result<T, Refused> + Send + 'static,
    ) -> Result<T, Refused> {
        let cancel = CancelToken::new();
        let budget = Budget { deadline, iterations: None, cancel: cancel.clone() };
        let (answer, answered) = oneshot::channel();
        let queued_at = Instant::now();
        let facts = Arc::clone(call);
        let ticket = self.pool.submit(entry, cancel, move || {
            let begun_at = Instant::now();
            let result = catch_unwind(AssertUnwindSafe(|| work(&budget)));
            facts.note(|facts| {
                facts.queued += begun_at.duration_since(queued_at);
                facts.worked += begun_at.elapsed();
            });
            // Nobody may be waiting any more.
            answer.send(result.unwrap_or_else(|panic| Err(crate::fault::of_panic(&*panic)))).ok();
        });
        let _ticket = ticket.map_err(queue_full)?;
        tokio::select! {
            biased;
            result = answered => result.unwrap_or(Err(Refused::Cancelled)),
            () = over(deadline) => Err(Refused::TimeLimitReached { lower_bound: None }),
            () = self.hard_stop.cancelled() => Err(Refused::ServerDraining),
        }
    }
}

fn queue_full(QueueFull { capacity }: QueueFull) -> Refused {
    let what = format!("every core is busy and {capacity} calls wait (GetLimits.queued_call_count)");
    Refused::QueueFull { what, retry_after: RETRY_AFTER }
}

/// Ends when an engine that keeps to the deadline has answered long ago.
async fn over(deadline: Option<Instant>) {
    match deadline.and_then(|deadline| deadline.checked_add(STOP_GRACE)) {
        Some(end) => tokio::time::sleep_until(end.into()).await,
        None => std::future::pending().await,
    }
}
