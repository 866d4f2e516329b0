//! One call on its way through the house: when it came, until when it has to be answered, and what the log will say.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use tonic::Code;
use traverse_proto::Refused;

/// How the caller speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Protocol {
    Grpc,
    GrpcWeb,
    Json,
    Proto,
}

impl Protocol {
    pub(crate) fn as_str(self) -> &'static str {
        match self {
            Self::Grpc => "grpc",
            Self::GrpcWeb => "grpc-web",
            Self::Json => "json",
            Self::Proto => "proto",
        }
    }
}

/// What is known of a call once it is over.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facts {
    /// Bytes of the request as the caller sent it.
    pub(crate) bytes: u64,
    pub(crate) vertices: usize,
    pub(crate) obstacles: usize,
    /// Steps that were answered, if it is a session, and how many of them were refused.
    pub(crate) steps: Option<u64>,
    pub(crate) refused_steps: Option<u64>,
    /// What came of it: `plan`, `no_path`, `violations`, `steps`, the reason of a refusal.
    pub(crate) outcome: Option<&'static str>,
    pub(crate) code: Option<Code>,
    /// Waited for a free worker.
    pub(crate) queued: Duration,
    /// Spent on a worker.
    pub(crate) worked: Duration,
}

/// One call. Shared by everything that it passes.
#[derive(Debug)]
pub(crate) struct Call {
    pub(crate) arrival: Instant,
    pub(crate) protocol: Protocol,
    facts: Mutex<Facts>,
}

impl Call {
    pub(crate) fn new(protocol: Protocol) -> Self {
        Self { arrival: Instant::now(), protocol, facts: Mutex::default() }
    }

    pub(crate) fn note(&self, change: impl FnOnce(&mut Facts)) {
        change(&mut self.facts.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// Notes why the call is refused. The first reason stays: what follows from it is not news.
    pub(crate) fn refused(&self, refused: &Refused) {
        self.note(|facts| {
            facts.outcome.get_or_insert(refused.reason());
            facts.code.get_or_insert(refused.code());
        });
    }

    pub(crate) fn facts(&self) -> Facts {
        self.facts.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
