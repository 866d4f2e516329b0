//! What became of a link.

use crate::reason::Reason;
use traverse_geometry::Path;

/// What became of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The way as it was; with its retract and plunge where heights are planned.
    pub before: Path,
    /// Its length as it was, millimetres.
    pub before_mm: f64,
    /// Its length as it is.
    pub after_mm: f64,
    /// How much of that is fed.
    pub fed_mm: f64,
    /// Ids of what it came too near to as it was.
    pub hits: Vec<String>,
    /// What was done.
    pub done: Done,
}

/// What was done to a link.
#[derive(Clone, Debug, PartialEq)]
pub enum Done {
    /// Nothing: it was the shortest way already, or it must stay and is free.
    Unchanged,
    /// It takes this way now.
    Changed(Path),
    /// It still comes too near to something: this kept it from being changed.
    Left(Reason),
}

impl Outcome {
    /// It came too near to something and no longer does.
    #[must_use]
    pub fn is_made_safe(&self) -> bool {
        !self.hits.is_empty() && matches!(self.done, Done::Changed(_))
    }

    /// It still comes too near to something.
    #[must_use]
    pub fn still_hits(&self) -> bool {
        !self.hits.is_empty() && !matches!(self.done, Done::Changed(_))
    }
}
