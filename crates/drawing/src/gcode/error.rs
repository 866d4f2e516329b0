//! Why a path can't be written as G-code.

use super::settings_check::SettingFinding;

/// Why a path can't be written as G-code.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GcodeError {
    /// The settings are wrong.
    #[error("the g-code settings can't be used: {}", listed(.findings))]
    Settings {
        /// Everything that is wrong, at least one.
        findings: Vec<SettingFinding>,
    },
    /// A coordinate, centre or angle is no finite number.
    #[error("step {step} of the path holds {value}; give finite numbers")]
    NotFinite {
        /// Counted from 1; 0 for the start.
        step: usize,
        /// What it holds.
        value: f64,
    },
    /// The path has heights, and the plane is one without a Z of its own: moves in it alone would run into what is passed over.
    #[error(
        "the path has heights, which are written on X and Y only; use plane = \"G17\" or plan without heights"
    )]
    Heights,
    /// Only some of the path's heights are there.
    #[error("step {step} of the path has no height and others have; give all of them or none")]
    HeightMissing {
        /// Counted from 1; 0 for the start.
        step: usize,
    },
    /// The numbers of an arc contradict each other.
    #[error(
        "step {step} of the path ends {distance_mm} mm off where its centre and sweep lead; correct its end"
    )]
    ArcContradictsItself {
        /// Counted from 1.
        step: usize,
        /// How far off, millimetres.
        distance_mm: f64,
    },
    /// Too large for the controller to read to the last place.
    #[error(
        "step {step} needs {word}{value}, but {dialect} reads no more than {limit} with {decimals} decimals; \
             move the origin nearer or use fewer decimals"
    )]
    NumberTooLarge {
        /// Counted from 1; 0 for the start.
        step: usize,
        /// The word's letter.
        word: char,
        /// Its value, in the program's unit.
        value: f64,
        /// Largest absolute value, in the program's unit.
        limit: f64,
        /// Which controller.
        dialect: &'static str,
        /// Decimal places.
        decimals: u8,
    },
    /// The controller would refuse the arc.
    #[error(
        "the arc of step {step} has radii {mismatch_mm:.6} mm apart when rounded to {decimals} decimals, where \
         {dialect} refuses more than {tolerance_mm:.6} mm; use more decimals or write arcs as chords"
    )]
    RadiiDiffer {
        /// Counted from 1.
        step: usize,
        /// Difference of the radii at start and end, millimetres.
        mismatch_mm: f64,
        /// What is permitted here, with a margin, millimetres.
        tolerance_mm: f64,
        /// Which controller.
        dialect: &'static str,
        /// Decimal places.
        decimals: u8,
    },
    /// The chords of one arc would be too many.
    #[error(
        "the arc of step {step} would take more than {limit} chords; use a coarser tolerance than {tolerance_mm} mm"
    )]
    TooManyChords {
        /// Counted from 1.
        step: usize,
        /// The limit.
        limit: usize,
        /// The tolerance, millimetres.
        tolerance_mm: f64,
    },
    /// The tolerance for chords is out of range.
    #[error("the chord tolerance is {value} mm; use {least} to {largest} mm")]
    ChordTolerance {
        /// Millimetres.
        value: f64,
        /// The least, millimetres.
        least: f64,
        /// The largest, millimetres.
        largest: f64,
    },
}

fn listed(findings: &[SettingFinding]) -> String {
    findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}
