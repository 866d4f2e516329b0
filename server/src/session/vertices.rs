//! Vertices that sessions keep in memory: all of them together are bounded.

use crate::dispatch::RETRY_AFTER;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use traverse_proto::Refused;

/// Vertices of all sessions, and how many there may be.
#[derive(Clone)]
pub(super) struct Vertices {
    used: Arc<AtomicUsize>,
    limit: usize,
}

/// One session's vertices; dropping it gives them back.
pub(super) struct Share {
    of: Vertices,
    count: usize,
}

impl Vertices {
    pub(super) fn new(limit: usize) -> Self {
        Self { used: Arc::default(), limit }
    }

    pub(super) fn share(&self) -> Share {
        Share { of: self.clone(), count: 0 }
    }
}

impl Share {
    /// Takes more, or gives some back, until there are `count`. What is refused changes nothing.
    pub(super) fn resize(&mut self, count: usize) -> Result<(), Refused> {
        let Some(more) = count.checked_sub(self.count) else {
            self.of.used.fetch_sub(self.count - count, Ordering::Relaxed);
            self.count = count;
            return Ok(());
        };
        let before = self.of.used.fetch_add(more, Ordering::Relaxed);
        if before.saturating_add(more) <= self.of.limit {
            self.count = count;
            return Ok(());
        }
        self.of.used.fetch_sub(more, Ordering::Relaxed);
        let what = format!("sessions keep {before} vertices and may keep {}", self.of.limit);
        Err(Refused::QueueFull { what, retry_after: RETRY_AFTER })
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        self.of.used.fetch_sub(self.count, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_sessions_together_are_bounded() {
        let vertices = Vertices::new(100);
        let (mut one, mut other) = (vertices.share(), vertices.share());
        assert_eq!(one.resize(70), Ok(()));
        assert_eq!(other.resize(40).map_err(|refused| refused.reason()), Err("QUEUE_FULL"));
        assert_eq!(one.resize(60), Ok(()));
        assert_eq!(other.resize(40), Ok(()));
        drop(one);
        assert_eq!(other.resize(100), Ok(()));
        drop(other);
        assert_eq!(vertices.used.load(Ordering::Relaxed), 0);
    }
}
