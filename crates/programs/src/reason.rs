//! Why a rapid move stays as it is.

use crate::codes::Distortion;
use crate::modal::Lost;
use std::fmt;

/// Why a rapid move stays as it is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// Where it begins is not known.
    StartUnknown {
        /// The line that made it so.
        line: u32,
        /// What happened there.
        lost: Lost,
    },
    /// Where it ends is not known.
    TargetUnknown {
        /// What keeps it from being known.
        lost: Lost,
    },
    /// Coordinates are not those of the drawing.
    Distorted {
        /// Since this line.
        line: u32,
        /// Why.
        distortion: Distortion,
    },
    /// Whether it is a rapid move at all.
    MotionUnknown,
    /// A canned cycle in a plane other than G17, or in one that is not known.
    CyclePlane,
    /// A comment protects it.
    Protected,
    /// The operator decides whether it runs.
    Skippable,
    /// The block does more, which must not run elsewhere: the letter of the word.
    DoesMore(u8),
    /// Another axis moves along.
    OtherAxis(u8),
    /// It belongs to a canned cycle.
    Cycle,
    /// It rises or sinks on the way, and from where is not known.
    HeightUnknown,
    /// It rises or sinks on the way and is written in increments.
    SlopedIncrements,
    /// An end lies nearer to an obstacle than the clearance.
    EndInside {
        /// `start` or `target`.
        end: &'static str,
        /// The obstacle's id.
        obstacle: String,
        /// How much too near, millimetres.
        depth_mm: f64,
    },
    /// There is no way round: proven.
    NoPath {
        /// What parts start from target.
        separating: Vec<String>,
    },
    /// No way keeps the clearance when it is rounded to the decimals that the controller takes.
    Rounding,
    /// A number is too large for the controller.
    NumberTooLarge,
    /// Time was over.
    Interrupted,
    /// Planning failed otherwise.
    Refused(String),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StartUnknown { line: 0, .. } => {
                f.write_str("where the tool stands at first is not known; say so with --from X,Y")
            }
            Self::StartUnknown { line, lost } => {
                write!(f, "where it begins is not known since line {line}: {}", lost.words())
            }
            Self::TargetUnknown { lost } => write!(f, "where it ends is not known: {}", lost.words()),
            Self::Distorted { line, distortion } => write!(f, "{} since line {line}", distortion.words()),
            Self::MotionUnknown => {
                f.write_str("whether it moves rapidly is not known; say G0, G1, G2 or G3 in the block")
            }
            Self::CyclePlane => f.write_str(
                "a canned cycle whose holes do not lie along Z for sure; say G17 before it, or drill with G0 and G1",
            ),
            Self::Protected => f.write_str("protected by a comment"),
            Self::Skippable => f.write_str("the block may be skipped (/)"),
            Self::DoesMore(letter) => {
                write!(f, "the block also holds {}; give that a block of its own", *letter as char)
            }
            Self::OtherAxis(letter) => write!(f, "axis {} moves along", *letter as char),
            Self::Cycle => f.write_str("it belongs to a canned cycle; travel before the cycle instead"),
            Self::HeightUnknown => f.write_str("Z moves along, and from where is not known; split the block"),
            Self::SlopedIncrements => f.write_str("Z moves along in increments; split the block"),
            Self::EndInside { end, obstacle, depth_mm } => {
                write!(f, "its {end} lies {depth_mm:.3} mm inside the barrier of {obstacle}")
            }
            Self::NoPath { separating } if separating.is_empty() => {
                f.write_str("there is no way: the border parts its ends")
            }
            Self::NoPath { separating } => {
                write!(f, "there is no way: its ends are parted by {}", separating.join(", "))
            }
            Self::Rounding => f.write_str("no way keeps the clearance once it is rounded; give it more room"),
            Self::NumberTooLarge => f.write_str("a number is too large for the controller"),
            Self::Interrupted => f.write_str("time was over"),
            Self::Refused(why) => f.write_str(why),
        }
    }
}
