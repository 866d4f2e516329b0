//! The one place where a refusal becomes a gRPC status: code, message for people, details for programs.
//!
//! Details travel in HTTP headers, which common clients cap at 8 KiB. So findings are listed in order until
//! [`FINDINGS_BYTES`] are used; `findings_omitted` says how many are not.

use crate::{InsideEnd, Refused, text::shortened};
use std::collections::HashMap;
use tonic::{Code, Status};
use tonic_types::{ErrorDetails, FieldViolation, StatusExt};
use traverse_geometry::Finding;

/// Domain of every reason.
pub const DOMAIN: &str = "traverse.v1";

/// Most bytes of findings that one status carries.
pub const FINDINGS_BYTES: usize = 4096;

/// Longest text about one finding, bytes.
const DESCRIPTION_BYTES: usize = 400;

impl Refused {
    /// Its gRPC code.
    #[must_use]
    pub fn code(&self) -> Code {
        match self {
            Self::InvalidRequest { .. }
            | Self::EndInsideBarrier { .. }
            | Self::EndShutIn { .. }
            | Self::NoRoomForDogLegs
            | Self::PublishedMethodNotApplicable { .. }
            | Self::MalformedMessage { .. }
            | Self::MalformedJson { .. }
            | Self::MalformedHeader { .. } => Code::InvalidArgument,
            Self::MessageTooLarge { .. }
            | Self::AnswerTooLarge { .. }
            | Self::IterationLimitReached { .. }
            | Self::SearchTooLarge { .. }
            | Self::QueueFull { .. } => Code::ResourceExhausted,
            Self::TimeLimitReached { .. } | Self::SessionIdle { .. } => Code::DeadlineExceeded,
            Self::SceneStale { .. } => Code::FailedPrecondition,
            Self::ServerDraining => Code::Unavailable,
            Self::Cancelled => Code::Cancelled,
            Self::UnknownMethod { .. } | Self::UnsupportedEncoding { .. } => Code::Unimplemented,
            Self::Internal { .. } => Code::Internal,
        }
    }

    /// Its status, with ErrorInfo always, BadRequest for what can be mended in the request, RetryInfo where trying
    /// again helps.
    #[must_use]
    pub fn to_status(&self) -> Status {
        let mut details = ErrorDetails::new();
        let (violations, omitted) = self.field_violations();
        let mut metadata = self.metadata();
        if omitted > 0 {
            metadata.insert("findings_omitted".to_owned(), omitted.to_string());
        }
        details.set_error_info(self.reason(), DOMAIN, metadata);
        if !violations.is_empty() {
            details.set_bad_request(violations);
        }
        if let Self::QueueFull { retry_after, .. } = self {
            details.set_retry_info(Some(*retry_after));
        }
        Status::with_error_details(self.code(), shortened(&self.message(), 2 * DESCRIPTION_BYTES), details)
    }

    /// For people: what is wrong and what to do.
    #[must_use]
    pub fn message(&self) -> String {
        match self {
            Self::InvalidRequest { findings } => counted(findings.len(), findings.first()),
            Self::EndInsideBarrier { ends } => counted(ends.len(), ends.first()),
            Self::EndShutIn { ends, inside } => counted(ends.len() + inside.len(), ends.first()),
            Self::NoRoomForDogLegs => {
                "every way leads through a passage with no room for dog-legs: lower the clearance, or run straight moves as G1 \
                 and ask for RAPID_MOTION_LINEAR"
                    .to_owned()
            }
            Self::PublishedMethodNotApplicable { why } => {
                format!("the published supporting-line scan does not cover this request: {why}; use RAPID_ALGORITHM_EXACT")
            }
            Self::MalformedMessage { detail } => {
                format!("the bytes are not the message that this call takes: {detail}; generate the client from proto/traverse/v1")
            }
            Self::MalformedJson { detail } => {
                format!("the text is not proto3 JSON of the message that this call takes: {detail}")
            }
            Self::MalformedHeader { detail } => detail.clone(),
            Self::MessageTooLarge { bytes, limit } => format!(
                "the request has at least {bytes} bytes and may have {limit} (GetLimits.message_bytes): send fewer vertices or split it"
            ),
            Self::AnswerTooLarge { bytes, limit } => format!(
                "the answer has {bytes} bytes and may have {limit} (GetLimits.message_bytes): ask for less at a time"
            ),
            Self::TimeLimitReached { .. } => {
                "the time limit was reached before an answer was proven: give options.time_limit (rules.options.time_limit of a rapid \
                 move) or the call's deadline more time, or send fewer vertices"
                    .to_owned()
            }
            Self::SearchTooLarge { .. } => {
                "the search outgrew the memory that it may use; leave out obstacles that are far from the way, or simplify \
                 their outlines"
                    .to_owned()
            }
            Self::IterationLimitReached { .. } => {
                "the iteration limit was reached before an answer was proven: raise options.iteration_limit (rules.options.iteration_limit \
                 of a rapid move)"
                    .to_owned()
            }
            Self::QueueFull { what, retry_after } => {
                format!("{what}: try again in {} ms", retry_after.as_millis())
            }
            Self::SceneStale { why } => (*why).to_owned(),
            Self::SessionIdle { after } => format!(
                "the session has had no step, or its answers no reader, for {} s: open another one when there is more to plan",
                after.as_secs()
            ),
            Self::ServerDraining => "the server is going down: call another one, or this one when it is back".to_owned(),
            Self::Cancelled => "the caller cancelled the call".to_owned(),
            Self::UnknownMethod { path } => {
                format!("there is no call {}: reflection lists the calls of this server", shortened(path, 200))
            }
            Self::UnsupportedEncoding { encoding } => {
                format!("encoding {} is not supported: send it uncompressed (identity)", shortened(encoding, 100))
            }
            Self::Internal { id } => {
                format!("a fault of the server, logged as {id}: the same request will fail again; report it with this id")
            }
        }
    }

