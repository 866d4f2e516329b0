//! PlanRapidMoves: sessions over one scene that changes.
//!
//! A session's way: its body is read frame by frame (`frames_in`) until a step is whole; all steps that are there by then are
//! a batch. The batch takes its turn on a worker of the pool (`turn`): there its steps are decoded, answered by the
//! session's scene (`stage`) and encoded, one after the other, for a few milliseconds at most; what is left over takes
//! another turn. Between turns no worker is held: the scene waits with the session (`serve`). Answers go out through a
//! channel that holds one piece (`frames_out`); before there is room in it nothing is worked on, and while something is worked
//! on nothing is read: a caller that does not read answers is not read from.
//!
//! tonic is not on this way: it would decode on the async runtime, one message at a time, and could not refuse one step
//! alone whose bytes are no message.

mod frames_in;
mod frames_out;
mod framing;
mod serve;
mod stage;
mod turn;
mod vertices;

pub(crate) use framing::Framing;
pub(crate) use serve::{Opening, Sessions};
