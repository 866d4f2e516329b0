//! What is wrong with a value: every finding names field, reason, value, and what to do.

use crate::Point;
use std::fmt;

/// One thing that is wrong with the input.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Path of the field, such as `scene.obstacles[3].shape.outer.xy_mm[4]`. Empty: the value itself.
    pub field: String,
    /// Why, for programs.
    pub reason: Reason,
    /// Why and what to do, for people. Lower case, names the value.
    pub message: String,
    /// The value that is wrong, as text; empty when it is missing.
    pub value: String,
    /// Where in the plane it is wrong, if that can be said.
    pub place: Option<Point>,
}

impl Finding {
    /// A finding about the value at `field`.
    #[must_use]
    pub fn new(
        field: impl Into<String>,
        reason: Reason,
        value: impl ToString,
        message: impl Into<String>,
    ) -> Self {
        Self { field: field.into(), reason, message: message.into(), value: value.to_string(), place: None }
    }

    /// The same finding, at that place.
    #[must_use]
    pub fn at(mut self, place: Point) -> Self {
        self.place = Some(place);
        self
    }

    /// The same finding, seen from the message that holds the value as `parent`.
    #[must_use]
    pub fn under(mut self, parent: &str) -> Self {
        self.field = match (parent.is_empty(), self.field.is_empty()) {
            (true, _) => self.field,
            (false, true) => parent.to_owned(),
            (false, false) => format!("{parent}.{}", self.field),
        };
        self
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = if self.field.is_empty() { "value" } else { &self.field };
        write!(f, "{field}: {}", self.message)
    }
}

macro_rules! reasons {
    ($($(#[$doc:meta])* $name:ident = $text:literal,)*) => {
        /// Why a value is refused. Closed: each has a section in docs/errors.md.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Reason { $($(#[$doc])* $name,)* }

        impl Reason {
            /// Every reason, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$name,)*];

            /// The name on the wire, UPPER_SNAKE_CASE.
            #[must_use]
            pub fn as_str(self) -> &'static str {
                match self { $(Self::$name => $text,)* }
            }
        }
    };
}

reasons! {
    /// A field that must be set is absent or empty.
    MissingField = "MISSING_FIELD",
    /// Not a finite number.
    NotFinite = "NOT_FINITE",
    /// A number outside its range.
    OutOfRange = "OUT_OF_RANGE",
    /// A coordinate beyond the coordinate limit.
    CoordinateTooLarge = "COORDINATE_TOO_LARGE",
    /// `xy_mm` holds an odd count of numbers.
    OddCoordinateCount = "ODD_COORDINATE_COUNT",
    /// The count of bulges is neither 0 nor the count that the vertices ask for.
    BulgeCountMismatch = "BULGE_COUNT_MISMATCH",
    /// A bulge outside [−1, 1].
    BulgeOutOfRange = "BULGE_OUT_OF_RANGE",
    /// A circular edge whose radius is beyond the limit.
    ArcTooFlat = "ARC_TOO_FLAT",
    /// Fewer distinct vertices than a ring needs.
    TooFewVertices = "TOO_FEW_VERTICES",
    /// A ring that encloses no area.
    NoArea = "NO_AREA",
    /// Two edges cross properly.
    EdgesCross = "EDGES_CROSS",
    /// A hole that is not inside its outer ring.
    HoleOutside = "HOLE_OUTSIDE",
    /// A hole inside another hole of the same polygon.
    HoleInHole = "HOLE_IN_HOLE",
    /// Two parts of one section that overlap.
    PartsOverlap = "PARTS_OVERLAP",
    /// An id that stands for two things.
    DuplicateId = "DUPLICATE_ID",
    /// Something that is to come before itself, or before what must come first.
    PrecedenceContradiction = "PRECEDENCE_CONTRADICTION",
    /// An enum value that this version does not know.
    UnknownEnumValue = "UNKNOWN_ENUM_VALUE",
    /// More items than GetLimits permits, or more edges lying on top of one another than can be told apart.
    TooMany = "TOO_MANY",
    /// A setting that has no meaning together with another one.
    NotApplicable = "NOT_APPLICABLE",
    /// An id that stands for nothing in the request.
    UnknownId = "UNKNOWN_ID",
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}
