//! From a drawing file to a scene, with everything that was not used said.

use crate::arguments::{Corner, DrawingFile, Rapid, Unit};
use crate::failure::Failure;
use crate::input;
use std::collections::BTreeMap;
use traverse_drawing::{
    Drawing, LengthUnit, Machine, ObstacleRole, Profiles, ReadOptions, Roles, SceneFromDrawing, SceneOptions,
    Selector, read_drawing, scene_from_drawing,
};
use traverse_geometry::{CornerStyle, Scene};

/// The scene that `arguments` ask for; the report goes to standard error.
pub(crate) fn scene(arguments: &Rapid, machine: Option<&Machine>) -> Result<SceneFromDrawing, Failure> {
    found_in(&read(&arguments.file)?, arguments, &options(arguments, machine)?)
}

/// The same, with loops that are no obstacles: the parts of what is found.
pub(crate) fn scene_with_regions(
    arguments: &Rapid,
    regions: &[String],
    machine: Option<&Machine>,
) -> Result<SceneFromDrawing, Failure> {
    let mut options = options(arguments, machine)?;
    options.roles.parts = regions.iter().map(|text| Selector::new(text)).collect();
    found_in(&read(&arguments.file)?, arguments, &options)
}

/// The scene for every tool that `machine` knows the clearance of, and for all others.
pub(crate) fn scenes_by_tool(
    arguments: &Rapid,
    machine: Option<&Machine>,
) -> Result<(Scene, BTreeMap<u32, Scene>), Failure> {
    let options = options(arguments, machine)?;
    let drawing = read(&arguments.file)?;
    let any = found_in(&drawing, arguments, &options)?.scene;
    let clearances = machine.map(|machine| machine.tool_clearances_mm.clone()).unwrap_or_default();
    let by_tool = clearances.into_iter().map(|(tool, clearance_mm)| {
        let mut options = options.clone();
        options.clearance_mm = clearance_mm;
        // A larger tool keeps more from obstacles with a clearance of their own as well.
        for role in &mut options.roles.obstacles {
            role.clearance_mm = role.clearance_mm.map(|own| own.max(clearance_mm));
        }
        let scene = scene_from_drawing(&drawing, &options).map(|found| found.scene);
        scene
            .map(|scene| (tool, scene))
            .map_err(|error| Failure::Input(format!("{}: {error}", arguments.file.drawing.display())))
    });
    Ok((any, by_tool.collect::<Result<_, _>>()?))
}

fn found_in(
    drawing: &Drawing,
    arguments: &Rapid,
    options: &SceneOptions,
) -> Result<SceneFromDrawing, Failure> {
    let path = arguments.file.drawing.display();
    if let Some(mapping) = &drawing.mapping {
        eprintln!("page: {mapping}");
    }
    let found =
        scene_from_drawing(drawing, options).map_err(|error| Failure::Input(format!("{path}: {error}")))?;
    eprint!("{}", found.report);
    if !found.report.is_complete() && !arguments.ignore_unused {
        return Err(Failure::Input(format!(
            "{path}: parts of it could not be used (see above), so a path may run through them; look at them with \
             `traverse inspect {path} -o drawing.svg`, repair the drawing, choose with --obstacles and --work-area, or \
             pass --ignore-unused"
        )));
    }
    let is_empty = found.scene.obstacles.is_empty() && found.scene.work_area.is_none();
    if is_empty && !arguments.ignore_unused {
        return Err(Failure::Input(format!(
            "{path}: there is neither an obstacle nor a work area in it, so every path would do; look at it with \
             `traverse inspect {path}`, choose with --obstacles and --work-area, or pass --ignore-unused"
        )));
    }
    Ok(found)
}

/// The drawing.
pub(crate) fn read(file: &DrawingFile) -> Result<Drawing, Failure> {
    let bytes = input::read(&file.drawing)?;
    let mut options = ReadOptions::default();
    options.default_unit = match file.unit {
        Unit::Mm => LengthUnit::MILLIMETRES,
        Unit::Inch => LengthUnit::INCHES,
    };
    options.pixels_per_inch = file.dpi;
    options.fit_tolerance_mm = file.fit;
    read_drawing(&bytes, &options)
        .map_err(|error| Failure::Input(format!("{}: {error}", file.drawing.display())))
}

/// The machine that is named, if any.
pub(crate) fn machine(file: &DrawingFile) -> Result<Option<Machine>, Failure> {
    let (Some(machines), Some(name)) = (&file.machines, &file.machine) else { return Ok(None) };
    let bytes = input::read(machines)?;
    let profiles = Profiles::read_from(&*bytes, &machines.display().to_string());
    let found = profiles.and_then(|profiles| profiles.machine(name).cloned());
    found.map(Some).map_err(|error| Failure::Input(error.to_string()))
}

/// What the command line says of roles, over what `roles` hold.
pub(crate) fn choose_roles(file: &DrawingFile, roles: &mut Roles) {
    if !file.work_area.is_empty() {
        roles.work_area = file.work_area.iter().map(|text| Selector::new(text)).collect();
    }
    if !file.obstacles.is_empty() {
        roles.obstacles = file.obstacles.iter().map(|text| ObstacleRole::new(text)).collect();
    }
}

/// The machine's settings, and those of the command line over them.
fn options(arguments: &Rapid, machine: Option<&Machine>) -> Result<SceneOptions, Failure> {
    let stated = arguments
        .clearance
        .iter()
        .copied()
        .max_by(f64::total_cmp)
        .or_else(|| machine.and_then(|machine| machine.clearance_mm));
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
    choose_roles(&arguments.file, &mut options.roles);
    for obstacle in &mut options.roles.obstacles {
        obstacle.top_mm = obstacle.top_mm.or(arguments.top);
    }
    options.join_tolerance_mm = arguments.file.join;
    options.work_area_clearance_mm = arguments.border_clearance.or(options.work_area_clearance_mm);
    match arguments.corner {
        Some(Corner::Round) => options.corner_style = CornerStyle::Round,
        Some(Corner::Miter) => options.corner_style = CornerStyle::Miter { limit: None },
        None => {}
    }
    Ok(options)
}
