//! `traverse rapid --program`: the rapid moves of a G-code program.

use crate::arguments::Rapid;
use crate::clock::Clock;
use crate::failure::Failure;
use crate::picture_file::write_picture;
use crate::program_table::ProgramTable;
use crate::rapid::{Output, kind_of};
use crate::{drawing_scene, input};
use std::path::Path as FilePath;
use std::time::Instant;
use traverse_drawing::{ArcMotion, GcodePlane, GcodeUnit, Machine, Shown, StraightMotion, picture_of_plan};
use traverse_geometry::{HeightRule, Path, RapidMotion, RapidRules, Scene};
use traverse_planner::as_run;
use traverse_programs::{
    Done, Link, PassingOver, Program, ReadOptions, Reason, Rewritten, ScenePlanner, ToolScenes, WriteOptions,
    rewrite,
};
use traverse_solve::Budget;

pub(crate) fn run(arguments: &Rapid, file: &FilePath) -> Result<(), Failure> {
    for output in &arguments.output {
        if !matches!(kind_of(output)?, Output::Program | Output::Picture(_)) {
            return Err(Failure::Input(format!(
                "{}: a program is written to .nc, .ngc, .gcode or .tap, its picture to .svg or .png",
                output.display()
            )));
        }
    }
    if arguments.clearance.len() > 1 {
        return Err(Failure::Input(
            "--program takes one clearance; those of tools are the profile's".to_owned(),
        ));
    }
    let machine = drawing_scene::machine(&arguments.file)?;
    let (read_options, write_options) = options(arguments, machine.as_ref())?;
    let bytes = input::read(file)?;
    let program = Program::read(&bytes, &read_options)
        .map_err(|error| Failure::Input(format!("{}: {error}", file.display())))?;
    let (mut any, mut by_tool) = drawing_scene::scenes_by_tool(arguments, machine.as_ref())?;
    let over = passing_over(arguments, &program, &any)?;
    if let Some((over, safe_z)) = over.zip(arguments.safe_z) {
        for scene in by_tool.values_mut().chain([&mut any]) {
            lower_tops(scene, &over, safe_z);
        }
    }
    let scenes = ToolScenes { any, by_tool, safe_z_mm: arguments.safe_z };
    let mut budget = Budget::unlimited();
    budget.deadline = arguments.time_limit.and_then(|limit| Instant::now().checked_add(limit));
    let rules = rules(arguments, machine.as_ref(), over.as_ref())?;
    let mut planner = ScenePlanner::by(&scenes, &rules, &budget);
    if let Some(over) = over {
        planner = planner.passing_over(over);
    }
    let rewritten = rewrite(&program, &planner, &write_options);
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    for output in &arguments.output {
        match kind_of(output)? {
            Output::Picture(kind) => {
                let svg = picture(&scenes, &program, &rewritten, &rules, write_options.straight, &name);
                write_picture(output, kind, &svg, arguments.width)?;
            }
            _ => input::write(output, &rewritten.text)?,
        }
        say!("wrote {}", output.display());
    }
    let table = ProgramTable {
        program: &program,
        rewritten: &rewritten,
        clocks: clocks(arguments, machine.as_ref(), &write_options, rules.motion),
    };
    say!("{table}");
    match rewritten.outcomes.iter().filter(|outcome| outcome.still_hits()).count() {
        0 if rewritten.outcomes.iter().any(|outcome| outcome.done == Done::Left(Reason::Interrupted)) => {
            Err(Failure::NotNow("time was over before every rapid move was looked at (see above)".to_owned()))
        }
        0 => Ok(()),
        1 => {
            Err(Failure::Violations("1 rapid move still comes too near to something (see above)".to_owned()))
        }
        count => Err(Failure::Violations(format!(
            "{count} rapid moves still come too near to something (see above)"
        ))),
    }
}

/// How the tool passes over what is low: as soon as a top is known.
fn passing_over(
    arguments: &Rapid,
    program: &Program<'_>,
    scene: &Scene,
) -> Result<Option<PassingOver>, Failure> {
    if scene.obstacles.iter().all(|obstacle| obstacle.top_z_mm.is_none()) {
        if arguments.highest_z.or(arguments.clearance_z).is_some() {
            return Err(Failure::Input(
                "no obstacle can be passed over, for no top is known; pass --top MM or state top_mm in the profile"
                    .to_owned(),
            ));
        }
        return Ok(None);
    }
    Ok(Some(PassingOver {
        clearance_z_mm: arguments.clearance_z,
        highest_z_mm: arguments.highest_z.or(program.highest_rapid_z_mm),
    }))
}

