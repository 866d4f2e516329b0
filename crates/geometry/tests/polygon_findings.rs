//! Every way in which holes can be wrong, and the ways in which they may touch.

use traverse_geometry::{Finding, Polygon, Reason, Ring};

fn ring(xy_mm: &[f64]) -> Ring {
    Ring::from_xy(xy_mm, &[]).expect("the ring is valid")
}

fn square(x: f64, y: f64, side: f64) -> Ring {
    ring(&[x, y, x + side, y, x + side, y + side, x, y + side])
}

fn circle(x: f64, y: f64, radius: f64) -> Ring {
    Ring::from_xy(&[x - radius, y, x + radius, y], &[1.0, 1.0]).expect("the ring is valid")
}

#[track_caller]
fn check(outer: Ring, holes: Vec<Ring>, expected: &[(&str, Reason)]) -> Vec<Finding> {
    let found = Polygon::new(outer.clone(), holes.clone()).err().unwrap_or_default();
    let short: Vec<_> = found.iter().map(|finding| (finding.field.as_str(), finding.reason)).collect();
    assert_eq!(short, expected, "{found:?}");
    // Orientation and first vertex make no difference.
    let turned =
        Polygon::new(outer.reversed(), holes.iter().map(Ring::reversed).collect()).err().unwrap_or_default();
    assert_eq!(
        turned.iter().map(|finding| finding.reason).collect::<Vec<_>>(),
        short.iter().map(|f| f.1).collect::<Vec<_>>()
    );
    found
}

#[test]
fn good_holes() {
    check(square(0.0, 0.0, 10.0), vec![], &[]);
    check(square(0.0, 0.0, 10.0), vec![square(1.0, 1.0, 3.0), circle(7.0, 7.0, 2.0)], &[]);
}

#[test]
fn touching_holes() {
    // A corner on the border, a whole side on it, two holes side by side, corner to corner, circle to side.
    check(square(0.0, 0.0, 10.0), vec![ring(&[0.0, 5.0, 3.0, 4.0, 3.0, 6.0])], &[]);
    check(
        square(0.0, 0.0, 10.0),
        vec![square(0.0, 0.0, 3.0), square(3.0, 0.0, 3.0), square(6.0, 3.0, 3.0)],
        &[],
    );
    check(
        square(0.0, 0.0, 10.0),
        vec![circle(2.0, 5.0, 2.0), circle(5.0, 5.0, 1.0), circle(8.0, 5.0, 2.0)],
        &[],
    );
    check(circle(0.0, 0.0, 10.0), vec![circle(5.0, 0.0, 5.0), circle(-5.0, 0.0, 5.0)], &[]);
    // Every vertex on the border.
    check(square(0.0, 0.0, 10.0), vec![ring(&[5.0, 0.0, 10.0, 5.0, 5.0, 10.0, 0.0, 5.0])], &[]);
}

#[test]
fn holes_outside() {
    let outer = square(0.0, 0.0, 10.0);
    let found = check(
        outer.clone(),
        vec![square(1.0, 1.0, 2.0), square(20.0, 1.0, 2.0), square(10.0, 1.0, 2.0), circle(12.0, 5.0, 2.0)],
        &[
            ("holes[1]", Reason::HoleOutside),
            ("holes[2]", Reason::HoleOutside),
            ("holes[3]", Reason::HoleOutside),
        ],
    );
    assert!(found[0].message.contains("(20.0, 1.0)"), "{}", found[0].message);
    // A hole round the outer ring, and one that fills a notch from outside.
    check(outer, vec![square(-5.0, -5.0, 30.0)], &[("holes[0]", Reason::HoleOutside)]);
    let notched =
        ring(&[0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 6.0, 10.0, 6.0, 5.0, 4.0, 5.0, 4.0, 10.0, 0.0, 10.0]);
    let plug = ring(&[4.0, 5.0, 6.0, 5.0, 6.0, 10.0, 4.0, 10.0]);
    check(notched, vec![plug], &[("holes[0]", Reason::HoleOutside)]);
}

#[test]
fn a_hull_round_a_star_is_outside() {
    let star = ring(&[0.0, 0.0, 5.0, 2.0, 10.0, 0.0, 8.0, 5.0, 10.0, 10.0, 5.0, 8.0, 0.0, 10.0, 2.0, 5.0]);
    check(star, vec![square(0.0, 0.0, 10.0)], &[("holes[0]", Reason::HoleOutside)]);
}

#[test]
fn holes_in_holes() {
    let outer = square(0.0, 0.0, 20.0);
    check(
        outer.clone(),
        vec![square(2.0, 2.0, 3.0), square(1.0, 1.0, 9.0), circle(13.0, 13.0, 1.0), circle(13.0, 13.0, 3.0)],
        &[("holes[0]", Reason::HoleInHole), ("holes[2]", Reason::HoleInHole)],
    );
    let twin = square(2.0, 2.0, 3.0);
    check(outer.clone(), vec![twin.clone(), twin], &[("holes[0]", Reason::HoleInHole)]);
    let round = circle(9.0, 9.0, 3.0);
    check(outer, vec![round.clone(), round], &[("holes[0]", Reason::HoleInHole)]);
}

#[test]
fn crossings_name_both_edges() {
    let found = check(
        square(0.0, 0.0, 10.0),
        vec![square(8.0, 1.0, 4.0), square(1.0, 1.0, 3.0), square(2.0, 2.0, 3.0)],
        &[
            ("holes[0]", Reason::EdgesCross),
            ("holes[0]", Reason::EdgesCross),
            ("holes[2]", Reason::EdgesCross),
            ("holes[2]", Reason::EdgesCross),
        ],
    );
    assert!(found[0].message.starts_with("edge 0 of holes[0] crosses edge 1 of the outer ring near (10.0"));
    assert_eq!(found[2].value, "edge 0 and edge 1 of holes[1]");
    // Through the border exactly at a vertex.
    let through = ring(&[10.0, 5.0, 12.0, 4.0, 12.0, 6.0, 10.0, 5.0, 8.0, 6.0, 8.0, 4.0]);
    assert_eq!(
        Polygon::new(square(0.0, 0.0, 10.0), vec![through]).unwrap_err()[0].reason,
        Reason::EdgesCross
    );
    let found = Polygon::new(circle(0.0, 0.0, 5.0), vec![circle(4.0, 0.0, 3.0)]).unwrap_err();
    assert_eq!(found.len(), 2, "{found:?}");
}

#[test]
fn nothing_left() {
    check(square(0.0, 0.0, 10.0), vec![square(0.0, 0.0, 10.0)], &[("holes", Reason::NoArea)]);
    let halves = vec![ring(&[0.0, 0.0, 10.0, 0.0, 10.0, 10.0]), ring(&[0.0, 0.0, 10.0, 10.0, 0.0, 10.0])];
    check(square(0.0, 0.0, 10.0), halves, &[("holes", Reason::NoArea)]);
    check(circle(0.0, 0.0, 4.0), vec![circle(0.0, 0.0, 4.0)], &[("holes", Reason::NoArea)]);
}

#[test]
fn a_sheet_of_holes() {
    let holes: Vec<_> = (0..10_000).map(|i| circle(f64::from(i % 100), f64::from(i / 100), 0.5)).collect();
    let sheet = Polygon::new(square(-0.5, -0.5, 100.0), holes).unwrap();
    assert!((sheet.area() - 10_000.0 * (1.0 - std::f64::consts::PI / 4.0)).abs() < 1e-6);
}
