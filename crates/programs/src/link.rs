//! Links: what a program travels between two cuts, as it stands in its text.

use crate::codes::Distance;
use crate::lift::Vertical;
use crate::modal::{Modal, Tool};
use crate::reason::Reason;
use traverse_drawing::GcodeUnit;
use traverse_geometry::{Path, Point};

/// A run of rapid moves along X and Y with nothing between them: one way from here to there.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Where it begins, in the drawing.
    pub from: Point,
    /// Heights at its ends, in the program's coordinates, millimetres.
    pub heights: Heights,
    /// The lines that rise before it and plunge behind it, where they stand next to it.
    pub retract_line: Option<u32>,
    /// See [`Link::retract_line`].
    pub plunge_line: Option<u32>,
    /// Those two, where their heights are known.
    pub(crate) retract: Option<Vertical>,
    pub(crate) plunge: Option<Vertical>,
    /// Which tool moves; none: the program has not said, or it can't be known.
    pub tool: Option<u32>,
    pub(crate) tool_is_known: bool,
    /// Why it must stay as it is, whatever lies in its way.
    pub(crate) fixed: Option<Reason>,
    /// At least one.
    pub(crate) blocks: Vec<RapidBlock>,
    /// What is in force before the last block.
    pub(crate) before: Box<Modal>,
}

/// Heights of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heights {
    /// It stays at one height; absent: which is not known.
    Level(Option<f64>),
    /// It rises or sinks on the way.
    Sloped {
        /// At its start.
        from: f64,
        /// At its end.
        to: f64,
    },
}

impl Heights {
    /// The lowest place of the way; none: it is not known.
    #[must_use]
    pub fn lowest(self) -> Option<f64> {
        match self {
            Self::Level(z) => z,
            Self::Sloped { from, to } => Some(from.min(to)),
        }
    }
}

/// One block of a link, by places in the program.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RapidBlock {
    pub(crate) line: u32,
    /// The line: begin, end of what is written, begin of the next.
    pub(crate) start: u32,
    pub(crate) end: u32,
    pub(crate) next: u32,
    /// X, Y, Z.
    pub(crate) words: [Option<WordPlace>; 3],
    /// Where it leads, in the drawing.
    pub(crate) target: Point,
    pub(crate) distance: Distance,
    /// The unit of its numbers.
    pub(crate) unit: Option<GcodeUnit>,
    /// It says G0 itself.
    pub(crate) names_motion: bool,
    /// It sets F itself.
    pub(crate) sets_feed: bool,
}

/// Where a word stands in the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WordPlace {
    pub(crate) letter: u32,
    pub(crate) number: u32,
    pub(crate) end: u32,
    pub(crate) value: crate::decimal::Decimal,
}

impl Link {
    /// Where it leads, in the drawing.
    #[must_use]
    pub fn to(&self) -> Point {
        self.blocks.last().map_or(self.from, |block| block.target)
    }

    /// The first and the last of its lines, counted from 1.
    #[must_use]
    pub fn lines(&self) -> (u32, u32) {
        let line = |block: Option<&RapidBlock>| block.map_or(0, |block| block.line);
        (line(self.blocks.first()), line(self.blocks.last()))
    }

    /// The same with its retract and its plunge.
    #[must_use]
    pub fn lines_with_heights(&self) -> (u32, u32) {
        let (first, last) = self.lines();
        (self.retract_line.unwrap_or(first), self.plunge_line.unwrap_or(last))
    }

    /// The way as the program has it.
    #[must_use]
    pub fn path(&self) -> Path {
        let mut path = Path::at(self.from);
        for block in &self.blocks {
            path.line_to(block.target);
        }
        path
    }

    pub(crate) fn tool_of(tool: Tool) -> (Option<u32>, bool) {
        match tool {
            Tool::Number(number) => (Some(number), true),
            Tool::Unstated => (None, true),
            Tool::Unknown => (None, false),
        }
    }
}
