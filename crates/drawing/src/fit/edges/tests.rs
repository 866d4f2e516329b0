use super::fitted_edges;
use crate::fit::{CubicBezier, EllipticArc, Smooth};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use traverse_geometry::{Edge, Point, Vector, cross};

const TOLERANCE_MM: f64 = 0.001;

fn bezier(numbers: [f64; 8]) -> CubicBezier {
    let [a, b, c, d, e, f, g, h] = numbers;
    CubicBezier::new(Point::new(a, b), Point::new(c, d), Point::new(e, f), Point::new(g, h))
}

fn ellipse(first: (f64, f64), second: (f64, f64), start: f64, sweep: f64) -> EllipticArc {
    let (first, second) = (Vector::new(first.0, first.1), Vector::new(second.0, second.1));
    EllipticArc { center: Point::new(20.0, -10.0), first, second, start, sweep }
}

fn chain(curve: &impl Smooth, edges: &[(f64, Point)]) -> Vec<Edge> {
    let mut start = curve.point(0.0);
    edges
        .iter()
        .map(|&(bulge, end)| {
            let edge = Edge::from_bulge(start, end, bulge);
            start = end;
            edge
        })
        .collect()
}

/// The largest distance either way, by brute force: 60 places on the curve per edge against every edge, and 24 places on
/// each edge against every chord between the former, less what the chords themselves err.
fn distances(curve: &impl Smooth, edges: &[Edge]) -> (f64, f64) {
    let count = 60 * edges.len();
    let at = |i: usize| i as f64 / count as f64;
    let points: Vec<_> = (0..=count).map(|i| curve.point(at(i))).collect();
    let to_chain = points
        .iter()
        .map(|&p| edges.iter().map(|edge| edge.distance_to_point(p)).fold(f64::INFINITY, f64::min))
        .fold(0.0, f64::max);
    let to_curve = edges
        .iter()
        .flat_map(|edge| (0..=24).map(|i| edge.point_at(f64::from(i) / 24.0)))
        .map(|p| {
            points
                .windows(2)
                .map(|pair| traverse_geometry::Segment::new(pair[0], pair[1]).distance_to_point(p))
                .fold(f64::INFINITY, f64::min)
        })
        .fold(0.0, f64::max);
    let sagitta = points.windows(3).map(|p| (p[0].coords - 2.0 * p[1].coords + p[2].coords).norm() / 8.0);
    (to_chain, to_curve - sagitta.fold(0.0, f64::max))
}

/// Checks a fitted curve and gives its count of edges.
fn check(curve: &impl Smooth, tolerance_mm: f64) -> usize {
    let fitted = fitted_edges(curve, tolerance_mm, 10_000).unwrap();
    let edges = chain(curve, &fitted);
    if let Some(&(_, end)) = fitted.last() {
        assert_eq!(end, curve.point(1.0));
    }
    assert!(fitted.iter().all(|&(bulge, _)| bulge.abs() <= 1.0));
    if !edges.is_empty() {
        let (to_chain, to_curve) = distances(curve, &edges);
        assert!(to_chain <= tolerance_mm, "{to_chain} of the curve");
        assert!(to_curve <= tolerance_mm, "{to_curve} of the chain");
    }
    edges.len()
}

