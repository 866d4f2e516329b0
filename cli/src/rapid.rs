//! `traverse rapid`.

use crate::arguments::{Method, Rapid};
use crate::failure::Failure;
use crate::picture_file::{PictureKind, write_picture};
use crate::{drawing_scene, input, planning, program};
use std::path::Path as FilePath;
use std::time::Duration;
use traverse_drawing::{ArcMotion, GcodeSettings, Machine, Shown, picture_of_plan, write_dxf, write_gcode};
use traverse_geometry::{HeightRule, Path, RapidRules, Scene};
use traverse_planner::{Algorithm, RapidMove, as_run};
use traverse_proto::v1::plan_rapid_move_response::Outcome;
use traverse_proto::{path_from_wire, plan_request, v1};

pub(crate) async fn run(arguments: Rapid) -> Result<(), Failure> {
    for output in &arguments.output {
        kind_of(output)?;
    }
    if let Some(file) = &arguments.program {
        return program::run(&arguments, file);
    }
    let (Some(from), Some(to)) = (arguments.from, arguments.to) else {
        return Err(Failure::Internal("the command line has no ends".to_owned()));
    };
    let machine = drawing_scene::machine(&arguments.file)?;
    // Before anything is planned or written.
    for output in &arguments.output {
        if matches!(kind_of(output)?, Output::Program) {
            gcode_settings(machine.as_ref(), output)?;
        }
    }
    let scene = drawing_scene::scene(&arguments, machine.as_ref())?.scene;
    let algorithm = match arguments.algorithm {
        Method::Exact => Algorithm::Exact,
        Method::SupportingLines => Algorithm::SupportingLines,
    };
    let motion = arguments.motion.rules(machine.as_ref(), arguments.arc_feed)?;
    let rules = rules(&arguments, scene.clearance_mm, motion);
    let query = RapidMove { start: from, target: to, algorithm, rules };
    let mut request = plan_request(&scene, &query);
    if let (Some(limit), Some(rules)) = (arguments.time_limit, &mut request.rules) {
        let time_limit = prost_types::Duration::try_from(limit).ok();
        rules.options = Some(v1::SolveOptions { time_limit, ..Default::default() });
    }
    if let Some(path) = &arguments.request {
        input::write(path, planning::request_json("PlanRapidMove", &request)?)?;
    }
    let caller = planning::caller(arguments.server.as_deref())?;
    let (answer, text) = planning::plan(&caller, &request).await?;
    let title = arguments.file.drawing.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for output in &arguments.output {
        match kind_of(output)? {
            Output::Json => input::write(output, &text)?,
            Output::Picture(kind) => {
                let svg = picture(&scene, &request, &query.rules, &answer, &title)?;
                write_picture(output, kind, &svg, arguments.width)?;
            }
            Output::Drawing | Output::Program => {
                let Some(path) = path_of(&answer)? else { continue };
                input::write(output, written(&path, &scene, machine.as_ref(), output)?)?;
            }
        }
        say!("wrote {}", output.display());
    }
    report(&scene, &arguments, (to - from).norm(), &answer)
}

/// The rules that the command line asks for. What is wrong with them the service says.
pub(crate) fn rules(arguments: &Rapid, clearance_mm: f64, motion: RapidRules) -> RapidRules {
    let heights = arguments.start_z.map(|start_z_mm| HeightRule {
        start_z_mm,
        target_z_mm: arguments.target_z.unwrap_or(start_z_mm),
        highest_z_mm: arguments.highest_z.unwrap_or(start_z_mm),
        clearance_z_mm: arguments.clearance_z.unwrap_or(clearance_mm),
    });
    let mut clearances_mm = arguments.clearance.clone();
    clearances_mm.sort_by(|a, b| b.total_cmp(a));
    clearances_mm.dedup();
    if clearances_mm.len() < 2 {
        clearances_mm.clear();
    }
    RapidRules {
        heights,
        clearances_mm,
        leave: arguments.leave,
        enter: arguments.enter,
        alternative_count: arguments.alternatives,
        ..motion
    }
}

