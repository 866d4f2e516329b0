//! The contract: what goes over the wire, and the only place where it meets the domain.
//!
//! - [`v1`] is generated from `proto/traverse/v1`; [`FILE_DESCRIPTOR_SET`] describes it to reflection.
//! - `decode` turns a request into a validated domain type once, with every finding reported, or refuses it.
//! - `encode` turns an answer of an engine into its message.
//! - [`Refused`] is every way in which a call can fail; [`Refused::to_status`] is the one place where that becomes a
//!   gRPC status.
//! - [`json`] is canonical proto3 JSON for every message of the contract.
//!
//! ```
//! use traverse_proto::{Limits, PlanQuestion, v1};
//! use traverse_solve::Budget;
//!
//! let request = v1::PlanRapidMoveRequest {
//!     start: Some(v1::Point { x_mm: f64::NAN, y_mm: 0.0 }),
//!     ..Default::default()
//! };
//! let refused = PlanQuestion::from_wire(request, &Limits::default(), &Budget::unlimited()).unwrap_err();
//! assert_eq!(refused.reason(), "INVALID_REQUEST");
//! assert_eq!(refused.findings().iter().map(|f| f.field.as_str()).collect::<Vec<_>>(), ["start.x_mm", "target"]);
//! ```

pub mod codec;
mod count;
mod decode;
mod encode;
mod inside_end;
pub mod json;
mod limits;
mod refused;
mod schema;
mod status;
mod text;

/// Generated from `proto/traverse/v1`; the comments are the contract's.

#[allow(
    missing_docs,
    clippy::all,
    clippy::unwrap_used,
    clippy::uninlined_format_args,
    clippy::semicolon_if_nothing_returned,
    clippy::redundant_closure_for_method_calls,
    unreachable_pub,
    rustdoc::invalid_html_tags,
    rustdoc::broken_intra_doc_links,
    reason = "generated"
)]
pub mod v1 {
    tonic::include_proto!("traverse.v1");
}

/// The contract as an encoded `google.protobuf.FileDescriptorSet`, with everything that it imports.
pub const FILE_DESCRIPTOR_SET: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/traverse.bin"));

pub use count::check_counts;
pub use decode::{
    CheckQuestion, CheckSectionsQuestion, OrderQuestion, OrderReturns, PlanQuestion, ToolChangeQuestion,
    order_from_wire, path_from_wire, requested_order_time_limit, requested_time_limit, rules_time_limit,
};
pub use encode::{
    CountedLimit, Improvement, SearchFacts, check_answer, check_request, check_sections_answer,
    check_sections_request, order_answer, order_request, plan_answer, plan_request, sound_answer,
    sound_order_answer, tool_change_answer, tool_change_request,
};
pub use inside_end::{InsideEnd, ShutInEnd};
pub use limits::Limits;
pub use refused::{REASONS, Refused};
pub use schema::{PLANNER_SERVICE, Procedure};
pub use status::{DOMAIN, FINDINGS_BYTES};