fn largest_corner(edges: &[Edge]) -> f64 {
    edges
        .windows(2)
        .map(|pair| {
            let (before, after) = (pair[0].direction_at(1.0), pair[1].direction_at(0.0));
            cross(before, after).atan2(before.dot(&after)).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn straight_pieces_are_one_segment() {
    for numbers in [
        [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0],
        [0.0, 0.0, 0.0, 0.0, 30.0, 10.0, 30.0, 10.0],
        [5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 90.0, -400.0],
        [1e5, 1e5, 1.001e5, 1.001e5, 1.002e5, 1.002e5, 1.01e5, 1.01e5],
    ] {
        let curve = bezier(numbers);
        assert_eq!(fitted_edges(&curve, TOLERANCE_MM, 1).unwrap(), [(0.0, curve.point(1.0))]);
    }
}

#[test]
fn arcs_of_circles_stay_single_arcs() {
    for sweep in [0.01, 0.7, PI / 2.0, 3.0, -0.7, -3.0] {
        let curve = ellipse((50.0, 0.0), (0.0, 50.0), 0.4, sweep);
        let fitted = fitted_edges(&curve, TOLERANCE_MM, 1).unwrap();
        assert!((fitted[0].0 - (sweep / 4.0_f64).tan()).abs() < 1e-9, "{sweep}");
    }
    assert!(check(&ellipse((50.0, 0.0), (0.0, 50.0), 0.0, TAU), TOLERANCE_MM) <= 4);
}

#[test]
fn curves_are_followed_both_ways() {
    for (numbers, most) in [
        ([0.0, 0.0, 30.0, 60.0, 70.0, 60.0, 100.0, 0.0], 40),
        ([0.0, 0.0, 100.0, 80.0, 0.0, 80.0, 100.0, 0.0], 70),
        ([0.0, 0.0, 60.0, 100.0, 40.0, -100.0, 100.0, 0.0], 80),
        // A loop, a cusp, one end control point on its end, a closed drop.
        ([0.0, 0.0, 150.0, 100.0, -50.0, 100.0, 100.0, 0.0], 80),
        ([0.0, 0.0, 100.0, 100.0, 0.0, 100.0, 100.0, 0.0], 80),
        ([0.0, 0.0, 0.0, 0.0, 50.0, 80.0, 100.0, 0.0], 50),
        ([0.0, 0.0, 100.0, 50.0, -100.0, 50.0, 0.0, 0.0], 90),
        // To and fro on a line.
        ([0.0, 0.0, 200.0, 0.0, -100.0, 0.0, 100.0, 0.0], 200),
        // The same, turning just before a place where it is parted.
        ([10.0, 20.0, 30.0, 20.0, 0.0, 20.0, 10.0, 20.0], 200),
    ] {
        let count = check(&bezier(numbers), TOLERANCE_MM);
        assert!(count <= most, "{count} edges for {numbers:?}");
    }
    for (first, second) in [
        ((50.0, 0.0), (0.0, 30.0)),
        ((500.0, 0.0), (0.0, 1.0)),
        ((40.0, 30.0), (-3.0, 4.0)),
        ((40.0, 0.0), (30.0, 20.0)),
    ] {
        check(&ellipse(first, second, 0.3, TAU), TOLERANCE_MM);
        check(&ellipse(first, second, 2.0, -4.0), 0.05);
    }
    // An ellipse without width: out and back.
    check(&ellipse((50.0, 0.0), (0.0, 0.0), 0.3, TAU), TOLERANCE_MM);
}

#[test]
fn edges_grow_with_the_cube_root_of_the_tolerance() {
    let curve = bezier([0.0, 0.0, 300.0, 600.0, 700.0, 650.0, 1000.0, 0.0]);
    let count = |tolerance| fitted_edges(&curve, tolerance, 10_000).unwrap().len() as f64;
    let counts = [1e-1, 1e-3, 1e-5].map(count);
    for pair in counts.windows(2) {
        // 100 to the power of 1/3 is 4.6; halving rounds up to a factor of 2.
        assert!(pair[1] / pair[0] < 7.0, "{counts:?}");
    }
}

#[test]
fn arcs_meet_without_corners() {
    for curve in [
        bezier([0.0, 0.0, 30.0, 60.0, 70.0, 60.0, 100.0, 0.0]),
        bezier([0.0, 0.0, 0.0, 0.0, 50.0, 80.0, 100.0, 0.0]),
        bezier([0.0, 0.0, 100.0, 50.0, -100.0, 50.0, 0.0, 0.0]),
    ] {
        let fitted = fitted_edges(&curve, TOLERANCE_MM, 1000).unwrap();
        assert!(
            largest_corner(&chain(&curve, &fitted)) < 1e-3,
            "{}",
            largest_corner(&chain(&curve, &fitted))
        );
    }
}

#[test]
fn limits_and_bad_numbers_are_refused() {
    let curve = bezier([0.0, 0.0, 30.0, 60.0, 70.0, 60.0, 100.0, 0.0]);
    let needed = fitted_edges(&curve, TOLERANCE_MM, 1000).unwrap().len();
    assert!(fitted_edges(&curve, TOLERANCE_MM, needed).is_some());
    assert_eq!(fitted_edges(&curve, TOLERANCE_MM, needed - 1), None);
    assert_eq!(fitted_edges(&curve, TOLERANCE_MM, 0), None);
    for tolerance in [0.0, -1.0, f64::NAN, 1e-300] {
        assert_eq!(fitted_edges(&curve, tolerance, 10_000), None);
    }
    for bad in [f64::NAN, f64::INFINITY, 1e308] {
        for place in 0..8 {
            let mut numbers = [0.0, 0.0, 30.0, 60.0, 70.0, 60.0, 100.0, 0.0];
            numbers[place] = bad;
            assert_eq!(fitted_edges(&bezier(numbers), TOLERANCE_MM, 1000), None, "{bad} at {place}");
        }
    }
    let point = bezier([3.0, 4.0, 3.0, 4.0, 3.0, 4.0, 3.0, 4.0]);
    assert_eq!(fitted_edges(&point, TOLERANCE_MM, 1), Some(Vec::new()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn any_bezier_is_followed(numbers in prop::array::uniform8(-50.0..50.0), exponent in -3.0..0.0) {
        check(&bezier(numbers), 10.0_f64.powf(exponent));
    }

    #[test]
    fn few_valued_beziers_are_followed(numbers in prop::array::uniform8(0..4)) {
        check(&bezier(numbers.map(|n| 10.0 * f64::from(n))), 0.01);
    }

    #[test]
    fn any_elliptic_arc_is_followed(
        (a, b, c, d) in (-30.0..30.0, -30.0..30.0, -30.0..30.0, -30.0..30.0),
        (start, sweep) in (-10.0..10.0, -TAU..TAU),
    ) {
        check(&ellipse((a, b), (c, d), start, sweep), 0.01);
    }

    /// A piece that follows just barely may be parted, into up to eight edges instead of two, in one sense and not in the
    /// other.
    #[test]
    fn backwards_it_takes_about_as_many_edges(numbers in prop::array::uniform8(-50.0..50.0)) {
        let curve = bezier(numbers);
        let [a, b, c, d] = curve.points;
        let forward = fitted_edges(&curve, 0.01, 1000).unwrap();
        let backward = fitted_edges(&CubicBezier::new(d, c, b, a), 0.01, 1000).unwrap();
        prop_assert!(forward.len().abs_diff(backward.len()) <= 12, "{} and {}", forward.len(), backward.len());
    }
}