/// What a file of the command line is to hold, by the ending of its name.
pub(crate) enum Output {
    Picture(PictureKind),
    Json,
    Drawing,
    Program,
}

/// The path as a drawing or as G-code.
fn written(
    path: &Path,
    scene: &Scene,
    machine: Option<&Machine>,
    output: &FilePath,
) -> Result<String, Failure> {
    let name = output.display();
    if matches!(kind_of(output)?, Output::Drawing) {
        return write_dxf(&path.in_plane(), Some(scene))
            .map_err(|error| Failure::Input(format!("{name}: {error}")));
    }
    let settings = gcode_settings(machine, output)?;
    let program = write_gcode(path, settings).map_err(|error| Failure::Input(format!("{name}: {error}")))?;
    // Where all arcs are chords, none is for being small.
    let is_fed = matches!(settings.arcs, ArcMotion::Fed { .. });
    if is_fed && program.moves.straightened_arc_count > 0 {
        eprintln!(
            "{name}: {} arcs are too small for the decimals and run as chords outside them",
            program.moves.straightened_arc_count
        );
    }
    Ok(program.text)
}

/// How the machine wants its G-code.
fn gcode_settings<'m>(machine: Option<&'m Machine>, output: &FilePath) -> Result<&'m GcodeSettings, Failure> {
    machine.and_then(|machine| machine.gcode.as_ref()).ok_or_else(|| {
        Failure::Input(format!(
            "{}: G-code differs by machine; pass --machines FILE and --machine NAME of a profile with [gcode]",
            output.display()
        ))
    })
}

/// The answer's path, if it has one.
fn path_of(answer: &v1::PlanRapidMoveResponse) -> Result<Option<Path>, Failure> {
    match &answer.outcome {
        Some(Outcome::Plan(plan)) => path_from_wire(plan.path.clone().unwrap_or_default())
            .map(Some)
            .map_err(|refused| Failure::Internal(refused.message())),
        _ => Ok(None),
    }
}

pub(crate) fn kind_of(path: &FilePath) -> Result<Output, Failure> {
    if let Some(kind) = PictureKind::known(path) {
        return Ok(Output::Picture(kind));
    }
    match path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("json") => Ok(Output::Json),
        Some("dxf") => Ok(Output::Drawing),
        Some("nc" | "ngc" | "gcode" | "tap") => Ok(Output::Program),
        _ => Err(Failure::Input(format!(
            "{}: write to a file that ends in .svg, .png, .json, .dxf or .nc",
            path.display()
        ))),
    }
}

/// The answer as a picture, dog-legs as they are run.
pub(crate) fn picture(
    scene: &Scene,
    request: &v1::PlanRapidMoveRequest,
    rules: &RapidRules,
    answer: &v1::PlanRapidMoveResponse,
    title: &str,
) -> Result<String, Failure> {
    let point = |point: &Option<v1::Point>| {
        point.as_ref().map_or_else(Default::default, |p| traverse_geometry::Point::new(p.x_mm, p.y_mm))
    };
    Ok(match &answer.outcome {
        Some(Outcome::Plan(plan)) => {
            let path = path_of(answer)?.unwrap_or_else(|| Path::at(point(&request.start)));
            let scene = Scene { clearance_mm: plan.clearance_mm, ..scene.clone() };
            let others: Vec<Path> = if algorithm(request) == v1::RapidAlgorithm::SupportingLines {
                Vec::new()
            } else {
                let others = plan.alternatives.iter().cloned().map(path_from_wire);
                others.collect::<Result<_, _>>().map_err(|refused| Failure::Internal(refused.message()))?
            };
            let path = as_run(&path, rules);
            let others: Vec<Path> = others.iter().map(|other| as_run(other, rules)).collect();
            let shown = match others.is_empty() {
                true => Shown::Path(&path),
                false => Shown::Choice { path: &path, others: &others },
            };
            picture_of_plan(&scene, shown, title)
        }
        Some(Outcome::NoPath(no_path)) => {
            let shown = Shown::NoPath {
                start: point(&request.start),
                target: point(&request.target),
                separating: &no_path.separating_obstacle_ids,
            };
            picture_of_plan(scene, shown, title)
        }
        None => picture_of_plan(scene, Shown::Scene, title),
    })
}

