//! What is in a drawing.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

use traverse_drawing::{
    Curve, Drawing, Fault, JOIN_TOLERANCE_MM, Layer, LengthUnit, Role, Roles, inspect_drawing,
};
use traverse_geometry::Point;

fn square(corner: f64, side: f64) -> Curve {
    let far = corner + side;
    let points = [(corner, corner), (far, corner), (far, far), (corner, far)];
    Curve::new(points.map(|(x, y)| Point::new(x, y)).to_vec(), vec![0.0; 4], true)
}

fn line(from: (f64, f64), to: (f64, f64)) -> Curve {
    Curve::new(vec![Point::new(from.0, from.1), Point::new(to.0, to.1)], vec![0.0; 2], false)
}

fn drawing(layers: &[(&str, Vec<Curve>)]) -> Drawing {
    let layer =
        |(name, curves): &(&str, Vec<Curve>)| Layer { name: (*name).to_owned(), curves: curves.clone() };
    Drawing {
        unit: LengthUnit::MILLIMETRES,
        unit_assumed: true,
        layers: layers.iter().map(layer).collect(),
        unused: Vec::new(),
        mapping: None,
    }
}

#[test]
fn layers_are_counted_whether_chosen_or_not() {
    let nested = vec![square(0.0, 100.0), square(10.0, 80.0), square(20.0, 5.0), square(200.0, 10.0)];
    let drawing = drawing(&[("A", nested), ("NOTES", vec![square(0.0, 2.0)])]);
    let roles = Roles { obstacles: vec![traverse_drawing::ObstacleRole::new("A")], ..Roles::default() };
    let seen = inspect_drawing(&drawing, &roles, JOIN_TOLERANCE_MM);
    let [a, notes] = &seen.layers[..] else { panic!("{seen}") };
    assert_eq!(
        (a.role, a.outer_loop_count, a.inner_loop_count, a.deepest_nesting),
        (Role::Obstacle, 2, 2, 3)
    );
    assert_eq!(a.area_mm2, 10_000.0 - 6400.0 + 25.0 + 100.0);
    assert_eq!(a.length_mm, 400.0 + 320.0 + 20.0 + 40.0);
    assert_eq!((notes.role, notes.outer_loop_count), (Role::None, 1));
    assert_eq!((seen.bounds.min, seen.bounds.max), (Point::new(0.0, 0.0), Point::new(210.0, 210.0)));
    assert!(seen.to_string().contains("nothing is wrong") && seen.to_string().contains("assumed"));
}

#[test]
fn what_is_wrong_is_listed_with_its_place() {
    let open = vec![
        line((0.0, 0.0), (10.0, 0.0)),
        line((10.0, 0.0), (10.0, 5.0)),
        square(50.0, 5.0),
        square(50.0, 5.0),
    ];
    let seen = inspect_drawing(&drawing(&[("0", open)]), &Roles::default(), JOIN_TOLERANCE_MM);
    assert!(seen.findings.iter().any(|finding| matches!(finding.fault, Fault::OpenChain { .. })), "{seen}");
    assert!(seen.findings.iter().any(|finding| finding.fault == Fault::Duplicate), "{seen}");
    assert!(seen.to_string().contains("  1. layer 0 at "), "{seen}");
    let nothing = inspect_drawing(&drawing(&[]), &Roles::default(), JOIN_TOLERANCE_MM);
    assert!(nothing.bounds.is_empty() && nothing.layers.is_empty());
}
