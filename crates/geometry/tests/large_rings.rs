//! Rings of the size that the limits permit, and rings made to take long.

use std::f64::consts::TAU;
use traverse_geometry::{FINDINGS_LIMIT, Finding, Point, Reason, Ring};

fn ring(points: impl IntoIterator<Item = (f64, f64)>) -> Result<Ring, Vec<Finding>> {
    Ring::new(points.into_iter().map(|(x, y)| Point::new(x, y)).collect(), Vec::new())
}

/// A comb of `teeth` teeth, turned by `angle`.
fn comb(teeth: u32, angle: f64) -> Result<Ring, Vec<Finding>> {
    let (sin, cos) = angle.sin_cos();
    let backbone = [(-10.0, 2.0 * f64::from(teeth)), (-10.0, 0.0)];
    let tooth = |i: u32| {
        let y = f64::from(2 * i);
        [(0.0, y), (5000.0, y), (5000.0, y + 1.0), (0.0, y + 1.0)]
    };
    let points = (0..teeth).flat_map(tooth).chain(backbone);
    ring(points.map(|(x, y)| (x * cos - y * sin, x * sin + y * cos)))
}

#[test]
fn a_circle_of_a_million_vertices() {
    let n = 1_000_000;
    let circle = ring((0..n).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
        (20_000.0 + 1e4 * cos, 1e4 * sin)
    }));
    assert!(!circle.unwrap().touches_itself());
}

#[test]
fn combs_at_any_angle() {
    for angle in [0.0, 0.3, TAU / 8.0, 1.5] {
        assert!(!comb(50_000, angle).unwrap().touches_itself());
    }
}

#[test]
fn a_spiral_of_two_hundred_turns() {
    let at = |i: u32, offset: f64| {
        let angle = TAU * f64::from(i) / 500.0;
        let radius = 10.0 + angle + offset;
        (radius * angle.cos(), radius * angle.sin())
    };
    let spiral = ring((0..100_000).map(|i| at(i, 0.0)).chain((0..100_000).rev().map(|i| at(i, 3.0))));
    assert!(!spiral.unwrap().touches_itself());
}

#[test]
fn a_hundred_thousand_edges_that_all_cross() {
    let n = 100_001;
    let star = ring((0..n).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) * 0.5 * f64::from(n - 1) / f64::from(n)).sin_cos();
        (100.0 * cos, 100.0 * sin)
    }));
    let findings = star.unwrap_err();
    assert_eq!(findings.len(), FINDINGS_LIMIT + 1);
    assert!(findings.iter().all(|finding| finding.reason == Reason::EdgesCross));
}

#[test]
fn edges_packed_over_each_other_end_in_a_finding() {
    // Antennas by the ten thousand from one corner along one line: no crossing, but every pair touches.
    let points = (0..60_000u32).flat_map(|i| [(0.0, 0.0), (1.0 + f64::from(i), 0.0)]);
    let findings = ring(points.chain([(0.0, 0.0), (1.0, 1.0), (0.0, 1.0)])).unwrap_err();
    assert_eq!(findings.len(), 1, "{findings:?}");
    assert_eq!((findings[0].field.as_str(), findings[0].reason), ("xy_mm", Reason::TooMany));
}
