//! Rings and paths as SVG path data.

use super::frame::Frame;
use std::f64::consts::PI;
use std::fmt::Write;
use traverse_geometry::{Edge, Path, Polygon};

/// Arcs whose middle is nearer than this to their chord are drawn straight, canvas units.
const FLAT: f64 = 0.01;

/// A polygon: outer ring and holes, for the even-odd rule.
pub(super) fn polygon_data(polygon: &Polygon, frame: &Frame) -> String {
    let mut data = String::new();
    for ring in polygon.rings() {
        if let Some(first) = ring.vertices().first() {
            let (x, y) = frame.place(*first);
            let _ = write!(data, "M{x:.2} {y:.2}");
            ring.edges().for_each(|edge| push_edge(&mut data, &edge, frame));
            data.push('Z');
        }
    }
    data
}

/// A path from its start to its end.
pub(super) fn path_data(path: &Path, frame: &Frame) -> String {
    let (x, y) = frame.place(path.start);
    let mut data = format!("M{x:.2} {y:.2}");
    path.edges().for_each(|edge| push_edge(&mut data, &edge, frame));
    data
}

fn push_edge(data: &mut String, edge: &Edge, frame: &Frame) {
    let (x, y) = frame.place(edge.end());
    match edge {
        Edge::Arc(arc)
            if arc.radius * (1.0 - (arc.sweep / 2.0).cos()) * frame.scale > FLAT || arc.sweep.abs() > PI =>
        {
            let radius = arc.radius * frame.scale;
            // y points down on the canvas: what runs counter-clockwise has sweep flag 0.
            let flag = u8::from(arc.sweep < 0.0);
            // Halves and full turns would be ambiguous: drawn in two.
            if arc.sweep.abs() > 0.9 * PI {
                let (middle_x, middle_y) = frame.place(arc.point_at(0.5));
                let _ = write!(data, "A{radius:.3} {radius:.3} 0 0 {flag} {middle_x:.2} {middle_y:.2}");
            }
            let _ = write!(data, "A{radius:.3} {radius:.3} 0 0 {flag} {x:.2} {y:.2}");
        }
        _ => {
            let _ = write!(data, "L{x:.2} {y:.2}");
        }
    }
}
