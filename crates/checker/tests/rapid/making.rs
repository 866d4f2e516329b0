//! Scenes and paths in a few words.

use std::f64::consts::PI;
use traverse_checker::{PathCheck, ViolationReason, check_rapid_move};
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, CornerStyle, Obstacle, Path, PathArc, PathStep, Point, Polygon, Ring, Scene,
};

pub(crate) const TOLERANCE: f64 = CONTACT_TOLERANCE_MM;

pub(crate) fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

pub(crate) fn ring(xy: &[(f64, f64)]) -> Ring {
    Ring::new(xy.iter().map(|&(x, y)| p(x, y)).collect(), Vec::new()).expect("the ring is valid")
}

pub(crate) fn bulged(xy: &[(f64, f64)], bulges: &[f64]) -> Ring {
    Ring::new(xy.iter().map(|&(x, y)| p(x, y)).collect(), bulges.to_vec()).expect("the ring is valid")
}

/// Lower left and upper right corner.
pub(crate) fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> Ring {
    ring(&[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
}

/// A circle as two vertices, left and right.
pub(crate) fn disc(x: f64, y: f64, radius: f64) -> Ring {
    bulged(&[(x - radius, y), (x + radius, y)], &[1.0, 1.0])
}

pub(crate) fn polygon(outer: Ring, holes: Vec<Ring>) -> Polygon {
    Polygon::new(outer, holes).expect("the polygon is valid")
}

/// Round corners; obstacles are called a, b, c, …
pub(crate) fn scene(clearance_mm: f64, rings: Vec<Ring>) -> Scene {
    let names = 'a'..='z';
    let obstacles = rings
        .into_iter()
        .zip(names)
        .map(|(ring, name)| Obstacle {
            id: name.to_string(),
            shape: Polygon::from_ring(ring),
            clearance_mm: None,
            top_z_mm: None,
        })
        .collect();
    Scene {
        work_area: None,
        obstacles,
        clearance_mm,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    }
}

pub(crate) fn mitred(scene: Scene, limit: Option<f64>) -> Scene {
    Scene { corner_style: CornerStyle::Miter { limit }, ..scene }
}

pub(crate) fn line(xy: &[(f64, f64)]) -> Path {
    let mut path = Path::at(p(xy[0].0, xy[0].1));
    path.steps.extend(xy[1..].iter().map(|&(x, y)| PathStep { end: p(x, y), arc: None, z_mm: None }));
    path
}

/// Adds an arc about `center` from where the path is to the direction `to`, in degrees.
pub(crate) fn arc(mut path: Path, center: (f64, f64), sweep_degrees: f64) -> Path {
    let center = p(center.0, center.1);
    let sweep = sweep_degrees * PI / 180.0;
    let spoke = path.end() - center;
    let (sin, cos) = sweep.sin_cos();
    let end = center + nalgebra::Vector2::new(cos * spoke.x - sin * spoke.y, sin * spoke.x + cos * spoke.y);
    path.steps.push(PathStep { end, arc: Some(PathArc { center, sweep }), z_mm: None });
    path
}

pub(crate) fn to(mut path: Path, x: f64, y: f64) -> Path {
    path.steps.push(PathStep { end: p(x, y), arc: None, z_mm: None });
    path
}

pub(crate) fn check(scene: &Scene, path: &Path) -> PathCheck {
    check_rapid_move(scene, path.start, path.end(), path, TOLERANCE)
}

#[track_caller]
pub(crate) fn accepts(scene: &Scene, path: &Path) -> PathCheck {
    for (way, path) in [("", path.clone()), ("reversed ", path.reversed())] {
        let check = check(scene, &path);
        assert!(check.is_sound(), "{way}path was refused: {:#?}", check.violations);
    }
    check(scene, path)
}

/// Refused, forwards and backwards, for this reason and no other.
#[track_caller]
pub(crate) fn refuses(scene: &Scene, path: &Path, reason: ViolationReason) -> PathCheck {
    for (way, path) in [("", path.clone()), ("reversed ", path.reversed())] {
        let check = check(scene, &path);
        assert!(
            !check.violations.is_empty(),
            "{way}path was accepted, margin {:?}",
            check.smallest_margin_mm
        );
        let others: Vec<_> = check.violations.iter().filter(|violation| violation.reason != reason).collect();
        assert!(others.is_empty(), "{way}path has other reasons: {others:#?}");
    }
    check(scene, path)
}

#[track_caller]
pub(crate) fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{found} is not {expected}");
}