fn algorithm(request: &v1::PlanRapidMoveRequest) -> v1::RapidAlgorithm {
    request.rules.as_ref().map_or(v1::RapidAlgorithm::Exact, v1::RapidRules::algorithm)
}

fn report(
    scene: &Scene,
    arguments: &Rapid,
    straight: f64,
    answer: &v1::PlanRapidMoveResponse,
) -> Result<(), Failure> {
    match &answer.outcome {
        Some(Outcome::Plan(plan)) => {
            let steps = plan.path.as_ref().map_or(0, |path| path.steps.len());
            let arcs =
                plan.path.iter().flat_map(|path| &path.steps).filter(|step| step.arc.is_some()).count();
            let length = plan.path.as_ref().map_or(0.0, |path| path.length_mm);
            say!("length       {length:.6} mm (straight line {straight:.6})");
            let is_proven = plan.lower_bound == plan.cost;
            if plan.cost_unit() == v1::CostUnit::Seconds {
                say!("time         {:.6} s", plan.cost);
                say!(
                    "lower bound  {:.6} s{}",
                    plan.lower_bound,
                    if is_proven { ", proven best" } else { "" }
                );
            } else {
                say!(
                    "lower bound  {:.6} mm{}",
                    plan.lower_bound,
                    if is_proven { ", proven shortest" } else { "" }
                );
            }
            say!("steps        {steps}, of which {arcs} are arcs");
            let heights = plan
                .path
                .iter()
                .flat_map(|path| path.steps.iter().map(|step| step.z_mm).chain([path.start_z_mm]));
            if let Some(level) = heights.flatten().max_by(f64::total_cmp) {
                say!("travels at   z = {level} mm");
            }
            if arguments.clearance.len() > 1 {
                say!("clearance    {} mm", plan.clearance_mm);
            }
            say!(
                "goes round   {}",
                if plan.bending_obstacle_ids.is_empty() {
                    "nothing".to_owned()
                } else {
                    plan.bending_obstacle_ids.join(", ")
                }
            );
            let kind = if matches!(arguments.algorithm, Method::Exact) { "other way" } else { "candidate" };
            for (way, cost) in plan.alternatives.iter().zip(&plan.alternative_costs) {
                if plan.cost_unit() == v1::CostUnit::Seconds {
                    say!("{kind:<12} {cost:.6} s, {:.6} mm", way.length_mm);
                } else {
                    say!("{kind:<12} {:.6} mm", way.length_mm);
                }
            }
            if let Some(search) = answer.stats.as_ref().and_then(|stats| stats.search_duration) {
                say!("search       {:?} among {} obstacles", duration(&search), scene.obstacles.len());
            }
            Ok(())
        }
        Some(Outcome::NoPath(no_path)) => Err(Failure::NoPath(format!(
            "there is no path: start and target are parted by {}; {}",
            or_none(&no_path.separating_obstacle_ids),
            feasible(no_path)
        ))),
        None => Err(Failure::Internal("the answer holds neither a plan nor that there is none".to_owned())),
    }
}

/// At which clearance there is what is not.
pub(crate) fn feasible(no_path: &v1::NoPath) -> String {
    match no_path.feasible_clearance_mm {
        Some(clearance) => {
            format!("at a clearance of {clearance:.6} mm, all others lowered as much, there is one")
        }
        None if no_path.feasible_clearance_unknown => {
            "at which clearance there is one was not known in time".to_owned()
        }
        None => "there is none at any clearance".to_owned(),
    }
}

pub(crate) fn or_none(ids: &[String]) -> String {
    if ids.is_empty() { "nothing but the work area's border, if any".to_owned() } else { ids.join(", ") }
}

/// A duration from the wire; what is out of range is 0.
pub(crate) fn duration(wire: &prost_types::Duration) -> Duration {
    Duration::try_from(*wire).unwrap_or_default()
}
