//! Request bodies read into memory: each bounded, all of them together bounded.

use crate::dispatch::RETRY_AFTER;
use bytes::{Bytes, BytesMut};
use http_body::Body;
use http_body_util::BodyExt;
use std::pin::pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use traverse_proto::Refused;

/// Bytes of all requests that are in memory, and how many there may be.
#[derive(Clone)]
pub(crate) struct Buffered {
    used: Arc<AtomicUsize>,
    limit: usize,
}

/// Bytes that are held; dropping it gives them back.
pub(crate) struct Held {
    of: Buffered,
    bytes: usize,
}

/// What of a body is still to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// All of it.
    Rest,
    /// It is there, although its end was not told yet.
    Nothing,
}

impl Buffered {
    pub(crate) fn new(limit: usize) -> Self {
        Self { used: Arc::default(), limit }
    }

    pub(crate) fn hold(&self) -> Held {
        Held { of: self.clone(), bytes: 0 }
    }

    /// Reads a body: `framing` bytes and a message of at most `limit`. `inspect` sees what has come so far, may refuse
    /// it early, and says whether it is enough.
    pub(crate) async fn read<B>(
        &self,
        body: B,
        framing: usize,
        limit: usize,
        inspect: impl Fn(&[u8]) -> Result<Wanted, Refused>,
    ) -> Result<(Bytes, Held), Refused>
    where
        B: Body<Data = Bytes>,
        B::Error: std::fmt::Display,
    {
        let mut held = self.hold();
        let mut read = BytesMut::new();
        let mut body = pin!(body);
        let fits = |bytes: u64| match bytes.saturating_sub(framing as u64) {
            bytes if bytes > limit as u64 => Err(Refused::MessageTooLarge { bytes, limit }),
            _ => Ok(()),
        };
        fits(body.size_hint().lower())?;
        while let Some(frame) = body.frame().await {
            let frame = frame.map_err(|error| Refused::MalformedMessage {
                detail: format!("the request broke off after {} bytes: {error}", read.len()),
            })?;
            let Ok(data) = frame.into_data() else { continue };
            fits((read.len() + data.len()) as u64)?;
            held.grow(data.len())?;
            read.extend_from_slice(&data);
            if inspect(&read)? == Wanted::Nothing {
                break;
            }
        }
        Ok((read.freeze(), held))
    }
}

impl Held {
    /// What is held of so many bytes, to be given back by itself.
    pub(crate) fn part(&mut self, bytes: usize) -> Self {
        let bytes = bytes.min(self.bytes);
        self.bytes -= bytes;
        Self { of: self.of.clone(), bytes }
    }

    /// Holds more; what is refused is held until this is dropped.
    pub(crate) fn grow(&mut self, by: usize) -> Result<(), Refused> {
        let before = self.of.used.fetch_add(by, Ordering::Relaxed);
        self.bytes += by;
        if before.saturating_add(by) <= self.of.limit {
            return Ok(());
        }
        let what = format!("requests of {before} bytes are in memory and {} may be", self.of.limit);
        Err(Refused::QueueFull { what, retry_after: RETRY_AFTER })
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        self.of.used.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use http_body_util::Full;

    async fn read(buffered: &Buffered, bytes: usize, limit: usize) -> Result<(Bytes, Held), Refused> {
        buffered.read(Full::new(Bytes::from(vec![0; bytes])), 0, limit, |_| Ok(Wanted::Rest)).await
    }

    #[tokio::test]
    async fn one_body_and_all_bodies_are_bounded() {
        let buffered = Buffered::new(100);
        assert_eq!(
            read(&buffered, 51, 50).await.err().map(|refused| refused.reason()),
            Some("MESSAGE_TOO_LARGE")
        );
        let first = read(&buffered, 50, 50).await.expect("fits");
        let second = read(&buffered, 50, 50).await.expect("fits");
        assert_eq!(read(&buffered, 1, 50).await.err().map(|refused| refused.reason()), Some("QUEUE_FULL"));
        drop(first);
        drop(read(&buffered, 50, 50).await.expect("there is room again"));
        drop(second);
        assert_eq!(buffered.used.load(Ordering::Relaxed), 0);
    }
}
