//! Sessions from their opening to their end: admission, deadlines, drain, and the way between body and worker.

use super::Framing;
use super::frames_in::{Batch, FramesIn};
use super::frames_out::{Said, frames_out};
use super::stage::{Stage, Tally};
use super::turn::Turn;
use super::vertices::Vertices;
use crate::buffered::Buffered;
use crate::call::Call;
use crate::config::Config;
use crate::deadline::less_reserve;
use crate::dispatch::{Dispatcher, RETRY_AFTER};
use crate::engines::Engines;
use bytes::BytesMut;
use futures_util::FutureExt;
use http::Response;
use std::panic::AssertUnwindSafe;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::mpsc::Sender;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio_util::sync::CancellationToken;
use tonic::body::Body;
use tonic::{Code, Status};
use traverse_proto::{Procedure, Refused};

/// All sessions of a server.
pub(crate) struct Sessions {
    config: Arc<Config>,
    dispatcher: Arc<Dispatcher>,
    engines: Arc<dyn Engines>,
    buffered: Buffered,
    places: Arc<Semaphore>,
    vertices: Vertices,
    drain: CancellationToken,
}

/// A caller who asks for a session.
pub(crate) struct Opening {
    pub(crate) call: Arc<Call>,
    pub(crate) procedure: Procedure,
    pub(crate) framing: Framing,
    /// How long the caller is ready to wait for all of it.
    pub(crate) timeout: Option<Duration>,
    /// What compressed steps would be compressed by.
    pub(crate) encoding: Option<String>,
    pub(crate) body: Body,
}

/// A session on its way.
struct Session {
    config: Arc<Config>,
    dispatcher: Arc<Dispatcher>,
    drain: CancellationToken,
    call: Arc<Call>,
    deadline: Option<Instant>,
    feed: Sender<Said>,
    /// Given back when the session is over.
    _place: OwnedSemaphorePermit,
}

impl Sessions {
    pub(crate) fn new(
        config: &Arc<Config>,
        dispatcher: &Arc<Dispatcher>,
        engines: &Arc<dyn Engines>,
        buffered: &Buffered,
        drain: &CancellationToken,
    ) -> Self {
        Self {
            places: Arc::new(Semaphore::new(config.session_count.min(Semaphore::MAX_PERMITS))),
            vertices: Vertices::new(config.session_vertex_count),
            config: Arc::clone(config),
            dispatcher: Arc::clone(dispatcher),
            engines: Arc::clone(engines),
            buffered: buffered.clone(),
            drain: drain.clone(),
        }
    }

    /// Opens a session; its response is there at once, its answers follow.
    ///
    /// # Errors
    /// All places are taken, or the server is going down.
    pub(crate) fn open(&self, opening: Opening) -> Result<Response<Body>, Refused> {
        let Opening { call, procedure, framing, timeout, encoding, body } = opening;
        if self.drain.is_cancelled() {
            return Err(Refused::ServerDraining);
        }
        let place = Arc::clone(&self.places).try_acquire_owned().map_err(|_| Refused::QueueFull {
            what: format!("{} sessions are open (GetLimits.session_count)", self.config.session_count),
            retry_after: RETRY_AFTER,
        })?;
        call.note(|facts| (facts.steps, facts.refused_steps) = (Some(0), Some(0)));
        let frames = FramesIn::new(body, &self.buffered, self.config.limits.message_bytes, encoding);
        let (config, engines) = (Arc::clone(&self.config), Arc::clone(&self.engines));
        let stage = Box::new(Stage::new(config, engines, &procedure, self.vertices.share()));
        let turn = Turn {
            procedure,
            framing,
            limits: self.config.limits.clone(),
            stage,
            frames: bytes::Bytes::new(),
            answers: BytesMut::new(),
            tally: Tally::default(),
            fault: None,
        };
        let (feed, said) = frames_out(framing);
        let session = Session {
            config: Arc::clone(&self.config),
            dispatcher: Arc::clone(&self.dispatcher),
            drain: self.drain.clone(),
            deadline: timeout.and_then(|timeout| call.arrival.checked_add(less_reserve(timeout))),
            call,
            feed,
            _place: place,
        };
        tokio::spawn(session.run(frames, turn));
        Ok(framing.response(Body::new(said)))
    }
}

impl Session {
    async fn run(self, frames: FramesIn, turn: Turn) {
        let served = AssertUnwindSafe(self.serve(frames, turn)).catch_unwind().await;
        let ended = served.unwrap_or_else(|panic| Err(crate::fault::of_panic(&*panic)));
        let status = match ended {
            Ok(()) => Status::new(Code::Ok, ""),
            Err(refused) => {
                self.call.refused(&refused);
                refused.to_status()
            }
        };
        self.call.note(|facts| {
            facts.outcome.get_or_insert("steps");
            facts.code.get_or_insert(status.code());
        });
        // A caller who does not even read the end is not waited for.
        tokio::time::timeout(self.config.session_idle, self.feed.send(Said::End(status))).await.ok();
    }

    /// Answers steps until the caller has no more.
    async fn serve(&self, mut frames: FramesIn, mut turn: Turn) -> Result<(), Refused> {
        loop {
            let batch = tokio::select! {
                biased;
                why = self.interrupted() => return Err(why),
                batch = frames.next() => batch?,
                why = self.idle() => return Err(why),
            };
            let Some(Batch { frames: whole, held }) = batch else { return Ok(()) };
            self.call.note(|facts| facts.bytes += whole.len() as u64);
            turn.frames = whole;
            while !turn.frames.is_empty() {
                turn = self.take_turn(turn).await?;
            }
            drop(held);
        }
    }

    /// Answers some of the steps that wait, once there is room for the answers.
    async fn take_turn(&self, turn: Turn) -> Result<Turn, Refused> {
        let room = tokio::select! {
            biased;
            why = self.interrupted() => return Err(why),
            room = self.feed.reserve() => room.map_err(|_| Refused::Cancelled)?,
            why = self.idle() => return Err(why),
        };
        let work = self.dispatcher.run_turn(&self.call, self.deadline, move |budget| Ok(turn.take(budget)));
        let mut turn = tokio::select! {
            turn = work => turn?,
            () = self.feed.closed() => return Err(Refused::Cancelled),
        };
        let tally = turn.tally;
        self.call.note(|facts| {
            (facts.steps, facts.refused_steps) = (Some(tally.steps), Some(tally.refused));
            (facts.vertices, facts.obstacles) = (tally.vertices, tally.obstacles);
        });
        let answers = turn.answers.split().freeze();
        if !answers.is_empty() {
            room.send(Said::Answers(answers));
        }
        match turn.fault.take() {
            Some(fault) => Err(fault),
            None => Ok(turn),
        }
    }

    /// Ends when the session has to: by what.
    async fn interrupted(&self) -> Refused {
        tokio::select! {
            biased;
            () = self.feed.closed() => Refused::Cancelled,
            () = self.drain.cancelled() => Refused::ServerDraining,
            () = until(self.deadline) => Refused::TimeLimitReached { lower_bound: None },
        }
    }

    async fn idle(&self) -> Refused {
        let after = self.config.session_idle;
        tokio::time::sleep(after).await;
        Refused::SessionIdle { after }
    }
}

async fn until(deadline: Option<Instant>) {
    match deadline {
        Some(deadline) => tokio::time::sleep_until(deadline.into()).await,
        None => std::future::pending().await,
    }
}
