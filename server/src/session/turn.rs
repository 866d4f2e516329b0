//! One turn of a session on a worker: steps answered one after the other, for a few milliseconds at most.

use super::Framing;
use super::stage::{Stage, Tally, refusal};
use crate::frame;
use bytes::{Buf, Bytes, BytesMut};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};
use traverse_proto::v1::PlanRapidMovesResponse;
use traverse_proto::{Limits, Procedure, Refused};
use traverse_solve::Budget;

/// After this long the next in the queue is let at the worker, once the step at hand is answered.
const LENGTH: Duration = Duration::from_millis(10);

/// Answers of so many bytes are sent before more are made.
const ANSWER_BYTES: usize = 64 * 1024;

/// What a session brings to its turn and takes away from it.
pub(super) struct Turn {
    pub(super) procedure: Procedure,
    pub(super) framing: Framing,
    pub(super) limits: Limits,
    pub(super) stage: Box<Stage>,
    /// Whole frames that wait.
    pub(super) frames: Bytes,
    /// What was made of those that did.
    pub(super) answers: BytesMut,
    pub(super) tally: Tally,
    /// The last step panicked; the session can't go on.
    pub(super) fault: Option<Refused>,
}

impl Turn {
    /// Answers steps until the turn or the budget is over, or enough answers wait.
    pub(super) fn take(mut self, budget: &Budget) -> Self {
        let begun = Instant::now();
        while !self.frames.is_empty() && budget.check(0).is_ok() {
            let message = next_message(&mut self.frames);
            let answered = catch_unwind(AssertUnwindSafe(|| self.answer(message, budget)));
            if let Err(panic) = answered {
                self.fault = Some(crate::fault::of_panic(&*panic));
                break;
            }
            if begun.elapsed() >= LENGTH || self.answers.len() >= ANSWER_BYTES {
                break;
            }
        }
        self
    }

    fn answer(&mut self, message: Bytes, budget: &Budget) {
        let encoded = self.framing.step(&self.procedure, message, &self.limits);
        let answer = self.stage.answer(encoded, budget, &mut self.tally);
        if let Err(refused) = self.put(&answer) {
            let short = PlanRapidMovesResponse { step_id: answer.step_id, ..refusal(&refused) };
            self.tally.refused += 1;
            // An answer that says no more than that is within every limit.
            self.put(&short).ok();
        }
    }

    fn put(&mut self, answer: &PlanRapidMovesResponse) -> Result<(), Refused> {
        self.framing.put(&self.procedure, answer, self.limits.message_bytes, &mut self.answers)
    }
}

/// The message of the first of some whole frames.
fn next_message(frames: &mut Bytes) -> Bytes {
    let length = frame::length(frames).unwrap_or(frames.len()).min(frames.len());
    let mut frame = frames.split_to(length);
    frame.advance(frame::HEADER.min(length));
    frame
}
