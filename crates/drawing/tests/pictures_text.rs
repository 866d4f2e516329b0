//! Text in pictures covers neither a path nor other text.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod pictures_svg;
mod random;

use pictures_svg::assert_text_is_free;
use proptest::prelude::*;
use random::Random;
use traverse_drawing::{
    ReadOptions, SceneOptions, Shown, picture_of_plan, read_dxf_from, scene_from_drawing,
};
use traverse_geometry::{CornerStyle, Obstacle, Path, Point, Polygon, Ring, Scene};

/// What text must not cover.
const PATHS: [&str; 3] = ["rapid", "before", "wish"];

fn bundled(name: &str, clearance_mm: f64) -> Scene {
    let path = format!("{}/../../drawings/{name}", env!("CARGO_MANIFEST_DIR"));
    let drawing = read_dxf_from(std::fs::File::open(path).unwrap(), &ReadOptions::default()).unwrap();
    scene_from_drawing(&drawing, &SceneOptions::new(clearance_mm)).unwrap().scene
}

/// A path through these points; every third step is half a turn.
fn path(points: &[(f64, f64)], scale: f64, offset: f64) -> Path {
    let at = |&(x, y): &(f64, f64)| Point::new(offset + x * scale, offset + y * scale);
    let mut path = Path::at(points.first().map_or(Point::origin(), at));
    for (i, p) in points.iter().enumerate().skip(1) {
        let (from, to) = (path.end(), at(p));
        if i % 3 == 0 && from != to {
            path.arc_to(to, from + (to - from) / 2.0, std::f64::consts::PI);
        } else {
            path.line_to(to);
        }
    }
    path
}

fn scene(boxes: &[(f64, f64, f64, f64)], id: &str, scale: f64, offset: f64) -> Scene {
    let obstacle = |(i, &(x, y, w, h)): (usize, &(f64, f64, f64, f64))| {
        let (left, right) = (offset + x * scale, offset + (x + w) * scale);
        let (bottom, top) = (offset + y * scale, offset + (y + h) * scale);
        let vertices = [(left, bottom), (right, bottom), (right, top), (left, top)];
        let vertices = vertices.map(|(x, y)| Point::new(x, y)).to_vec();
        let shape = Polygon::from_ring(Ring::new(vertices, vec![]).unwrap());
        Obstacle { id: format!("{id}/{i}"), shape, clearance_mm: None, top_z_mm: None }
    };
    Scene {
        work_area: None,
        obstacles: boxes.iter().enumerate().map(obstacle).collect(),
        clearance_mm: 0.01 * scale,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    }
}

fn check_all(scene: &Scene, path: &Path, was: &Path, title: &str) {
    let (is, was) = (std::slice::from_ref(path), std::slice::from_ref(was));
    let both = [path.clone(), was[0].clone()];
    let parts: Vec<String> = scene.obstacles.iter().map(|each| each.id.clone()).collect();
    for (what, shown) in [
        ("scene", Shown::Scene),
        ("path", Shown::Path(path)),
        ("paths", Shown::Paths(&both)),
        ("change", Shown::Change { before: was, after: is }),
        ("no path", Shown::NoPath { start: path.start, target: path.end(), separating: &parts }),
    ] {
        assert_text_is_free(&picture_of_plan(scene, shown, title), &PATHS, what);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn text_covers_nothing_in_random_scenes(
        boxes in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.02..0.3, 0.02..0.3), 0..40),
        points in prop::collection::vec((0.0..1.0, 0.0..1.0), 1..9),
        old in prop::collection::vec((0.0..1.0, 0.0..1.0), 1..4),
        id in "[A-Z_]{1,14}",
        power in -2..5,
        offset in prop::sample::select(vec![0.0, -300.0, 20_000.0]),
    ) {
        let scale = 10_f64.powi(power);
        let scene = scene(&boxes, &id, scale, offset);
        check_all(&scene, &path(&points, scale, offset), &path(&old, scale, offset), &id.repeat(9));
    }
}

#[test]
fn text_covers_nothing_in_the_bundled_drawings() {
    for name in ["vise-and-clamps.dxf", "leather-hide.dxf", "turned-shaft.dxf"] {
        let scene = bundled(name, 5.0);
        let extent =
            scene.work_area.as_ref().map_or_else(|| scene.obstacles[0].shape.bounds(), Polygon::bounds);
        for seed in 0..12 {
            let mut random = Random::new(seed);
            let mut points = |count: usize| -> Vec<(f64, f64)> {
                let mut place = || {
                    let (x, y) = (random.share() * extent.size().x, random.share() * extent.size().y);
                    (extent.min.x + x, extent.min.y + y)
                };
                (0..count).map(|_| place()).collect()
            };
            let (is, was) = (path(&points(4), 1.0, 0.0), path(&points(2), 1.0, 0.0));
            check_all(&scene, &is, &was, name);
        }
    }
}

#[test]
fn text_covers_nothing_in_extreme_scenes() {
    let many: Vec<(f64, f64, f64, f64)> = (0..5000_u32)
        .map(|i| (f64::from(i % 100) / 100.0, f64::from(i / 100) / 50.0, 0.006, 0.012))
        .collect();
    let flat = [(0.2, 0.0, 0.3, 0.001), (0.7, 0.0, 0.01, 0.0005)];
    let across = [(0.0, 0.0), (0.4, 0.001), (1.0, 0.0)];
    let tall = [(0.0, 0.2, 0.001, 0.3), (0.0, 0.7, 0.0005, 0.01)];
    let up = [(0.0, 0.0), (0.001, 0.4), (0.0, 1.0)];
    for (boxes, points, scale, offset) in [
        (&flat[..], across, 10_000.0, 0.0),
        (&tall[..], up, 10_000.0, 0.0),
        (&many[..], across, 2_000.0, 20_000.0),
        (&[], up, 1.0, -20_000.0),
        (&[], across, 0.0, 5.0),
    ] {
        let scene = scene(boxes, "A_LONG_LAYER_NAME", scale, offset);
        let (is, was) = (path(&points, scale, offset), path(&[points[0], points[2]], scale, offset));
        check_all(&scene, &is, &was, "extreme");
        let size = picture_of_plan(&scene, Shown::Path(&is), "").len();
        assert!(size < 10_000 + 600 * boxes.len(), "{size} bytes for {} obstacles", boxes.len());
    }
}

#[test]
fn a_change_says_what_it_saves() {
    let scene = bundled("turned-shaft.dxf", 4.0);
    let (was, is) = (
        path(&[(0.0, 0.0), (0.0, 100.0), (100.0, 100.0)], 1.0, 0.0),
        path(&[(0.0, 0.0), (100.0, 50.0)], 1.0, 0.0),
    );
    let shown = |before, after| {
        picture_of_plan(
            &scene,
            Shown::Change { before: std::slice::from_ref(before), after: std::slice::from_ref(after) },
            "",
        )
    };
    assert!(shown(&was, &is).contains("rapid move 111.803 mm, before 200 mm: 44.1 % shorter"));
    assert!(shown(&is, &was).contains("78.9 % longer"));
    assert!(shown(&is, &is).contains("as long"));
    let nothing = Path::at(Point::origin());
    assert!(shown(&nothing, &nothing).contains("as long"));
}
