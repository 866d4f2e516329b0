//! From a drawing file to a scene, with everything that was not used said.

use crate::arguments::{Corner, Rapid};
use crate::failure::Failure;
use crate::input;
use traverse_drawing::{
    Machine, ObstacleRole, Profiles, ReadOptions, SceneFromDrawing, SceneOptions, Selector, read_dxf,
    scene_from_drawing,
};
use traverse_geometry::CornerStyle;

/// The scene that `arguments` ask for; the report goes to standard error.
pub(crate) fn scene(arguments: &Rapid, machine: Option<&Machine>) -> Result<SceneFromDrawing, Failure> {
    let path = arguments.drawing.display();
    let options = options(arguments, machine)?;
    let bytes = input::read(&arguments.drawing)?;
    let drawing = read_dxf(&bytes, &ReadOptions::default())
        .map_err(|error| Failure::Input(format!("{path}: {error}")))?;
    let found =
        scene_from_drawing(&drawing, &options).map_err(|error| Failure::Input(format!("{path}: {error}")))?;
    eprint!("{}", found.report);
    if !found.report.is_complete() && !arguments.ignore_unused {
        return Err(Failure::Input(format!(
            "{path}: parts of it could not be used (see above), so a path may run through them; repair the drawing, \
             choose layers with --obstacles and --work-area, or pass --ignore-unused"
        )));
    }
    Ok(found)
}

/// The machine that `arguments` name, if any.
pub(crate) fn machine(arguments: &Rapid) -> Result<Option<Machine>, Failure> {
    let (Some(file), Some(name)) = (&arguments.machines, &arguments.machine) else { return Ok(None) };
    let bytes = input::read(file)?;
    let profiles = Profiles::read_from(&*bytes, &file.display().to_string());
    let found = profiles.and_then(|profiles| profiles.machine(name).cloned());
    found.map(Some).map_err(|error| Failure::Input(error.to_string()))
}

/// The machine's settings, and those of the command line over them.
fn options(arguments: &Rapid, machine: Option<&Machine>) -> Result<SceneOptions, Failure> {
    let stated = arguments.clearance.or_else(|| machine.and_then(|machine| machine.clearance_mm));
    let Some(clearance_mm) = stated else {
        return Err(Failure::Input(
            "no clearance is known; pass --clearance MM or state it in the profile".to_owned(),
        ));
    };
    let mut options = SceneOptions::new(clearance_mm);
    if let Some(machine) = machine {
        machine.apply_to(&mut options);
        options.clearance_mm = clearance_mm;
    }
    if !arguments.work_area.is_empty() {
        options.roles.work_area = arguments.work_area.iter().map(|text| Selector::new(text)).collect();
    }
    if !arguments.obstacles.is_empty() {
        options.roles.obstacles = arguments.obstacles.iter().map(|text| ObstacleRole::new(text)).collect();
    }
    options.join_tolerance_mm = arguments.join;
    options.work_area_clearance_mm = arguments.border_clearance.or(options.work_area_clearance_mm);
    match arguments.corner {
        Some(Corner::Round) => options.corner_style = CornerStyle::Round,
        Some(Corner::Miter) => options.corner_style = CornerStyle::Miter { limit: None },
        None => {}
    }
    Ok(options)
}
