//! What is in force at a block. None means that it is not known: then what depends on it is left alone.

use crate::codes::{DISTORTIONS, Distance, Distortion, Motion, Retract};
use traverse_drawing::GcodeUnit as Unit;
use traverse_geometry::Vector;

/// Everything that blocks leave behind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Modal {
    pub(crate) motion: Option<Motion>,
    pub(crate) distance: Option<Distance>,
    pub(crate) unit: Option<Unit>,
    pub(crate) plane: Option<u8>,
    pub(crate) centers: Option<Distance>,
    pub(crate) feed_mode: Option<u8>,
    pub(crate) feed: Feed,
    pub(crate) retract: Option<Retract>,
    /// Whether the spindle, torch or beam is on.
    pub(crate) spindle: Option<bool>,
    pub(crate) tool: Tool,
    /// The tool that the next M6 takes.
    pub(crate) selected: Tool,
    /// The work offset in force: G54 is 0; none: which is not known, or one that has no number here.
    pub(crate) offset: Option<u8>,
    /// Where the zero of the work offset lies in the drawing.
    pub(crate) origin: Option<Vector>,
    /// The line where each distortion began; 0: it is not there.
    pub(crate) distortions: [u32; DISTORTIONS],
    /// X and Y in the drawing, Z in the program's coordinates, millimetres.
    pub(crate) at: [Option<f64>; 3],
    /// Line and cause that made X or Y unknown, and the same of Z.
    pub(crate) lost: [(u32, Lost); 2],
    /// The plane that a cycle returns to, program's coordinates.
    pub(crate) cycle_plane: Option<f64>,
}

/// The F word in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Feed {
    /// None was given yet: the next feed move brings its own.
    Unset,
    /// Where its number stands in the program, and for which unit it was given.
    Stands {
        start: u32,
        end: u32,
        unit: Option<Unit>,
    },
    Unknown,
}

/// Which tool is in the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tool {
    /// The program has not said.
    Unstated,
    Number(u32),
    Unknown,
}

/// Why the position is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lost {
    /// Where the tool stands when the program begins.
    Start,
    /// A tool change.
    ToolChange,
    /// G28, G30, G53: places that the machine knows.
    MachinePlace,
    /// A subprogram, macro or jump.
    Call,
    /// A variable or a formula.
    Expression,
    /// G90 or G91, the unit or the work offset is not known.
    ModeUnknown,
    /// The work offset lies nowhere in the drawing.
    OffsetUnknown,
    /// Coordinates mean something else.
    Distorted(Distortion),
    /// A move whose end is not known: probing, threads, splines, unknown codes.
    UnknownMove,
    /// The line could not be understood.
    Fault,
    /// A block that the operator may skip.
    Skippable,
    /// Another tool length, or another work offset: heights count from elsewhere.
    Length,
}

impl Lost {
    /// What happened, for people.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Start => "the program has not been anywhere yet",
            Self::ToolChange => "a tool change",
            Self::MachinePlace => "a move to a place of the machine (G28, G30, G53)",
            Self::Call => "a subprogram, macro or jump",
            Self::Expression => "a variable or formula",
            Self::ModeUnknown => "G90 or G91, the unit or the motion not being known",
            Self::OffsetUnknown => "a work offset whose place in the drawing is not known",
            Self::Distorted(distortion) => distortion.words(),
            Self::UnknownMove => "a move whose end is not known",
            Self::Fault => "a line that was not understood",
            Self::Skippable => "a block that may be skipped (/)",
            Self::Length => "another tool length or work offset",
        }
    }
}

