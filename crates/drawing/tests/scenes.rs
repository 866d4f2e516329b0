//! From drawings to scenes: roles, holes and islands, loops that are wrong.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::sync::Arc;
use traverse_drawing::{
    Color, Curve, Drawing, Fault, Layer, LengthUnit, ObstacleRole, Role, Roles, SceneError, SceneFromDrawing,
    SceneOptions, Source, scene_from_drawing,
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
        work_area: vec!["bed".into()],
        obstacles: vec![ObstacleRole::new("clamps*"), ObstacleRole::new("nothing")],
        ..Roles::default()
    };
    let made = scene(layers, roles).unwrap();
    assert_eq!(ids(&made), ["Clamps-left/1"]);
    assert!(made.scene.work_area.is_some());
    let roles: Vec<Role> = made.report.layers.iter().map(|layer| layer.role).collect();
    assert_eq!(roles, [Role::Obstacle, Role::None, Role::WorkArea]);
    assert_eq!(made.report.unmatched_selectors, ["nothing".into()]);
    assert!(!made.report.is_complete());
}

#[test]
fn curves_of_one_layer_are_told_apart_by_id_group_and_colour() {
    let with = |curve: Curve, id: &str, group: &str, red: u8| Curve {
        source: Arc::new(Source {
            id: Some(id.to_owned()),
            groups: vec![group.to_owned()],
            color: Some(Color { red, green: 0, blue: 0 }),
            ..Source::default()
        }),
        ..curve
    };
    let curves = [
        with(square(0.0, 100.0), "bed", "table", 0),
        with(square(10.0, 5.0), "c1", "clamps", 255),
        with(square(20.0, 5.0), "c2", "clamps", 0),
        with(square(30.0, 9.0), "p1", "parts", 0),
        with(square(32.0, 2.0), "p2", "parts", 0),
        with(square(50.0, 5.0), "s1", "nest-1", 0),
        with(square(60.0, 5.0), "s2", "nest-2", 0),
        with(square(70.0, 5.0), "s3", "nest-1", 0),
        with(square(80.0, 5.0), "note", "text", 0),
    ];
    let low = ObstacleRole { top_mm: Some(25.0), clearance_mm: Some(4.0), ..ObstacleRole::new("color:red") };
    let roles = Roles {
        work_area: vec!["id:bed".into()],
        parts: vec!["group:parts".into()],
        sections: vec!["group:nest-*".into()],
        obstacles: vec![low, ObstacleRole::new("group:clamps")],
    };
    let made = scene(&[("0", &curves)], roles).unwrap();
    assert_eq!(made.scene.work_area.as_ref().unwrap().area(), 10_000.0);
    let clearances: Vec<f64> =
        made.scene.obstacles.iter().map(|obstacle| made.scene.clearance_of(obstacle)).collect();
    assert_eq!((ids(&made), clearances), (vec!["0/1", "0/2"], vec![4.0, 1.0]));
    assert_eq!(made.parts.iter().map(|part| part.shape.area()).collect::<Vec<_>>(), [81.0 - 4.0]);
    let sections: Vec<(&str, usize)> =
        made.sections.iter().map(|section| (section.id.as_str(), section.shapes.len())).collect();
    assert_eq!(sections, [("nest-1", 2), ("nest-2", 1)]);
    let tops: Vec<Option<f64>> = made.report.layers.iter().map(|layer| layer.top_mm).collect();
    assert!(tops.contains(&Some(25.0)), "{tops:?}");
    let unused: usize = made
        .report
        .layers
        .iter()
        .filter(|layer| layer.role == Role::None)
        .map(|layer| layer.curve_count)
        .sum();
    assert_eq!(unused, 1);
    assert!(made.report.is_complete(), "{}", made.report);
}

#[test]
fn what_deviates_from_the_drawing_keeps_more_clearance() {
    let fitted = |corner: f64, side: f64| Curve { deviation_mm: 0.25, ..square(corner, side) };
    let layers: &[(&str, &[Curve])] =
        &[("TABLE", &[fitted(0.0, 100.0)]), ("A", &[fitted(10.0, 5.0), square(30.0, 5.0)])];
    let made = scene(layers, Roles::default()).unwrap();
    let clearances: Vec<f64> =
        made.scene.obstacles.iter().map(|obstacle| made.scene.clearance_of(obstacle)).collect();
    assert_eq!((clearances, made.scene.border_clearance()), (vec![1.25, 1.0], 1.25));
    assert_eq!(made.report.widest_deviation_mm, 0.25);
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
fn circles_that_cross_are_siblings_even_where_one_is_drawn_twice() {
    let disc = |x: f64| {
        let ends = [Point::new(x - 5.0, 0.0), Point::new(x + 5.0, 0.0)];
        Curve::new(ends.to_vec(), vec![1.0; 2], true)
    };
    // The middle of one lies in the other.
    let made = scene(&[("A", &[disc(0.0), disc(0.0), disc(4.0)])], Roles::default()).unwrap();
    assert_eq!(ids(&made), ["A/1", "A/2"]);
    let crossing = made.report.findings.iter().filter(|finding| finding.fault == Fault::LoopsCross).count();
    assert_eq!(crossing, 1, "{:?}", made.report.findings);
    assert!(!made.report.findings.iter().any(|finding| matches!(finding.fault, Fault::CrossingLoops { .. })));
    // A disc inside both is a hole of the smaller one around it, and no finding.
    let lens = Curve::new(vec![Point::new(1.5, 0.0), Point::new(2.5, 0.0)], vec![1.0; 2], true);
    let made = scene(&[("A", &[disc(0.0), disc(4.0), lens])], Roles::default()).unwrap();
    assert_eq!(made.scene.obstacles.len(), 2);
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
    assert!(
        made.report
            .findings
            .iter()
            .all(|finding| matches!(finding.fault, Fault::CrossingLoops { .. } | Fault::LoopsCross))
    );
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
