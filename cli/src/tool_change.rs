//! `traverse tool-change`.

use crate::arguments::{Method, ToolChange as Arguments};
use crate::failure::Failure;
use crate::picture_file::{PictureKind, write_picture};
use crate::{drawing_scene, input, planning, rapid};
use std::path::Path as FilePath;
use traverse_checker::{PlacedChange, check_tool_change};
use traverse_drawing::{Shown, picture_of_plan};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Path, Point, Scene};
use traverse_planner::ToolChange;
use traverse_proto::v1::place_tool_change_response::Outcome;
use traverse_proto::{path_from_wire, tool_change_request, v1};

/// What a file of the command line is to hold.
enum Output {
    Picture(PictureKind),
    Json,
}

pub(crate) async fn run(arguments: Arguments) -> Result<(), Failure> {
    for output in &arguments.rapid.output {
        kind_of(output)?;
    }
    let rapid = &arguments.rapid;
    let (Some(start), Some(target)) = (rapid.from, rapid.to) else {
        return Err(Failure::Input("a tool change needs --from X,Y and --to X,Y".to_owned()));
    };
    if rapid.program.is_some() || matches!(rapid.algorithm, Method::SupportingLines) || rapid.alternatives > 0
    {
        return Err(Failure::Input(
            "--program, --algorithm supporting-lines and --alternatives are for `traverse rapid`; leave them out".to_owned(),
        ));
    }
    let machine = drawing_scene::machine(&rapid.file)?;
    let found = drawing_scene::scene_with_regions(rapid, &arguments.region, machine.as_ref())?;
    let scene = found.scene;
    let motion = rapid.motion.rules(machine.as_ref(), rapid.arc_feed)?;
    let change = ToolChange {
        start,
        target,
        regions: found.parts.into_iter().map(|part| part.shape).collect(),
        points: arguments.at.clone(),
        place_z_mm: arguments.place_z,
        rules: rapid::rules(rapid, scene.clearance_mm, motion),
    };
    let mut request = tool_change_request(&scene, &change);
    if let (Some(limit), Some(rules)) = (rapid.time_limit, &mut request.rules) {
        let time_limit = prost_types::Duration::try_from(limit).ok();
        rules.options = Some(v1::SolveOptions { time_limit, ..Default::default() });
    }
    if let Some(path) = &rapid.request {
        input::write(path, planning::request_json("PlaceToolChange", &request)?)?;
    }
    let caller = planning::caller(rapid.server.as_deref())?;
    let (answer, text): (v1::PlaceToolChangeResponse, _) =
        planning::call(&caller, "PlaceToolChange", &request).await?;
    let moves = moves(&answer)?;
    let title = rapid.file.drawing.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for output in &rapid.output {
        match kind_of(output)? {
            Output::Json => input::write(output, &text)?,
            Output::Picture(kind) => {
                let svg = picture(&scene, &change, &moves, &answer, &title);
                write_picture(output, kind, &svg, rapid.width)?;
            }
        }
        say!("wrote {}", output.display());
    }
    report(&scene, &change, &moves, &answer)
}

fn kind_of(path: &FilePath) -> Result<Output, Failure> {
    if let Some(kind) = PictureKind::known(path) {
        return Ok(Output::Picture(kind));
    }
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("json") => Ok(Output::Json),
        _ => Err(Failure::Input(format!(
            "{}: write to a file that ends in .svg, .png or .json",
            path.display()
        ))),
    }
}

/// The moves to the place and on; empty when there is no place.
fn moves(answer: &v1::PlaceToolChangeResponse) -> Result<Vec<Path>, Failure> {
    let Some(Outcome::Plan(plan)) = &answer.outcome else { return Ok(Vec::new()) };
    [&plan.approach, &plan.departure]
        .into_iter()
        .map(|plan| {
            let path = plan.as_ref().and_then(|plan| plan.path.clone()).unwrap_or_default();
            path_from_wire(path).map_err(|refused| Failure::Internal(refused.message()))
        })
        .collect()
}

