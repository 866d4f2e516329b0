//! What a plan does against its request: field, reason, place, amount.

use std::fmt;
use traverse_geometry::Point;

/// One thing that a path or a layout does against its request.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Into the answer: `path.start`, `path.steps[7]`, `path.steps[7].end`, `path.steps[7].arc.center`, `order[3]`.
    pub field: String,
    /// Why, for programs.
    pub reason: ViolationReason,
    /// What, where, by how much, for people. Lower case.
    pub message: String,
    /// By how much, millimetres unless the reason says otherwise. Never negative, never NaN.
    pub amount: f64,
    /// Where it is worst, if it has a place.
    pub at: Option<Point>,
    /// Id of the obstacle concerned, or [`traverse_geometry::WORK_AREA_ID`]; of the other section in a layout.
    pub obstacle: Option<String>,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})", self.field, self.message, self.reason)
    }
}

macro_rules! reasons {
    ($($(#[$doc:meta])* $name:ident = $text:literal,)*) => {
        /// Why a path or a layout is not sound. Closed: each has a section in docs/errors.md.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum ViolationReason { $($(#[$doc])* $name,)* }

        impl ViolationReason {
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
    /// The path does not begin at the start, or at the height, that was asked for. Amount: how far from it.
    WrongStart = "WRONG_START",
    /// The path does not end at the target, or at the height, that was asked for. Amount: how far from it.
    WrongEnd = "WRONG_END",
    /// A number of the path, of an end or the tolerance is not finite, or so large that a distance
    /// overflows. Nothing else is checked. Amount: 0.
    NotFinite = "NOT_FINITE",
    /// An arc's centre is not equally far from both ends. Amount: the difference of the radii.
    ArcRadiiDiffer = "ARC_RADII_DIFFER",
    /// An arc's sweep is 0 or beyond one full turn. Amount, radians: how far beyond; 0 for a sweep of 0.
    SweepOutOfRange = "SWEEP_OUT_OF_RANGE",
    /// An arc's sweep does not lead from its start to its end. Amount: how far from the end.
    SweepMissesEnd = "SWEEP_MISSES_END",
    /// Nearer to an obstacle or to the border than the clearance asked for. Amount: how much too near.
    TooClose = "TOO_CLOSE",
    /// Inside an obstacle. Amount: how much too near; at clearance 0 how deep.
    InsideObstacle = "INSIDE_OBSTACLE",
    /// Outside the work area. Amount: how far outside, plus the border's clearance.
    OutsideWorkArea = "OUTSIDE_WORK_AREA",
    /// At clearance 0: passes between obstacles, or parts of one, that touch. Amount: 0.
    BetweenTouchingObstacles = "BETWEEN_TOUCHING_OBSTACLES",
    /// Passes over an obstacle lower than its top plus the vertical clearance. Amount: how much too low.
    TooLow = "TOO_LOW",
    /// Higher than the tool may go. Amount: how much too high.
    TooHigh = "TOO_HIGH",
    /// A height is missing where the rules have heights, or given where they have none. Amount: 0.
    HeightMismatch = "HEIGHT_MISMATCH",
    /// A step changes position and height at once. Amount: by how much the height changes.
    SlantedStep = "SLANTED_STEP",
    /// The way out of or into a barrier does not run in the direction asked for. Amount: how far off its end lies.
    WrongDirection = "WRONG_DIRECTION",
    /// A placed section is none of the layout. Amount: 0.
    UnknownSection = "UNKNOWN_SECTION",
    /// A copy of a section is placed that the layout does not have. Amount: 0.
    UnknownCopy = "UNKNOWN_COPY",
    /// A copy of a section is placed twice. Amount: 0.
    CopyRepeated = "COPY_REPEATED",
    /// A copy of a section is not placed. Amount: 0.
    CopyMissing = "COPY_MISSING",
    /// A section is turned in a way that is not allowed. Amount: 0.
    PoseNotAllowed = "POSE_NOT_ALLOWED",
    /// Another section comes first than the one asked for. Amount: 0.
    WrongFirst = "WRONG_FIRST",
    /// Another section comes last than the one asked for. Amount: 0.
    WrongLast = "WRONG_LAST",
    /// A section comes before one that must come earlier. Amount: 0.
    PrecedenceBroken = "PRECEDENCE_BROKEN",
    /// Two sections are neighbours in an order that is forbidden. Amount: 0.
    ForbiddenJoin = "FORBIDDEN_JOIN",
    /// A section begins left of the strip's start. Amount: how far.
    LeftOfStart = "LEFT_OF_START",
    /// A section begins left of the one before it although the order is to be kept. Amount: how far.
    PassesPrevious = "PASSES_PREVIOUS",
    /// A section is higher than the strip. Amount: how much higher.
    HigherThanStrip = "HIGHER_THAN_STRIP",
    /// Parts of two sections come nearer than the gap. Amount: how much too near.
    SectionsTooClose = "SECTIONS_TOO_CLOSE",
    /// Parts of two sections lie in one another. Amount: how deep, plus the gap.
    SectionsOverlap = "SECTIONS_OVERLAP",
    /// A lower bound is claimed that its certificate does not prove. Amount: how much more is claimed.
    BoundNotProven = "BOUND_NOT_PROVEN",
    /// The tool is changed where no region and no point permits it. Amount: how far from the nearest; 0 where nothing
    /// is permitted.
    PlaceNotPermitted = "PLACE_NOT_PERMITTED",
}

impl fmt::Display for ViolationReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_on_the_wire_are_distinct_and_upper_snake_case() {
        let mut names: Vec<&str> = ViolationReason::ALL.iter().map(|reason| reason.as_str()).collect();
        assert!(names.iter().all(|name| name.chars().all(|c| c.is_ascii_uppercase() || c == '_')));
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ViolationReason::ALL.len());
    }
}
