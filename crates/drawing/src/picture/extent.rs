//! The box around everything that a picture draws.

use super::Shown;
use crate::{Drawing, DrawingFinding};
use traverse_geometry::{
    Bounds, COORDINATE_LIMIT_MM, CornerStyle, MITER_RATIO_LIMIT, Obstacle, Point, Polygon, Scene,
};

/// Mitred corners are shown up to so many clearances; longer ones end at the picture's border.
const MITRES_SHOWN: f64 = 2.5;

/// Work area, obstacles with their barriers, moves.
pub(super) fn of_scene(scene: &Scene, shown: &Shown<'_>) -> Bounds {
    let work_area = scene.work_area.iter().map(Polygon::bounds);
    let reach = match scene.corner_style {
        CornerStyle::Round => 1.0,
        CornerStyle::Miter { limit } => limit.unwrap_or(MITER_RATIO_LIMIT).clamp(1.0, MITRES_SHOWN),
    };
    let grown = |each: &Obstacle| each.shape.bounds().grown(reach * scene.clearance_of(each));
    let obstacles = scene.obstacles.iter().map(grown);
    let paths = shown.paths().iter().chain(shown.before());
    let steps = paths.flat_map(|path| path.edges().map(|edge| edge.bounds()));
    let ends = shown.ends().into_iter().map(|(start, target)| Bounds::of([start, target]));
    let (regions, points) = shown.permitted();
    let permitted = regions.iter().map(Polygon::bounds).chain(points.iter().map(|&p| Bounds::of([p])));
    work_area.chain(obstacles).chain(steps).chain(ends).chain(permitted).fold(Bounds::EMPTY, Bounds::union)
}

/// Curves and the places of findings, as far as they can be drawn.
pub(super) fn of_drawing(drawing: &Drawing, findings: &[DrawingFinding]) -> Bounds {
    let curves = drawing.layers.iter().flat_map(|layer| &layer.curves);
    let edges = curves.filter(|curve| curve.vertices.iter().all(|&p| can_be_drawn(p)));
    let edges = edges.flat_map(|curve| curve.edges().map(|edge| edge.bounds()).collect::<Vec<_>>());
    let places = findings.iter().map(|finding| finding.place).filter(|&p| can_be_drawn(p));
    edges.fold(Bounds::EMPTY, Bounds::union).union(Bounds::of(places))
}

/// Whether a point lies where drawings may lie.
pub(super) fn can_be_drawn(p: Point) -> bool {
    p.x.abs() <= COORDINATE_LIMIT_MM && p.y.abs() <= COORDINATE_LIMIT_MM
}
