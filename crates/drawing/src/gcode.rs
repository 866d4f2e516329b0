//! G-code out: a path as blocks for LinuxCNC, Grbl or Fanuc.
//!
//! Straight moves are G0 (or G1), arcs fed G2/G3 by centre, or straight chords on their outside. Every number is a
//! whole multiple of the last decimal place, and offsets are taken from the rounded start, so what is checked here is
//! what the controller computes. A rounded position is up to 0.71 of the last place off the path. Cost: linear.

mod arc_block;
mod axes;
mod block_writer;
mod chords;
mod dialect;
mod error;
mod grid;
mod moves;
mod program;
mod settings;
mod settings_check;

pub use chords::chords_outside;
pub use dialect::GcodeDialect;
pub use error::GcodeError;
pub use moves::{GcodeMoves, ModalMotion, ModalState, gcode_moves};
pub use program::{GcodeProgram, write_gcode};
pub use settings::{
    ArcMotion, GcodePlane, GcodeSettings, GcodeUnit, LARGEST_CHORD_TOLERANCE_MM, SMALLEST_CHORD_TOLERANCE_MM,
    StraightMotion, XWord,
};
pub use settings_check::SettingFinding;
