//! Every way in which a call can fail: one closed enum, one reason each, one section in docs/errors.md each.

use crate::{InsideEnd, ShutInEnd};
use std::time::Duration;
use traverse_geometry::Finding;
use traverse_planner::{DistanceEnd, DistanceQuery, DistancesRefusal, Refusal};
use traverse_solve::Interrupt;

macro_rules! refusals {
    ($($(#[$doc:meta])* $name:ident $({ $($(#[$field_doc:meta])* $field:ident: $type:ty,)* })? = $reason:literal,)*) => {
        /// Why a call is refused. Closed: each reason has a section in docs/errors.md.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Refused { $($(#[$doc])* $name $({ $($(#[$field_doc])* $field: $type,)* })?,)* }

        /// Every reason of a refused call, in the order of the documentation.
        pub const REASONS: &[&str] = &[$($reason,)*];

        impl Refused {
            /// The reason on the wire, UPPER_SNAKE_CASE.
            #[must_use]
            pub fn reason(&self) -> &'static str {
                match self { $(Self::$name { .. } => $reason,)* }
            }
        }
    };
}

refusals! {
    /// Values of the request are wrong.
    InvalidRequest {
        /// All of them.
        findings: Vec<Finding>,
    } = "INVALID_REQUEST",
    /// Start, target or both lie inside a barrier.
    EndInsideBarrier {
        /// Each end and each barrier that it lies in.
        ends: Vec<InsideEnd>,
    } = "END_INSIDE_BARRIER",
    /// Start, target or both lie inside a barrier, and no way that the rules permit leads out.
    EndShutIn {
        /// Each such end.
        ends: Vec<ShutInEnd>,
        /// The other end, where it lies inside barriers that it may not leave.
        inside: Vec<InsideEnd>,
    } = "END_SHUT_IN",
    /// Every way leads through a passage that has no room for dog-legs.
    NoRoomForDogLegs = "NO_ROOM_FOR_DOG_LEGS",
    /// The published scan does not cover the request.
    PublishedMethodNotApplicable {
        /// What it does not cover.
        why: &'static str,
    } = "PUBLISHED_METHOD_NOT_APPLICABLE",
    /// The bytes are not the message that the call takes.
    MalformedMessage {
        /// What is wrong with them.
        detail: String,
    } = "MALFORMED_MESSAGE",
    /// The text is not JSON, or not JSON of the message that the call takes.
    MalformedJson {
        /// What is wrong with it, and where.
        detail: String,
    } = "MALFORMED_JSON",
    /// A header of the request can't be understood.
    MalformedHeader {
        /// Which one, its value, what it should be.
        detail: String,
    } = "MALFORMED_HEADER",
    /// The request exceeds the message limit.
    MessageTooLarge {
        /// Its size, as far as it is known, bytes.
        bytes: u64,
        /// The limit, bytes.
        limit: usize,
    } = "MESSAGE_TOO_LARGE",
    /// The answer exceeds the message limit.
    AnswerTooLarge {
        /// Its size, bytes.
        bytes: usize,
        /// The limit, bytes.
        limit: usize,
    } = "ANSWER_TOO_LARGE",
    /// The time was over before the engine was done.
    TimeLimitReached {
        /// Known so far: no plan costs less. Absent: the engine had not begun, or finds no bounds.
        lower_bound: Option<f64>,
    } = "TIME_LIMIT_REACHED",
    /// The iterations were used up before the engine was done.
    IterationLimitReached {
        /// Known so far: no plan costs less.
        lower_bound: f64,
    } = "ITERATION_LIMIT_REACHED",
    /// The search outgrew the memory that it may use.
    SearchTooLarge {
        /// Known so far: no plan costs less.
        lower_bound: f64,
    } = "SEARCH_TOO_LARGE",
    /// Every core is busy and nothing more may wait.
    QueueFull {
        /// What is full, and its limit.
        what: String,
        /// When to try again.
        retry_after: Duration,
    } = "QUEUE_FULL",
    /// A step of a session asks for a scene that does not count.
    SceneStale {
        /// Why it does not.
        why: &'static str,
    } = "SCENE_STALE",
    /// A session was left alone for too long.
    SessionIdle {
        /// For how long.
        after: Duration,
    } = "SESSION_IDLE",
    /// The server is going down.
    ServerDraining = "SERVER_DRAINING",
    /// The caller no longer wants the answer.
    Cancelled = "CANCELLED",
    /// There is no such call.
    UnknownMethod {
        /// What was asked for.
        path: String,
    } = "UNKNOWN_METHOD",
    /// The request is compressed or in an encoding that this server does not read.
    UnsupportedEncoding {
        /// Which.
        encoding: String,
    } = "UNSUPPORTED_ENCODING",
    /// A fault of the server.
    Internal {
        /// Stands in the server's log beside what happened.
        id: String,
    } = "INTERNAL",
}

impl Refused {
    /// A request with these findings.
    #[must_use]
    pub fn findings_of(findings: Vec<Finding>) -> Self {
        Self::InvalidRequest { findings }
    }

    /// What is wrong with the request's values; empty when that is not the trouble.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        match self {
            Self::InvalidRequest { findings } => findings,
            _ => &[],
        }
    }

    /// The answer to an engine that had to stop.
    #[must_use]
    pub fn interrupted(interrupt: Interrupt, lower_bound: Option<f64>) -> Self {
        match interrupt {
            Interrupt::Deadline => Self::TimeLimitReached { lower_bound },
            Interrupt::Iterations => Self::IterationLimitReached { lower_bound: lower_bound.unwrap_or(0.0) },
            Interrupt::Cancelled => Self::Cancelled,
            Interrupt::Memory => Self::SearchTooLarge { lower_bound: lower_bound.unwrap_or(0.0) },
        }
    }

    /// The planner's refusals as one. Ends inside barriers go first: they are what the caller can mend.
    ///
    /// Absent when there are none.
    #[must_use]
    pub fn by_planner(refusals: Vec<Refusal>) -> Option<Self> {
        let (mut ends, mut shut_in) = (Vec::new(), Vec::new());
        let mut other = None;
        for refusal in refusals {
            match refusal {
                Refusal::EndInsideBarrier { field, obstacle, depth_mm } => {
                    ends.push(InsideEnd { field: field.into(), obstacle, depth_mm });
                }
                Refusal::EndShutIn { field, obstacle, why } => {
                    shut_in.push(ShutInEnd { field: field.into(), obstacle, why });
                }
                Refusal::NoRoomForDogLegs => {
                    other.get_or_insert(Self::NoRoomForDogLegs);
                }
                Refusal::PublishedMethodNotApplicable { why } => {
                    other.get_or_insert(Self::PublishedMethodNotApplicable { why });
                }
                Refusal::Interrupted { interrupt, lower_bound } => {
                    other.get_or_insert(Self::interrupted(interrupt, Some(lower_bound)));
                }
            }
        }
        match (shut_in.is_empty(), ends.is_empty()) {
            (false, _) => Some(Self::EndShutIn { ends: shut_in, inside: ends }),
            (true, false) => Some(Self::EndInsideBarrier { ends }),
            (true, true) => other,
        }
    }

    /// Why distances can't be given; `query` is what was asked for.
    #[must_use]
    pub fn by_distances(refusal: DistancesRefusal, query: &DistanceQuery) -> Self {
        let (mut inside, mut shut_in) = (Vec::new(), Vec::new());
        let ends = match refusal {
            DistancesRefusal::Ends(ends) => ends,
            DistancesRefusal::Move(refusal) => return Self::of_move(refusal),
            DistancesRefusal::Interrupted(interrupt) => return Self::interrupted(interrupt, None),
        };
        for (end, refusal) in ends {
            let field = match end {
                DistanceEnd::To(i) if !query.to.is_empty() => format!("to_xy_mm[{}]", 2 * i),
                DistanceEnd::From(i) | DistanceEnd::To(i) => format!("from_xy_mm[{}]", 2 * i),
            };
            match refusal {
                Refusal::EndInsideBarrier { obstacle, depth_mm, .. } => {
                    inside.push(InsideEnd { field: field.into(), obstacle, depth_mm });
                }
                Refusal::EndShutIn { obstacle, why, .. } => {
                    shut_in.push(ShutInEnd { field: field.into(), obstacle, why });
                }
                other => return Self::of_move(other),
            }
        }
        if shut_in.is_empty() {
            Self::EndInsideBarrier { ends: inside }
        } else {
            Self::EndShutIn { ends: shut_in, inside }
        }
    }

    /// One refusal of the planner.
    fn of_move(refusal: Refusal) -> Self {
        match refusal {
            Refusal::EndInsideBarrier { field, obstacle, depth_mm } => {
                Self::EndInsideBarrier { ends: vec![InsideEnd { field: field.into(), obstacle, depth_mm }] }
            }
            Refusal::EndShutIn { field, obstacle, why } => {
                let ends = vec![ShutInEnd { field: field.into(), obstacle, why }];
                Self::EndShutIn { ends, inside: Vec::new() }
            }
            Refusal::NoRoomForDogLegs => Self::NoRoomForDogLegs,
            Refusal::PublishedMethodNotApplicable { why } => Self::PublishedMethodNotApplicable { why },
            Refusal::Interrupted { interrupt, lower_bound } => {
                Self::interrupted(interrupt, Some(lower_bound))
            }
        }
    }
}
