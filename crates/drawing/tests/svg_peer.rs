//! Files of several programs' kinds against usvg: same elements, same lengths, same extents.
//!
//! usvg computes in single precision and makes circles Bézier curves: it errs by 0.03 % of the radius.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::sync::Arc;
use traverse_drawing::{Drawing, ReadOptions, read_svg};
use traverse_geometry::{Bounds, Point};
use usvg::tiny_skia_path::{PathSegment, Point as SkiaPoint};

const FILES: [&str; 4] = ["inkscape-layers", "illustrator-classes", "laser-job", "pixels"];

/// What an element draws: length and extent, millimetres.
#[derive(Clone, Debug)]
struct Drawn {
    length: f64,
    bounds: Bounds,
}

fn ours(drawing: &Drawing) -> Vec<Drawn> {
    let mut elements: BTreeMap<usize, Drawn> = BTreeMap::new();
    for curve in drawing.layers.iter().flat_map(|layer| &layer.curves) {
        let key = Arc::as_ptr(&curve.source) as usize;
        let bounds: Vec<_> = curve.edges().map(|edge| edge.bounds()).collect();
        let bounds = Bounds::of(bounds.iter().flat_map(|b| [b.min, b.max]));
        let drawn = elements.entry(key).or_insert(Drawn { length: 0.0, bounds });
        drawn.length += curve.length();
        drawn.bounds = drawn.bounds.with(bounds.min).with(bounds.max);
    }
    elements.into_values().collect()
}

fn peer_paths(group: &usvg::Group, page_height: f64, found: &mut Vec<Drawn>) {
    for node in group.children() {
        match node {
            usvg::Node::Group(group) => peer_paths(group, page_height, found),
            usvg::Node::Path(path) if path.is_visible() => {
                let map = path.abs_transform();
                let place = |p: SkiaPoint| {
                    let (x, y) = (f64::from(p.x), f64::from(p.y));
                    let x_px = f64::from(map.sx) * x + f64::from(map.kx) * y + f64::from(map.tx);
                    let y_px = f64::from(map.ky) * x + f64::from(map.sy) * y + f64::from(map.ty);
                    Point::new(x_px * 25.4 / 96.0, (page_height - y_px) * 25.4 / 96.0)
                };
                found.extend(measured(path.data(), place));
            }
            _ => {}
        }
    }
}

fn measured(path: &usvg::tiny_skia_path::Path, place: impl Fn(SkiaPoint) -> Point) -> Option<Drawn> {
    let (mut points, mut length) = (Vec::new(), 0.0);
    let (mut at, mut start) = (Point::origin(), Point::origin());
    for segment in path.segments() {
        let controls = match segment {
            PathSegment::MoveTo(p) => {
                at = place(p);
                start = at;
                continue;
            }
            PathSegment::LineTo(p) => vec![at, place(p)],
            PathSegment::QuadTo(p, q) => vec![at, place(p), place(q)],
            PathSegment::CubicTo(p, q, r) => vec![at, place(p), place(q), place(r)],
            PathSegment::Close => vec![at, start],
        };
        for i in 0..=200 {
            let t = f64::from(i) / 200.0;
            let mut row = controls.clone();
            while row.len() > 1 {
                row = row.windows(2).map(|pair| pair[0] + (pair[1] - pair[0]) * t).collect();
            }
            // What has no length is no curve here.
            if row[0] != at {
                points.extend([at, row[0]]);
            }
            length += (row[0] - at).norm();
            at = row[0];
        }
    }
    (length > 0.0).then(|| Drawn { length, bounds: Bounds::of(points) })
}

fn agree(a: &Drawn, b: &Drawn) -> bool {
    let allowed = 0.002 + 3.5e-4 * a.bounds.size().norm();
    (a.length - b.length).abs() < allowed + 3.5e-4 * a.length
        && (a.bounds.min - b.bounds.min).norm() < allowed
        && (a.bounds.max - b.bounds.max).norm() < allowed
}

fn check(name: &str, bytes: &[u8]) -> usize {
    let drawing = read_svg(bytes, &ReadOptions::default()).unwrap();
    let tree = usvg::Tree::from_data(bytes, &usvg::Options::default()).unwrap();
    let mut theirs = Vec::new();
    peer_paths(tree.root(), f64::from(tree.size().height()), &mut theirs);
    let ours = ours(&drawing);
    let count = ours.len();
    for drawn in ours {
        let Some(at) = theirs.iter().position(|their| agree(&drawn, their)) else {
            panic!("{name}: only ours: {drawn:?} of {theirs:#?}");
        };
        theirs.swap_remove(at);
    }
    assert!(theirs.is_empty(), "{name}: only theirs: {theirs:?}");
    count
}

#[test]
fn every_element_has_its_length_and_extent() {
    for (name, expected) in FILES.into_iter().zip([8, 7, 12, 5]) {
        let path = format!("{}/tests/svg/{name}.svg", env!("CARGO_MANIFEST_DIR"));
        assert_eq!(check(name, &std::fs::read(path).unwrap()), expected, "{name}");
    }
}
