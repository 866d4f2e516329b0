//! A path as blocks that can stand in the middle of a program.

use super::block_writer::BlockWriter;
use super::error::GcodeError;
use super::settings::{GcodePlane, GcodeSettings};
use traverse_geometry::{Arc, Path, Point, unit};

/// How far an arc's end may lie off where centre and sweep lead, millimetres; and that per millimetre of radius.
const ARC_END_TOLERANCE: (f64, f64) = (1e-5, 1e-11);

/// What the program around a path relies on behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModalState {
    /// Whether straight moves are fed (G1) there. Default: rapid (G0).
    pub motion: ModalMotion,
    /// The F word that is in force, in the program's unit per minute (G94). Absent: nobody relies on it.
    pub feed_per_min: Option<f64>,
}

/// The motion that words without a G code continue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ModalMotion {
    /// G0.
    #[default]
    Rapid,
    /// G1.
    Linear,
}

impl ModalState {
    pub(crate) fn straight_g_word(&self) -> u8 {
        match self.motion {
            ModalMotion::Rapid => 0,
            ModalMotion::Linear => 1,
        }
    }
}

/// Blocks that move along a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GcodeMoves {
    /// The blocks, without line ends.
    pub lines: Vec<String>,
    /// Decimal places that they are written to.
    pub decimals: u8,
    /// Count of G2 and G3 blocks.
    pub fed_arc_count: usize,
    /// Count of arcs that became straight moves round their outside: all of them if so asked, otherwise those that
    /// are too small for the decimal places.
    pub straightened_arc_count: usize,
}

/// Blocks that move along `path` and leave motion mode and F as `after` says.
///
/// The tool must stand at the path's start; the plane and the unit of the settings, G90, G91.1 and G94 must be in
/// force, and no cutter compensation. Positions are absolute, and off the path by up to 0.71 of the last decimal place:
/// plan with that much more clearance where it matters. A step that is shorter than the last decimal place is
/// left out. Arcs of more than three quarters of a turn are split in two; an arc whose chord is within half a last
/// place is moved straight. Steps along the height alone are G0 along Z, rounded up; in G17 only.
///
/// # Errors
/// When settings or path are wrong, a number is too large for the controller, or it would refuse an arc.
pub fn gcode_moves(
    path: &Path,
    settings: &GcodeSettings,
    after: &ModalState,
) -> Result<GcodeMoves, GcodeError> {
    written(path, settings, after).map(|(_, moves)| moves)
}

/// The words of the start, and the blocks.
pub(crate) fn written(
    path: &Path,
    settings: &GcodeSettings,
    after: &ModalState,
) -> Result<(String, GcodeMoves), GcodeError> {
    let mut findings = settings.check();
    if let Some(feed) = after.feed_per_min.filter(|feed| !(feed.is_finite() && *feed > 0.0)) {
        findings.push(super::SettingFinding {
            field: "feed_per_min",
            value: feed.to_string(),
            message: "the feed to restore must be positive".to_owned(),
        });
    }
    if !findings.is_empty() {
        return Err(GcodeError::Settings { findings });
    }
    check_path(path, settings.plane)?;
    let (first, last) = settings.decimals.map_or(
        (
            settings.dialect.usual_decimals(settings.unit),
            settings.dialect.finest_automatic_decimals(settings.unit),
        ),
        |asked| (asked, asked),
    );
    let mut decimals = first;
    loop {
        match with_decimals(path, settings, after, decimals) {
            Err(GcodeError::RadiiDiffer { .. }) if decimals < last => decimals += 1,
            result => return result,
        }
    }
}

fn with_decimals(
    path: &Path,
    settings: &GcodeSettings,
    after: &ModalState,
    decimals: u8,
) -> Result<(String, GcodeMoves), GcodeError> {
    let mut writer = BlockWriter::new(settings, decimals, path.start)?;
    let start = writer.position_text();
    if let Some(z_mm) = path.start_z_mm {
        writer.stand_at_height(z_mm)?;
    }
    let start = start + &writer.height_text();
    let mut from = path.start;
    for (step, number) in path.steps.iter().zip(1..) {
        if let Some(z_mm) = step.z_mm {
            writer.height(z_mm, number)?;
        }
        match step.arc {
            None => writer.straight(step.end, number)?,
            Some(circle) => {
                writer.arc(&Arc::from_center(from, step.end, circle.center, circle.sweep), number)?;
            }
        }
        from = step.end;
    }
    Ok((start, writer.finish(after)))
}

fn check_path(path: &Path, plane: GcodePlane) -> Result<(), GcodeError> {
    let finite = |p: Point, step| {
        let wrong = [p.x, p.y].into_iter().find(|value| !value.is_finite());
        wrong.map_or(Ok(()), |value| Err(GcodeError::NotFinite { step, value }))
    };
    let heights = || std::iter::once(path.start_z_mm).chain(path.steps.iter().map(|step| step.z_mm));
    if heights().any(|z_mm| z_mm.is_some()) {
        if plane != GcodePlane::Xy {
            return Err(GcodeError::Heights);
        }
        for (step, z_mm) in heights().enumerate() {
            let value = z_mm.ok_or(GcodeError::HeightMissing { step })?;
            if !value.is_finite() {
                return Err(GcodeError::NotFinite { step, value });
            }
        }
    }
    finite(path.start, 0)?;
    let mut from = path.start;
    for (each, step) in path.steps.iter().zip(1..) {
        finite(each.end, step)?;
        if let Some(circle) = each.arc {
            finite(circle.center, step)?;
            if !circle.sweep.is_finite() {
                return Err(GcodeError::NotFinite { step, value: circle.sweep });
            }
            let spoke = from - circle.center;
            let direction = spoke.y.atan2(spoke.x) + circle.sweep;
            let distance_mm = (circle.center + unit(direction) * spoke.norm() - each.end).norm();
            let (absolute, relative) = ARC_END_TOLERANCE;
            if distance_mm > absolute + relative * spoke.norm() {
                return Err(GcodeError::ArcContradictsItself { step, distance_mm });
            }
        }
        from = each.end;
    }
    Ok(())
}