fn picture(
    scene: &Scene,
    change: &ToolChange,
    moves: &[Path],
    answer: &v1::PlaceToolChangeResponse,
    title: &str,
) -> String {
    let separating = match &answer.outcome {
        Some(Outcome::NoPath(no_path)) => &no_path.separating_obstacle_ids[..],
        _ => &[],
    };
    let shown = Shown::ToolChange {
        regions: &change.regions,
        points: &change.points,
        ends: (change.start, change.target),
        moves,
        separating,
    };
    let used = match &answer.outcome {
        Some(Outcome::Plan(v1::ToolChangePlan { approach: Some(approach), .. })) => approach.clearance_mm,
        _ => scene.clearance_mm,
    };
    picture_of_plan(&Scene { clearance_mm: used, ..scene.clone() }, shown, title)
}

fn report(
    scene: &Scene,
    change: &ToolChange,
    moves: &[Path],
    answer: &v1::PlaceToolChangeResponse,
) -> Result<(), Failure> {
    match (&answer.outcome, moves) {
        (Some(Outcome::Plan(plan)), [approach, departure]) => {
            let place = plan.place.as_ref().map_or_else(Point::default, |p| Point::new(p.x_mm, p.y_mm));
            say!("place        {:.6}, {:.6}", place.x, place.y);
            if let Some(z) = approach.end_z_mm() {
                say!("changed at   z = {z} mm");
            }
            let straight = (change.target - change.start).norm();
            let unit = if plan.cost_unit() == v1::CostUnit::Seconds {
                let moves = [approach, departure].map(Path::length);
                let length = moves[0] + moves[1];
                say!("length       {length:.6} mm (straight line without a change {straight:.6})");
                say!("both moves   {:.6} s", plan.cost);
                "s"
            } else {
                say!("both moves   {:.6} mm (straight line without a change {straight:.6})", plan.cost);
                "mm"
            };
            let proven = if plan.lower_bound == plan.cost { ", proven cheapest" } else { "" };
            say!("lower bound  {:.6} {unit}{proven}", plan.lower_bound);
            for (name, plan) in [("approach", &plan.approach), ("departure", &plan.departure)] {
                let Some(plan) = plan else { continue };
                let round = match &plan.bending_obstacle_ids[..] {
                    [] => "nothing".to_owned(),
                    ids => ids.join(", "),
                };
                say!("{name:<12} {:.6} {unit} round {round}", plan.cost);
            }
            if change.rules.clearances_mm.len() > 1 {
                say!("clearance    {} mm", plan.approach.as_ref().map_or(0.0, |plan| plan.clearance_mm));
            }
            if let Some(search) = answer.stats.as_ref().and_then(|stats| stats.search_duration) {
                say!("search       {:?} among {} obstacles", rapid::duration(&search), scene.obstacles.len());
            }
            checked(scene, change, place, [approach, departure])
        }
        (Some(Outcome::NoPath(no_path)), _) => Err(Failure::NoPath(format!(
            "there is no place for the tool change: {} in the way; {}",
            rapid::or_none(&no_path.separating_obstacle_ids),
            rapid::feasible(no_path)
        ))),
        _ => Err(Failure::Internal("the answer holds neither a place nor that there is none".to_owned())),
    }
}

/// Checks the answer, wherever it came from.
fn checked(scene: &Scene, change: &ToolChange, place: Point, paths: [&Path; 2]) -> Result<(), Failure> {
    let rules = [change.approach_rules(), change.departure_rules()];
    let placed = PlacedChange {
        scene,
        start: change.start,
        target: change.target,
        regions: &change.regions,
        points: &change.points,
        rules: [&rules[0], &rules[1]],
        place,
        paths,
    };
    let check = check_tool_change(&placed, CONTACT_TOLERANCE_MM);
    for violation in &check.violations {
        say!("{} {}: {}", violation.reason, violation.field, violation.message);
    }
    if check.violations.is_empty() {
        say!("checked      sound");
        return Ok(());
    }
    Err(Failure::Violations(format!("{} violations", check.violations.len())))
}
