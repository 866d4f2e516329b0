//! From drawings to scenes: roles, holes and islands, loops that are wrong.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use traverse_drawing::{
    Curve, Drawing, Fault, Layer, LayerPattern, LayerRole, LengthUnit, Roles, SceneError, SceneFromDrawing,
    SceneOptions, scene_from_drawing,
};
use traverse_geometry::Point;

fn closed(points: &[(f64, f64)]) -> Curve {
    let vertices = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
    Curve::new(vertices, vec![0.0; points.len()], true)
}

fn square(corner: f64, side: f64) -> Curve {
    let far = corner + side;
    closed(&[(corner, corner), (far, corner), (far, far), (corner, far)])
}

fn scene(layers: &[(&str, &[Curve])], roles: Roles) -> Result<SceneFromDrawing, SceneError> {
    let layers = layers
        .iter()
        .map(|&(name, curves)| Layer { name: name.to_owned(), curves: curves.to_vec() })
        .collect();
    let drawing = Drawing {
        unit: LengthUnit::MILLIMETRES,
        unit_assumed: false,
        layers,
        unused: Vec::new(),
        mapping: None,
    };
    scene_from_drawing(&drawing, &SceneOptions { roles, ..SceneOptions::new(1.0) })
}

fn ids(made: &SceneFromDrawing) -> Vec<&str> {
    made.scene.obstacles.iter().map(|obstacle| obstacle.id.as_str()).collect()
}

#[test]
fn holes_and_islands_alternate_with_depth() {
    let nested =
        [square(40.0, 20.0), square(0.0, 100.0), square(20.0, 60.0), square(10.0, 80.0), square(200.0, 5.0)];
    let made = scene(&[("A", &nested)], Roles::default()).unwrap();
    // In file order of the outer loops: the island's hole was drawn first but belongs to the island.
    assert_eq!(ids(&made), ["A/1", "A/2", "A/3"]);
    let areas: Vec<f64> = made.scene.obstacles.iter().map(|obstacle| obstacle.shape.area()).collect();
    assert_eq!(areas, [10_000.0 - 6400.0, 3600.0 - 400.0, 25.0]);
    assert!(made.report.is_complete());
}

#[test]
fn layers_are_chosen_by_pattern() {
    let one = [square(0.0, 10.0)];
    let layers: &[(&str, &[Curve])] =
        &[("Clamps-left", &one), ("text", &one), ("BED", &[square(-50.0, 100.0)])];
    let roles = Roles {
        work_area: vec![LayerPattern::new("bed")],
        obstacles: vec![LayerPattern::new("clamps*"), LayerPattern::new("nothing")],
    };
    let made = scene(layers, roles).unwrap();
    assert_eq!(ids(&made), ["Clamps-left/1"]);
    assert!(made.scene.work_area.is_some());
    let roles: Vec<LayerRole> = made.report.layers.iter().map(|layer| layer.role).collect();
    assert_eq!(roles, [LayerRole::Obstacles, LayerRole::None, LayerRole::WorkArea]);
    assert_eq!(made.report.unmatched_patterns, [LayerPattern::new("nothing")]);
    assert!(!made.report.is_complete());
}

#[test]
fn a_loop_that_crosses_itself_is_reported_with_its_place() {
    let bow = closed(&[(500.0, 0.0), (510.0, 10.0), (510.0, 0.0), (500.0, 10.0)]);
    let made = scene(&[("A", &[square(0.0, 10.0), bow])], Roles::default()).unwrap();
    assert_eq!(ids(&made), ["A/1"]);
    assert!(!made.report.is_complete());
    let finding = &made.report.findings[0];
    assert!(matches!(finding.fault, Fault::InvalidLoop { .. }), "{finding}");
    assert!(finding.layer == "A" && (500.0..=510.0).contains(&finding.place.x), "{finding}");
}

#[test]
fn loops_that_cross_are_solid_side_by_side() {
    // A bar from one arm of a C across its opening to the other: a point of it lies in an arm.
    let c = [
        (0.0, 0.0),
        (90.0, 0.0),
        (90.0, 30.0),
        (30.0, 30.0),
        (30.0, 60.0),
        (90.0, 60.0),
        (90.0, 90.0),
        (0.0, 90.0),
    ];
    let bar = closed(&[(60.0, 2.0), (70.0, 2.0), (70.0, 65.0), (60.0, 65.0)]);
    let low = closed(&[(40.0, 2.0), (50.0, 2.0), (50.0, 40.0), (40.0, 40.0)]);
    let made = scene(&[("A", &[closed(&c), bar, low])], Roles::default()).unwrap();
    assert_eq!(ids(&made), ["A/1", "A/2", "A/3"]);
    assert!(made.scene.obstacles.iter().all(|obstacle| obstacle.shape.holes().is_empty()));
    assert!(made.report.findings.iter().all(|finding| matches!(finding.fault, Fault::CrossingLoops { .. })));
    assert!(made.report.is_complete() && !made.report.findings.is_empty());
}

#[test]
fn a_work_area_with_a_wrong_hole_is_refused_and_an_island_reported() {
    let bow = closed(&[(10.0, 10.0), (20.0, 20.0), (20.0, 10.0), (10.0, 21.0)]);
    let area = [square(0.0, 100.0), bow];
    assert!(matches!(scene(&[("table", &area)], Roles::default()), Err(SceneError::InvalidWorkArea { .. })));
    let area = [square(0.0, 100.0), square(10.0, 50.0), square(20.0, 10.0)];
    let made = scene(&[("table", &area)], Roles::default()).unwrap();
    assert_eq!(made.scene.work_area.unwrap().area(), 7500.0);
    assert_eq!(made.report.findings[0].fault, Fault::IslandInWorkArea);
}
