//! A session's steps as they come in: each bounded, and no more at once than a batch.

use crate::buffered::{Buffered, Held};
use crate::frame;
use bytes::{Bytes, BytesMut};
use futures_util::FutureExt;
use http_body::Body as _;
use http_body_util::BodyExt;
use tonic::body::Body;
use traverse_proto::Refused;

/// Nothing more is read once steps of so many bytes wait.
const BATCH_BYTES: usize = 64 * 1024;

/// Reads whole frames from a body.
pub(super) struct FramesIn {
    body: Body,
    read: BytesMut,
    held: Held,
    limit: usize,
    encoding: Option<String>,
    is_over: bool,
    /// Why nothing more can be read; told once the whole frames before it were given out.
    refused: Option<Refused>,
}

/// Whole frames, one after the other; what they hold in memory is given back with them.
pub(super) struct Batch {
    pub(super) frames: Bytes,
    pub(super) held: Held,
}

impl FramesIn {
    /// Messages of at most `limit` bytes; `encoding` is what the caller says compressed ones are compressed by.
    pub(super) fn new(body: Body, buffered: &Buffered, limit: usize, encoding: Option<String>) -> Self {
        let (read, held) = (BytesMut::new(), buffered.hold());
        Self { body, read, held, limit, encoding, is_over: false, refused: None }
    }

    /// All whole frames that are there, as soon as there is one; none when the caller has said all. May be dropped and
    /// called again.
    ///
    /// # Errors
    /// What came is no frame, or too large; or there is no memory for it.
    pub(super) async fn next(&mut self) -> Result<Option<Batch>, Refused> {
        loop {
            self.read_what_is_there();
            let whole = self.whole()?;
            if whole > 0 {
                let frames = self.read.split_to(whole).freeze();
                return Ok(Some(Batch { held: self.held.part(frames.len()), frames }));
            }
            if let Some(refused) = self.refused.take() {
                return Err(refused);
            }
            if self.is_over {
                return if self.read.is_empty() { Ok(None) } else { Err(self.broken("the caller ended it")) };
            }
            let frame = self.body.frame().await;
            self.refused = self.take(frame).err();
        }
    }

    fn read_what_is_there(&mut self) {
        while !self.is_over && self.refused.is_none() && self.read.len() < BATCH_BYTES {
            let Some(frame) = self.body.frame().now_or_never() else { break };
            self.refused = self.take(frame).err();
        }
    }

    fn take(&mut self, frame: Option<Result<http_body::Frame<Bytes>, tonic::Status>>) -> Result<(), Refused> {
        match frame {
            None => self.is_over = true,
            Some(Err(error)) => return Err(self.broken(&error.to_string())),
            Some(Ok(frame)) => {
                if let Ok(data) = frame.into_data() {
                    self.held.grow(data.len())?;
                    self.read.extend_from_slice(&data);
                }
                self.is_over = self.body.is_end_stream();
            }
        }
        Ok(())
    }

    /// Bytes of the whole frames at the front.
    fn whole(&self) -> Result<usize, Refused> {
        let mut whole = 0;
        loop {
            let rest = &self.read[whole..];
            if let Err(refused) = frame::check_head(rest, self.limit, self.encoding.as_deref()) {
                return if whole > 0 { Ok(whole) } else { Err(refused) };
            }
            let Some(length) = frame::length(rest) else { return Ok(whole) };
            if rest.len() < length || whole >= BATCH_BYTES {
                return Ok(whole);
            }
            whole += length;
        }
    }

    fn broken(&self, why: &str) -> Refused {
        let detail = format!("the session broke off {} bytes into a step: {why}", self.read.len());
        Refused::MalformedMessage { detail }
    }
}