/// No top reaches to where nothing is in the way.
fn lower_tops(scene: &mut Scene, over: &PassingOver, safe_z_mm: f64) {
    let highest = safe_z_mm - over.clearance_z_mm.unwrap_or(scene.clearance_mm);
    for obstacle in &mut scene.obstacles {
        obstacle.top_z_mm = Some(obstacle.top_z_mm.map_or(highest, |top| top.min(highest)));
    }
}

/// What ways cost and how G0 runs.
fn rules(
    arguments: &Rapid,
    machine: Option<&Machine>,
    over: Option<&PassingOver>,
) -> Result<RapidRules, Failure> {
    if arguments.motion.arcs.is_some() {
        return Err(Failure::Input(
            "--arcs is for plans; a program's arcs are fed with --arc-feed or as the profile says, otherwise chords".to_owned(),
        ));
    }
    let rules = arguments.motion.rules(machine, arguments.arc_feed)?;
    let heights = over.map(|over| {
        let z_mm = over.highest_z_mm.unwrap_or(0.0);
        HeightRule {
            start_z_mm: z_mm,
            target_z_mm: z_mm,
            highest_z_mm: z_mm,
            clearance_z_mm: over.clearance_z_mm.unwrap_or(0.0),
        }
    });
    match (RapidRules { heights, ..rules.clone() }).findings().first() {
        None => Ok(rules),
        Some(finding) => Err(Failure::Input(finding.message.clone())),
    }
}

/// How long ways take as they were and as they are written.
fn clocks(
    arguments: &Rapid,
    machine: Option<&Machine>,
    write: &WriteOptions,
    motion: RapidMotion,
) -> Option<[Clock; 2]> {
    let feed = match write.arcs {
        ArcMotion::Fed { feed_mm_per_min } => Some(feed_mm_per_min),
        ArcMotion::Chords { .. } => None,
    };
    let clock = Clock::of(&arguments.motion.speeds(machine, arguments.arc_feed), motion, feed)?;
    Some([clock.clone(), clock.written(write.straight)])
}

/// What the profile says of programs, and the command line over it.
fn options(arguments: &Rapid, machine: Option<&Machine>) -> Result<(ReadOptions, WriteOptions), Failure> {
    let gcode = machine.and_then(|machine| machine.gcode.as_ref());
    let mut read = ReadOptions::new(gcode.map_or(GcodeUnit::Millimetres, |gcode| gcode.unit));
    let mut write = WriteOptions::default();
    if let Some(gcode) = gcode {
        if gcode.plane != GcodePlane::Xy {
            return Err(Failure::Input(
                "programs of lathes are not read yet; use a profile with plane = \"G17\"".to_owned(),
            ));
        }
        read.dialect = Some(gcode.dialect);
        (write.straight, write.arcs, write.decimals) = (gcode.straight, gcode.arcs, gcode.decimals);
    }
    if let Some(feed_mm_per_min) = arguments.arc_feed {
        if !(1.0..=1e6).contains(&feed_mm_per_min) {
            return Err(Failure::Input(format!(
                "--arc-feed {feed_mm_per_min} is out of range; use 1 to 1000000 mm/min"
            )));
        }
        write.arcs = ArcMotion::Fed { feed_mm_per_min };
    }
    read.start = arguments.from;
    for (number, origin) in machine.iter().flat_map(|machine| &machine.offsets) {
        read.offsets.set(*number, *origin);
    }
    Ok((read, write))
}

/// Every way that is known and does not pass over everything, as it was and as it is, dog-legs as they are run.
fn picture(
    scenes: &ToolScenes,
    program: &Program<'_>,
    rewritten: &Rewritten,
    rules: &RapidRules,
    straight: StraightMotion,
    title: &str,
) -> String {
    let passes_over = |link: &Link| {
        link.heights.lowest().zip(scenes.safe_z_mm).is_some_and(|(lowest, safe)| lowest >= safe)
    };
    let shown = program.links.iter().zip(&rewritten.outcomes).filter(|(link, _)| !passes_over(link));
    // Lengths count rises and sinks; dog-legs are run in the plane.
    let run = |path: &Path| match rules.dog_leg() {
        Some(_) => as_run(&path.in_plane(), rules),
        None => path.clone(),
    };
    let (before, after): (Vec<Path>, Vec<Path>) = shown
        .map(|(_, outcome)| {
            let before = run(&outcome.before);
            match &outcome.done {
                Done::Changed(path) if straight == StraightMotion::Rapid => (before, run(path)),
                Done::Changed(path) => (before, path.clone()),
                _ => (before.clone(), before),
            }
        })
        .unzip();
    picture_of_plan(&scenes.any, Shown::Change { before: &before, after: &after }, title)
}
