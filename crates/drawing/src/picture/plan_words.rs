//! What the picture of a plan says in words: lengths, clearance, where the ends are, what is not shown.

use super::Shown;
use super::header::Header;
use super::sign::Sign;
use super::text::millimetres;
use traverse_geometry::{CornerStyle, Path, Point, Scene};

/// Ids that found no room are named up to so many; more are counted.
const NAMED: usize = 12;

/// Title, length or that there is no path, clearance.
pub(super) fn header(scene: &Scene, shown: &Shown<'_>, title: &str) -> Header {
    let header = Header::titled(title);
    match shown {
        Shown::NoPath { separating: [], .. } => header
            .with_alert("no path: the work area's border parts start from target")
            .with(&clearance(scene)),
        Shown::NoPath { separating, .. } => header
            .with_alert(&format!("no path: start and target are parted by {}", separating.join(", ")))
            .with(&clearance(scene)),
        Shown::Scene => header.with(&clearance(scene)),
        Shown::ToolChange { moves: [], separating, .. } => {
            let why = match separating {
                [] => "the work area's border or nothing permitted is in the way".to_owned(),
                _ => format!("{} in the way", separating.join(", ")),
            };
            header.with_alert(&format!("no place for the tool change: {why}")).with(&clearance(scene))
        }
        Shown::ToolChange { moves, ends: (start, target), .. } => {
            let place = shown.place().map_or_else(String::new, coordinates);
            header.with(&format!(
                "tool change at {place}: both moves {}, straight {}, {}",
                millimetres(length(moves)),
                millimetres((target - start).norm()),
                clearance(scene)
            ))
        }
        Shown::Path(_) | Shown::Paths(_) | Shown::Choice { .. } => {
            let straight: f64 = shown.ends().iter().map(|(start, target)| (target - start).norm()).sum();
            let (moves, length) = (moves(shown.paths().len()), length(shown.paths()));
            let level = shown.level().map_or_else(String::new, |z| format!(", at z = {}", millimetres(z)));
            header.with(&format!(
                "{moves} {}{level}, straight {}, {}",
                millimetres(length),
                millimetres(straight),
                clearance(scene)
            ))
        }
        Shown::Change { before, after } => {
            let (was, is) = (length(before), length(after));
            header
                .with_strong(&format!(
                    "{} {}, before {}: {}",
                    moves(after.len()),
                    millimetres(is),
                    millimetres(was),
                    saving(was, is)
                ))
                .with(&clearance(scene))
        }
    }
}

/// What the picture holds, with the places of the ends when there is one move.
pub(super) fn legend(scene: &Scene, shown: &Shown<'_>) -> Vec<(Sign, String)> {
    let barriers = scene.obstacles.iter().any(|obstacle| scene.clearance_of(obstacle) > 0.0)
        || scene.work_area.is_some() && scene.border_clearance() > 0.0;
    let passed = scene.obstacles.iter().any(|obstacle| shown.passes_over(scene, obstacle));
    let parted = matches!(shown, Shown::NoPath { .. });
    let no_place = matches!(shown, Shown::ToolChange { moves: [], separating: [_, ..], .. });
    let (regions, points) = shown.permitted();
    let others = String::from(if matches!(shown, Shown::Choice { .. }) { "other ways" } else { "before" });
    let ends = shown.ends();
    let end_at = |name: &str, place: fn(&(Point, Point)) -> Point| match &ends[..] {
        [one] => format!("{name} {}", coordinates(place(one))),
        _ => name.to_owned(),
    };
    let entries = [
        (scene.work_area.is_some(), Sign::Line("border"), String::from("work area")),
        (!scene.obstacles.is_empty(), Sign::Field("obstacle"), String::from("obstacle")),
        (passed, Sign::Field("obstacle passed"), String::from("passed over")),
        (barriers, Sign::Field("zone"), String::from("barrier")),
        (parted, Sign::Field("obstacle parts"), String::from("parts start from target")),
        (no_place, Sign::Field("obstacle parts"), String::from("in the way")),
        (!shown.paths().is_empty(), Sign::Line("rapid"), String::from("rapid move")),
        (!shown.before().is_empty(), Sign::Line("before"), others),
        (
            !regions.is_empty() || !points.is_empty(),
            Sign::Field("region"),
            String::from("tool change permitted"),
        ),
        (shown.place().is_some(), Sign::Place, String::from("tool change")),
        (parted, Sign::Line("wish"), String::from("wanted")),
        (!ends.is_empty(), Sign::Start, end_at("start", |ends| ends.0)),
        (!ends.is_empty(), Sign::Target, end_at("target", |ends| ends.1)),
    ];
    entries.into_iter().filter(|(holds, ..)| *holds).map(|(_, sign, text)| (sign, text)).collect()
}

/// The obstacles whose ids found no room; empty when all did.
pub(super) fn unnamed(ids: &[&str], of: usize) -> String {
    match ids {
        [] => String::new(),
        _ if ids.len() <= NAMED => format!("no room for the ids of {}", ids.join(", ")),
        _ => format!("no room for {} of {of} ids", ids.len()),
    }
}

fn moves(count: usize) -> String {
    if count == 1 { "rapid move".to_owned() } else { format!("{count} rapid moves") }
}

fn length(paths: &[Path]) -> f64 {
    paths.iter().map(Path::length).sum()
}

/// How much shorter the new length is, in percent of the old one.
fn saving(was: f64, is: f64) -> String {
    let percent = if was > 0.0 { (was - is) / was * 100.0 } else { 0.0 };
    match percent {
        _ if percent.abs() < 0.05 => String::from("as long"),
        _ if percent > 0.0 => format!("{percent:.1} % shorter"),
        _ => format!("{:.1} % longer", -percent),
    }
}

/// Both coordinates, millimetres, without the unit.
fn coordinates(p: Point) -> String {
    let [x, y] = [p.x, p.y].map(|value| millimetres(value).trim_end_matches(" mm").to_owned());
    format!("{x}, {y}")
}

fn clearance(scene: &Scene) -> String {
    let corners = match scene.corner_style {
        CornerStyle::Round => "round corners",
        CornerStyle::Miter { .. } => "mitred corners",
    };
    format!("clearance {}, {corners}", millimetres(scene.clearance_mm))
}
