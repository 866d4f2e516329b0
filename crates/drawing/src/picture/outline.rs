//! Rings and paths as SVG path data.

use super::frame::Frame;
use std::f64::consts::PI;
use std::fmt::Write;
use traverse_geometry::{Edge, Path, Polygon};

/// Arcs whose middle is nearer than this to their chord are drawn straight, canvas units.
const FLAT: f64 = 0.01;

/// Straight steps shorter than this are drawn with the next one, canvas units: what is finer can't be seen, and bounds
/// the size of the file.
const FINE: f64 = 0.15;

/// A polygon: outer ring and holes, for the even-odd rule.
pub(super) fn polygon_data(polygon: &Polygon, frame: &Frame) -> String {
    let mut data = String::new();
    for ring in polygon.rings() {
        push_chain(&mut data, ring.edges(), true, frame);
    }
    data
}

/// A path from its start to its end.
pub(super) fn path_data(path: &Path, frame: &Frame) -> String {
    let mut data = String::new();
    push_chain(&mut data, path.edges(), false, frame);
    if data.is_empty() {
        let (x, y) = frame.place(path.start);
        let _ = write!(data, "M{x:.2} {y:.2}");
    }
    data
}

/// Edges one after the other, joined at the end or not.
pub(super) fn push_chain(data: &mut String, edges: impl Iterator<Item = Edge>, closed: bool, frame: &Frame) {
    let mut edges = edges.peekable();
    let Some(first) = edges.peek() else { return };
    let (mut x, mut y) = frame.place(first.start());
    let _ = write!(data, "M{x:.2} {y:.2}");
    while let Some(edge) = edges.next() {
        let (to_x, to_y) = frame.place(edge.end());
        let fine = matches!(edge, Edge::Segment(_)) && (to_x - x).hypot(to_y - y) < FINE;
        if !fine || edges.peek().is_none() {
            push_edge(data, &edge, frame);
            (x, y) = (to_x, to_y);
        }
    }
    if closed {
        data.push('Z');
    }
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
