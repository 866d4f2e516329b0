//! What every engine shares about effort: how long it may work ([`Budget`]), how hard it should try ([`Effort`]),
//! whom it tells ([`Observer`]), what it says at the end ([`Report`]), and where its chances come from ([`Seed`]).
//!
//! Engines are pure functions of specification and effort; `Budget` and `Observer` are their only contact with time.
//!
//! ```
//! use traverse_solve::{Budget, Interrupt};
//! let budget = Budget { iterations: Some(10), ..Budget::unlimited() };
//! assert_eq!(budget.check(9), Ok(()));
//! assert_eq!(budget.check(10), Err(Interrupt::Iterations));
//! ```

mod budget;
mod effort;
mod observer;
mod report;
mod seed;

pub use budget::{Budget, CancelToken, Interrupt};
pub use effort::Effort;
pub use observer::{Observer, Silent, Trace};
pub use report::{Report, StopReason};
pub use seed::Seed;