impl Modal {
    /// What is taken to be in force when a program begins.
    pub(crate) fn at_start(unit: Unit, origin: Option<Vector>, start: Option<[f64; 2]>) -> Self {
        Self {
            motion: Some(Motion::None),
            distance: Some(Distance::Absolute),
            unit: Some(unit),
            plane: Some(17),
            centers: Some(Distance::Incremental),
            feed_mode: Some(94),
            feed: Feed::Unset,
            retract: Some(Retract::Initial),
            spindle: Some(false),
            tool: Tool::Unstated,
            selected: Tool::Unstated,
            offset: Some(0),
            origin,
            distortions: [0; DISTORTIONS],
            at: [start.map(|[x, _]| x), start.map(|[_, y]| y), None],
            lost: [(0, Lost::Start); 2],
            cycle_plane: None,
        }
    }

    /// Forgets all that code which is not seen here may change. Unit, work offset and distortions stay: whoever
    /// changes them is taken to set them back, unless the program itself is seen to mix them.
    pub(crate) fn forget(&mut self, line: u32, lost: Lost, mixes_units: bool, mixes_offsets: bool) {
        self.motion = None;
        self.distance = None;
        self.plane = None;
        self.centers = None;
        self.feed_mode = None;
        self.feed = Feed::Unknown;
        self.retract = None;
        self.spindle = None;
        self.tool = Tool::Unknown;
        self.selected = Tool::Unknown;
        self.unit = self.unit.filter(|_| !mixes_units);
        self.offset = self.offset.filter(|_| !mixes_offsets);
        self.origin = self.origin.filter(|_| !mixes_offsets);
        self.lose_position(line, lost);
    }

    pub(crate) fn lose_position(&mut self, line: u32, lost: Lost) {
        for axis in 0..3 {
            self.lose(axis, line, lost);
        }
    }

    /// The axis stands nowhere known; `axis` counts X, Y, Z.
    pub(crate) fn lose(&mut self, axis: usize, line: u32, lost: Lost) {
        self.at[axis] = None;
        self.lost[usize::from(axis == 2)] = (line, lost);
    }

    /// What is known whether or not the block between ran.
    pub(crate) fn merge(&mut self, skipped: &Self, line: u32) {
        fn agree<T: PartialEq>(ran: &mut Option<T>, skipped: &Option<T>) {
            if *ran != *skipped {
                *ran = None;
            }
        }
        agree(&mut self.motion, &skipped.motion);
        agree(&mut self.distance, &skipped.distance);
        agree(&mut self.unit, &skipped.unit);
        agree(&mut self.plane, &skipped.plane);
        agree(&mut self.centers, &skipped.centers);
        agree(&mut self.feed_mode, &skipped.feed_mode);
        agree(&mut self.retract, &skipped.retract);
        agree(&mut self.spindle, &skipped.spindle);
        agree(&mut self.offset, &skipped.offset);
        agree(&mut self.origin, &skipped.origin);
        agree(&mut self.cycle_plane, &skipped.cycle_plane);
        if self.feed != skipped.feed {
            self.feed = Feed::Unknown;
        }
        for (ran, skipped) in [(&mut self.tool, skipped.tool), (&mut self.selected, skipped.selected)] {
            if *ran != skipped {
                *ran = Tool::Unknown;
            }
        }
        for (ran, skipped) in self.distortions.iter_mut().zip(skipped.distortions) {
            *ran = (*ran).max(skipped);
        }
        for axis in 0..3 {
            if self.at[axis].is_some() && self.at[axis] != skipped.at[axis] {
                self.lose(axis, line, Lost::Skippable);
            }
        }
    }

    /// The first thing that keeps coordinates from being those of the drawing.
    pub(crate) fn distortion(&self) -> Option<(u32, Distortion)> {
        const ALL: [Distortion; DISTORTIONS] = [
            Distortion::Compensation,
            Distortion::Rotation,
            Distortion::Scaling,
            Distortion::Mirror,
            Distortion::Polar,
            Distortion::Shift,
            Distortion::Diameter,
            Distortion::PolarInterpolation,
            Distortion::OffsetsSet,
            Distortion::Turned,
        ];
        ALL.into_iter().zip(self.distortions).find(|(_, line)| *line > 0).map(|(which, line)| (line, which))
    }
}
