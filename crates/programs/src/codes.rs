//! What G codes mean. Sources: LinuxCNC, "G-Code Reference"; Grbl 1.1, `gcode.c`; Fanuc 0i-MF, operator's manual,
//! "Preparatory function". Where they differ, what is taken is what makes fewer positions known.

use traverse_drawing::GcodeUnit as Unit;

/// A G code, by what it does to what follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Code {
    Motion(Motion),
    /// G17, G18, G19.
    Plane(u8),
    /// G20, G21.
    Unit(Unit),
    /// G90, G91.
    Distance(Distance),
    /// G90.1, G91.1.
    Centers(Distance),
    /// G93, G94, G95.
    FeedMode(u8),
    /// G54 is 0, G59.3 is 8; none: one that profiles can't name.
    Offset(Option<u8>),
    /// G98, G99.
    Retract(Retract),
    /// Tool length: heights count from elsewhere.
    Length,
    /// Axis words mean something else for one block; what they do to the position.
    Once(Once),
    /// Coordinates mean something else from here on.
    Begins(Distortion),
    /// They mean what they did.
    Ends(Distortion),
    /// A subprogram or macro runs.
    Call,
    /// Changes nothing that matters here.
    Harmless,
    /// Harmless by itself, a curve with axis words.
    HarmlessAlone,
    Unknown,
}

/// The motion mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    Rapid,
    Linear,
    Clockwise,
    CounterClockwise,
    /// A canned cycle, with its number.
    Cycle(u8),
    /// G80.
    None,
    /// Probing, threads, splines: where they end is not known.
    Other,
}

/// What numbers count from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Distance {
    Absolute,
    Incremental,
}

/// Where a cycle leaves Z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Retract {
    /// G98.
    Initial,
    /// G99.
    Plane,
}

/// What becomes of the position when axis words are no target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Once {
    /// Nothing: dwell, settings.
    Stays,
    /// G28, G30: named axes go to a place that the machine knows.
    Home,
    /// G53: machine coordinates.
    Machine,
    /// G10: may set offsets.
    Setting,
}

/// Why coordinates are not those of the drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Distortion {
    /// G41, G42: the tool runs beside what is programmed.
    Compensation,
    /// G68.
    Rotation,
    /// G51.
    Scaling,
    /// G51.1.
    Mirror,
    /// G16.
    Polar,
    /// G92, G52.
    Shift,
    /// G7 of LinuxCNC, G07 and G07.1 of Fanuc.
    Diameter,
    /// G12.1.
    PolarInterpolation,
    /// Offsets were set by G10 or a variable.
    OffsetsSet,
    /// A turning axis does not stand at 0.
    Turned,
}

/// How many distortions there are.
pub(crate) const DISTORTIONS: usize = 10;

impl Code {
    /// The code with this number, in tenths: 591 is G59.1. Hundredths are cut off.
    pub(crate) fn of(tenths: u32) -> Self {
        use Distortion as D;
        match tenths {
            0 => Self::Motion(Motion::Rapid),
            10 => Self::Motion(Motion::Linear),
            20 => Self::Motion(Motion::Clockwise),
            30 => Self::Motion(Motion::CounterClockwise),
            730 | 740 | 810..=890 if tenths.is_multiple_of(10) => {
                Self::Motion(Motion::Cycle((tenths / 10) as u8))
            }
            800 => Self::Motion(Motion::None),
            52 | 53 | 62 | 120 | 130 | 310 | 320 | 330 | 331 | 340 | 350 | 360 | 380..=385 | 600 | 760 => {
                Self::Motion(Motion::Other)
            }
            170 | 180 | 190 => Self::Plane((tenths / 10) as u8),
            200 => Self::Unit(Unit::Inches),
            210 => Self::Unit(Unit::Millimetres),
            900 => Self::Distance(Distance::Absolute),
            910 => Self::Distance(Distance::Incremental),
            901 => Self::Centers(Distance::Absolute),
            911 => Self::Centers(Distance::Incremental),
            930 | 940 | 950 => Self::FeedMode((tenths / 10) as u8),
            540 | 550 | 560 | 570 | 580 | 590 => Self::Offset(Some((tenths / 10 - 54) as u8)),
            591..=593 => Self::Offset(Some((tenths - 591 + 6) as u8)),
            541 => Self::Offset(None),
            980 => Self::Retract(Retract::Initial),
            990 => Self::Retract(Retract::Plane),
            430..=439 | 440 | 490 => Self::Length,
            40 | 220 | 230 | 250 | 260 => Self::Once(Once::Stays),
            100 => Self::Once(Once::Setting),
            280 | 281 | 300 | 301 => Self::Once(Once::Home),
            530 => Self::Once(Once::Machine),
            410 | 411 | 420 | 421 => Self::Begins(D::Compensation),
            400 | 401 => Self::Ends(D::Compensation),
            680..=689 => Self::Begins(D::Rotation),
            690 => Self::Ends(D::Rotation),
            510 => Self::Begins(D::Scaling),
            500 => Self::Ends(D::Scaling),
            511 => Self::Begins(D::Mirror),
            501 => Self::Ends(D::Mirror),
            160 => Self::Begins(D::Polar),
            150 => Self::Ends(D::Polar),
            520 | 920 | 923 => Self::Begins(D::Shift),
            921 | 922 => Self::Ends(D::Shift),
            70 | 71 => Self::Begins(D::Diameter),
            121 | 1120 => Self::Begins(D::PolarInterpolation),
            131 | 1130 => Self::Ends(D::PolarInterpolation),
            650 | 660 | 661 | 670 => Self::Call,
            80 | 90 | 110 | 610 | 611 | 612 | 620 | 630 | 640 | 641 | 960 | 970 | 1870 => Self::Harmless,
            50 | 51 => Self::HarmlessAlone,
            _ => Self::Unknown,
        }
    }
}

impl Distortion {
    /// What it is, for people.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Compensation => "cutter compensation (G41, G42) is in force",
            Self::Rotation => "coordinates are turned (G68)",
            Self::Scaling => "coordinates are scaled (G51)",
            Self::Mirror => "coordinates are mirrored (G51.1)",
            Self::Polar => "coordinates are polar (G16)",
            Self::Shift => "the origin was shifted (G92 or G52)",
            Self::Diameter => "words count otherwise (G7, G07)",
            Self::PolarInterpolation => "coordinates are polar (G12.1)",
            Self::OffsetsSet => "the program sets offsets itself (G10 or a variable)",
            Self::Turned => "a turning axis does not stand at 0",
        }
    }
}
