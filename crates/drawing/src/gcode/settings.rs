//! How a path is written as G-code.

use super::dialect::GcodeDialect;

/// The finest tolerance for chords, millimetres.
pub const SMALLEST_CHORD_TOLERANCE_MM: f64 = 1e-4;

/// The coarsest tolerance for chords, millimetres.
pub const LARGEST_CHORD_TOLERANCE_MM: f64 = 10.0;

/// How a path is written as G-code.
#[derive(Clone, Debug, PartialEq)]
pub struct GcodeSettings {
    /// For which controller. Default: LinuxCNC.
    pub dialect: GcodeDialect,
    /// In which unit. Default: millimetres.
    pub unit: GcodeUnit,
    /// On which axes. Default: X and Y.
    pub plane: GcodePlane,
    /// Decimal places. Absent: as few as the controller's check of radii lets pass, from
    /// [`GcodeDialect::usual_decimals`] on. At least 1, at most [`GcodeDialect::most_decimals`].
    pub decimals: Option<u8>,
    /// How straight steps are moved. Default: G0.
    pub straight: StraightMotion,
    /// How circular steps are moved.
    pub arcs: ArcMotion,
    /// Lines of a whole program before the first move, behind what sets plane and unit. Absent: what makes the
    /// controller read coordinates as they are meant (G90 and so on). It replaces them all.
    pub safe_start: Option<Vec<String>>,
    /// Lines of a whole program before plane and unit are set. Default: none.
    pub header: Vec<String>,
    /// Lines of a whole program after the last move. Absent: `M30`.
    pub footer: Option<Vec<String>>,
    /// Number of a Fanuc program, 1 to 9999. Default: 1.
    pub program_number: u16,
}

impl GcodeSettings {
    /// LinuxCNC in millimetres on X and Y, arcs fed at this speed (millimetres per minute, positive).
    #[must_use]
    pub fn new(arc_feed_mm_per_min: f64) -> Self {
        Self {
            dialect: GcodeDialect::default(),
            unit: GcodeUnit::default(),
            plane: GcodePlane::default(),
            decimals: None,
            straight: StraightMotion::default(),
            arcs: ArcMotion::Fed { feed_mm_per_min: arc_feed_mm_per_min },
            safe_start: None,
            header: Vec::new(),
            footer: None,
            program_number: 1,
        }
    }
}

/// The unit of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GcodeUnit {
    /// G21.
    #[default]
    Millimetres,
    /// G20.
    Inches,
}

impl GcodeUnit {
    /// Millimetres in one unit.
    #[must_use]
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Millimetres => 1.0,
            Self::Inches => 25.4,
        }
    }
}

/// The axes that a path's x and y are moved by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GcodePlane {
    /// G17: x is the machine's X, y its Y, centres by I and J.
    #[default]
    Xy,
    /// G18, for lathes: x is the machine's Z, y its X as a radius, centres by K and I. Counter-clockwise in the
    /// drawing is G3, wherever the turret stands.
    Zx {
        /// What an X word counts.
        x: XWord,
    },
}

/// What an X word of a lathe counts. Centres (I) count radii either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum XWord {
    /// The distance from the spindle's axis.
    #[default]
    Radius,
    /// Twice that.
    Diameter,
}

/// How straight steps are moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum StraightMotion {
    /// G0. The controller must move it in a straight line.
    #[default]
    Rapid,
    /// G1, for controllers whose G0 moves each axis at its own speed.
    Fed {
        /// Millimetres per minute, positive.
        feed_mm_per_min: f64,
    },
}

/// How circular steps are moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArcMotion {
    /// G2 and G3.
    Fed {
        /// Millimetres per minute, positive.
        feed_mm_per_min: f64,
    },
    /// Straight moves round the outside of the arc, as [`super::chords_outside`] says.
    Chords {
        /// How far outside at most, millimetres, within [`SMALLEST_CHORD_TOLERANCE_MM`] and
        /// [`LARGEST_CHORD_TOLERANCE_MM`].
        tolerance_mm: f64,
    },
}
