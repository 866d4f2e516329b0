//! How a program is read: what its text alone does not say.

use crate::survey::Survey;
use traverse_drawing::{GcodeDialect, GcodeUnit};
use traverse_geometry::{Point, Vector};

/// How a program is read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadOptions {
    /// The controller. Absent: Fanuc when the program numbers itself (`O0001`), Grbl when it holds `$` commands,
    /// LinuxCNC otherwise.
    pub dialect: Option<GcodeDialect>,
    /// The unit that holds until the program states one. Default: millimetres.
    pub unit: GcodeUnit,
    /// Where the tool stands when the program begins, in the drawing, millimetres. Absent: not known, so the first
    /// rapid move is left alone.
    pub start: Option<Point>,
    /// Where work offsets lie in the drawing.
    pub offsets: Offsets,
}

impl ReadOptions {
    /// `unit` holds until the program states one.
    #[must_use]
    pub fn new(unit: GcodeUnit) -> Self {
        Self { dialect: None, unit, start: None, offsets: Offsets::default() }
    }

    pub(crate) fn is_fanuc(&self, survey: &Survey) -> bool {
        self.dialect(survey) == GcodeDialect::Fanuc
    }

    pub(crate) fn dialect(&self, survey: &Survey) -> GcodeDialect {
        let guessed = match survey {
            Survey { numbers_programs: true, .. } => GcodeDialect::Fanuc,
            Survey { commands_grbl: true, .. } => GcodeDialect::Grbl,
            _ => GcodeDialect::LinuxCnc,
        };
        self.dialect.unwrap_or(guessed)
    }
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self::new(GcodeUnit::Millimetres)
    }
}

/// Where the zeros of the work offsets lie in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Offsets([Option<Vector>; 9]);

impl Default for Offsets {
    /// G54 is the drawing's own zero, the others lie nowhere known.
    fn default() -> Self {
        let mut origins = [None; 9];
        origins[0] = Some(Vector::new(0.0, 0.0));
        Self(origins)
    }
}

impl Offsets {
    /// Sets the zero of an offset, millimetres: 0 is G54, 5 is G59, 6 to 8 are G59.1 to G59.3; others are ignored.
    pub fn set(&mut self, offset: u8, origin: Vector) {
        if let Some(place) = self.0.get_mut(usize::from(offset)) {
            *place = Some(origin);
        }
    }

    pub(crate) fn origin(&self, offset: u8) -> Option<Vector> {
        self.0.get(usize::from(offset)).copied().flatten()
    }
}
