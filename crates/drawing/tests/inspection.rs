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

fn findings_of(curves: Vec<Curve>) -> Vec<(Fault, Point)> {
    let seen = inspect_drawing(&drawing(&[("0", curves)]), &Roles::default(), JOIN_TOLERANCE_MM);
    seen.findings.into_iter().map(|finding| (finding.fault, finding.place)).collect()
}

#[test]
fn loops_side_by_side_that_cross_are_found_where_they_cross() {
    let at = |x: f64, y: f64, w: f64, h: f64| {
        let points = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)];
        Curve::new(points.map(|(x, y)| Point::new(x, y)).to_vec(), vec![0.0; 4], true)
    };
    let found =
        findings_of(vec![at(0.0, 0.0, 10.0, 10.0), at(8.0, 8.0, 10.0, 10.0), at(40.0, 0.0, 5.0, 5.0)]);
    let [(Fault::LoopsCross, place)] = found[..] else { panic!("{found:?}") };
    assert!(place == Point::new(10.0, 8.0) || place == Point::new(8.0, 10.0), "{place}");
    // A cross: no middle of one lies outside the other.
    let cross = vec![at(0.0, 40.0, 100.0, 20.0), at(40.0, 0.0, 20.0, 100.0)];
    assert_eq!(findings_of(cross).len(), 1);
    // Touching in a corner is no crossing; nor is lying inside.
    assert_eq!(findings_of(vec![at(0.0, 0.0, 5.0, 5.0), at(5.0, 5.0, 5.0, 5.0)]), []);
    assert_eq!(findings_of(vec![at(0.0, 0.0, 50.0, 50.0), at(5.0, 5.0, 5.0, 5.0)]), []);
}

#[test]
fn curves_that_run_along_one_another_are_found() {
    let half = |from: f64, to: f64| {
        Curve::new(vec![Point::new(from, 0.0), Point::new(to, 0.0)], vec![1.0, 0.0], false)
    };
    for (curves, length, place) in [
        (vec![line((0.0, 0.0), (10.0, 0.0)), line((12.0, 0.001), (4.0, 0.001))], 6.0, Point::new(7.0, 0.0)),
        (vec![square(0.0, 10.0), line((10.0, 2.0), (10.0, 9.0))], 7.0, Point::new(10.0, 5.5)),
        // The lower half of a circle, and a quarter of it in the second half of that.
        (
            vec![
                half(-10.0, 10.0),
                Curve::new(
                    vec![Point::new(0.0, -10.0), Point::new(10.0, 0.0)],
                    vec![(std::f64::consts::PI / 8.0).tan(), 0.0],
                    false,
                ),
            ],
            std::f64::consts::PI * 5.0,
            Point::new(50.0_f64.sqrt(), -50.0_f64.sqrt()),
        ),
    ] {
        let found = findings_of(curves);
        let overlap = found.iter().find_map(|(fault, at)| match fault {
            Fault::Overlap { length_mm } => Some((*length_mm, *at)),
            _ => None,
        });
        let (found_length, at) = overlap.unwrap_or_else(|| panic!("{found:?}"));
        assert!((found_length - length).abs() < 1e-9 && (at - place).norm() < 1e-2, "{found_length} {at}");
    }
    for apart in [
        vec![line((0.0, 0.0), (10.0, 0.0)), line((10.0, 0.0), (20.0, 0.0))],
        vec![line((0.0, 0.0), (10.0, 0.0)), line((0.0, 0.1), (10.0, 0.1))],
        vec![line((0.0, 0.0), (10.0, 0.0)), line((0.0, 0.0), (10.0, 1.0))],
        vec![half(-10.0, 10.0), half(10.0, -10.0)],
    ] {
        let found = findings_of(apart);
        assert!(!found.iter().any(|(fault, _)| matches!(fault, Fault::Overlap { .. })), "{found:?}");
    }
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
