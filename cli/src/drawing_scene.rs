//! From a drawing file to a scene, with everything that was not used said.

use crate::arguments::{Corner, Rapid};
use crate::failure::Failure;
use crate::input;
use traverse_drawing::{
    LayerPattern, ReadOptions, Roles, SceneFromDrawing, SceneOptions, read_dxf, scene_from_drawing,
};
use traverse_geometry::CornerStyle;

/// The scene that `arguments` ask for; the report goes to standard error.
pub(crate) fn scene(arguments: &Rapid) -> Result<SceneFromDrawing, Failure> {
    let path = arguments.drawing.display();
    let bytes = input::read(&arguments.drawing)?;
    let drawing = read_dxf(&bytes, &ReadOptions::default())
        .map_err(|error| Failure::Input(format!("{path}: {error}")))?;
    let found = scene_from_drawing(&drawing, &options(arguments))
        .map_err(|error| Failure::Input(format!("{path}: {error}")))?;
    eprint!("{}", found.report);
    if !found.report.is_complete() && !arguments.ignore_unused {
        return Err(Failure::Input(format!(
            "{path}: parts of it could not be used (see above), so a path may run through them; repair the drawing, \
             choose layers with --obstacles and --work-area, or pass --ignore-unused"
        )));
    }
    Ok(found)
}

fn options(arguments: &Rapid) -> SceneOptions {
    let mut roles = Roles::default();
    let patterns = |names: &[String]| names.iter().map(|name| LayerPattern::new(name)).collect::<Vec<_>>();
    if !arguments.work_area.is_empty() {
        roles.work_area = patterns(&arguments.work_area);
    }
    if !arguments.obstacles.is_empty() {
        roles.obstacles = patterns(&arguments.obstacles);
    }
    SceneOptions {
        roles,
        join_tolerance_mm: arguments.join,
        clearance_mm: arguments.clearance,
        work_area_clearance_mm: arguments.border_clearance,
        corner_style: match arguments.corner {
            Corner::Round => CornerStyle::Round,
            Corner::Miter => CornerStyle::Miter { limit: None },
        },
    }
}