    /// What can be mended in the request, as far as it fits into a status, and how much does not.
    fn field_violations(&self) -> (Vec<FieldViolation>, usize) {
        match self {
            Self::InvalidRequest { findings } => bounded(findings, of_finding),
            Self::EndInsideBarrier { ends } => bounded(ends, |end| of_end(end, self.reason())),
            Self::EndShutIn { ends, inside } => {
                let (mut listed, omitted) =
                    bounded(ends, |end| violation(&end.field, end.to_string(), self.reason()));
                let (more, more_omitted) = bounded(inside, |end| of_end(end, "END_INSIDE_BARRIER"));
                listed.extend(more);
                (listed, omitted + more_omitted)
            }
            Self::NoRoomForDogLegs => (vec![violation("rules.motion", self.message(), self.reason())], 0),
            Self::PublishedMethodNotApplicable { .. } => {
                (vec![violation("rules.algorithm", self.message(), self.reason())], 0)
            }
            _ => (Vec::new(), 0),
        }
    }

    fn metadata(&self) -> HashMap<String, String> {
        let pairs: Vec<(&str, String)> = match self {
            Self::EndInsideBarrier { ends } => ends.first().map_or_else(Vec::new, |end| {
                vec![
                    ("field", end.field.clone().into_owned()),
                    ("obstacle_id", shortened(&end.obstacle, DESCRIPTION_BYTES)),
                    ("depth_mm", end.depth_mm.to_string()),
                ]
            }),
            Self::EndShutIn { ends, .. } => ends.first().map_or_else(Vec::new, |end| {
                vec![
                    ("field", end.field.clone().into_owned()),
                    ("obstacle_id", shortened(&end.obstacle, DESCRIPTION_BYTES)),
                    ("why", end.why.to_owned()),
                ]
            }),
            Self::PublishedMethodNotApplicable { why } => vec![("why", (*why).to_owned())],
            Self::MessageTooLarge { bytes, limit } => {
                vec![("bytes", bytes.to_string()), ("limit_bytes", limit.to_string())]
            }
            Self::AnswerTooLarge { bytes, limit } => {
                vec![("bytes", bytes.to_string()), ("limit_bytes", limit.to_string())]
            }
            Self::TimeLimitReached { lower_bound: Some(bound) } => vec![("lower_bound", bound.to_string())],
            Self::IterationLimitReached { lower_bound } | Self::SearchTooLarge { lower_bound } => {
                vec![("lower_bound", lower_bound.to_string())]
            }
            Self::Internal { id } => vec![("id", id.clone())],
            _ => Vec::new(),
        };
        pairs.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
    }
}

fn counted<T: std::fmt::Display>(count: usize, first: Option<&T>) -> String {
    match (count, first) {
        (_, None) => "the request is not valid".to_owned(),
        (1, Some(only)) => only.to_string(),
        (count, Some(first)) => format!("{first} (the first of {count} findings; the details list them)"),
    }
}

fn bounded<T>(items: &[T], describe: impl Fn(&T) -> FieldViolation) -> (Vec<FieldViolation>, usize) {
    let mut listed = Vec::new();
    let mut bytes = 0;
    for item in items {
        let next = describe(item);
        bytes += next.field.len() + next.description.len() + next.reason.len();
        if bytes > FINDINGS_BYTES && !listed.is_empty() {
            break;
        }
        listed.push(next);
    }
    let omitted = items.len() - listed.len();
    (listed, omitted)
}

fn of_finding(finding: &Finding) -> FieldViolation {
    violation(&finding.field, finding.message.clone(), finding.reason.as_str())
}

fn of_end(end: &InsideEnd, reason: &str) -> FieldViolation {
    violation(&end.field, end.to_string(), reason)
}

fn violation(field: &str, description: String, reason: &str) -> FieldViolation {
    let mut violation =
        FieldViolation::new(shortened(field, DESCRIPTION_BYTES), shortened(&description, DESCRIPTION_BYTES));
    violation.reason = reason.to_owned();
    violation
}
