//! A path as a whole program.

use super::dialect::GcodeDialect;
use super::error::GcodeError;
use super::moves::{GcodeMoves, ModalState, written};
use super::settings::{GcodePlane, GcodeSettings, GcodeUnit, XWord};
use traverse_geometry::Path;

/// A whole program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GcodeProgram {
    /// The text of the file, ASCII, with the line ends that the controller wants.
    pub text: String,
    /// The blocks in it that move.
    pub moves: GcodeMoves,
}

/// The path as a whole program: header, plane and unit, safe start, moves, footer, in the frame of the dialect.
///
/// The tool must stand at the path's start when the program begins (a comment says where): the way there is not
/// known to be free, so the program does not go there.
///
/// # Errors
/// As [`super::gcode_moves`].
pub fn write_gcode(path: &Path, settings: &GcodeSettings) -> Result<GcodeProgram, GcodeError> {
    let (start, moves) = written(path, settings, &ModalState::default())?;
    let mut lines: Vec<String> = Vec::new();
    if settings.dialect == GcodeDialect::Fanuc {
        lines.extend(["%".to_owned(), format!("O{:04} (TRAVERSE RAPID MOVE)", settings.program_number)]);
    } else {
        lines.push("(TRAVERSE RAPID MOVE)".to_owned());
    }
    lines.extend(settings.header.iter().cloned());
    lines.push(plane_and_unit(settings));
    match &settings.safe_start {
        Some(own) => lines.extend(own.iter().cloned()),
        None => lines.push(safe_start(settings).to_owned()),
    }
    if settings.dialect == GcodeDialect::Fanuc
        && let GcodePlane::Zx { x } = settings.plane
    {
        let counted = if x == XWord::Diameter { "DIAMETER" } else { "RADIUS" };
        lines.push(format!("(X IS {counted}: AXIS PARAMETER 1006 BIT 3 MUST AGREE)"));
    }
    lines.push(format!("(TOOL MUST STAND AT{start})"));
    lines.extend(moves.lines.iter().cloned());
    match &settings.footer {
        Some(own) => lines.extend(own.iter().cloned()),
        None => lines.push("M30".to_owned()),
    }
    if settings.dialect == GcodeDialect::Fanuc {
        lines.push("%".to_owned());
    }
    let end = settings.dialect.line_end();
    let text = lines.iter().flat_map(|line| [line.as_str(), end]).collect();
    Ok(GcodeProgram { text, moves })
}

fn plane_and_unit(settings: &GcodeSettings) -> String {
    let (plane, x) = match settings.plane {
        GcodePlane::Xy => ("G17", None),
        GcodePlane::Zx { x } => ("G18", Some(x)),
    };
    let unit = match settings.unit {
        GcodeUnit::Millimetres => "G21",
        GcodeUnit::Inches => "G20",
    };
    let x_word = match (settings.dialect, x) {
        (GcodeDialect::LinuxCnc, Some(XWord::Radius)) => " G8",
        (GcodeDialect::LinuxCnc, Some(XWord::Diameter)) => " G7",
        _ => "",
    };
    format!("{plane} {unit}{x_word}")
}

/// Absolute positions, centres from the start, no cutter compensation, no cycle, F per minute, exact path.
/// A Fanuc lathe of system A has G90 for a turning cycle and G98 for F per minute.
fn safe_start(settings: &GcodeSettings) -> &'static str {
    match (settings.dialect, settings.plane) {
        (GcodeDialect::LinuxCnc, _) => "G90 G91.1 G40 G80 G94 G61",
        (GcodeDialect::Grbl, _) => "G90 G91.1 G40 G94",
        (GcodeDialect::Fanuc, GcodePlane::Xy) => "G90 G40 G80 G94",
        (GcodeDialect::Fanuc, GcodePlane::Zx { .. }) => "G40 G98",
    }
}
