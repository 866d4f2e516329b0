//! The path with arrows, and the marks of its ends.

use super::Shown;
use super::frame::Frame;
use super::outline::path_data;
use std::fmt::Write;
use traverse_geometry::{Edge, Path};

/// Radius of the marks of start and target.
pub(super) const MARK_RADIUS: f64 = 11.0;
/// More moves than this have small marks.
const MANY_MOVES: usize = 24;
/// Steps at least this long carry an arrow.
const ARROW_STEP: f64 = 70.0;
/// Arrows are at least this far apart along the path.
const ARROW_DISTANCE: f64 = 180.0;

pub(super) fn draw(svg: &mut String, shown: &Shown<'_>, frame: &Frame) {
    if let Shown::NoPath { start, target, .. } = shown {
        let ((x0, y0), (x1, y1)) = (frame.place(*start), frame.place(*target));
        let _ = writeln!(svg, "<path class=\"wish\" d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}\"/>");
    }
    let lines: Vec<String> = shown.paths().iter().map(|path| path_data(path, frame)).collect();
    // What was lies beneath what is.
    let before: Vec<String> = shown.before().iter().map(|path| path_data(path, frame)).collect();
    for (class, lines) in
        [("casing thin", &before), ("before", &before), ("casing", &lines), ("rapid", &lines)]
    {
        for data in lines {
            let _ = writeln!(svg, "<path class=\"{class}\" d=\"{data}\"/>");
        }
    }
    for path in shown.paths() {
        arrows(svg, path, frame);
    }
    let ends = shown.ends();
    let size = mark_size(ends.len());
    for (start, target) in ends {
        let ((x0, y0), (x1, y1)) = (frame.place(start), frame.place(target));
        start_mark(svg, x0, y0, size);
        target_mark(svg, x1, y1, size);
    }
}

/// Size of the marks of so many moves, 1 for a few: many marks must leave the paths to be seen.
pub(super) fn mark_size(moves: usize) -> f64 {
    if moves > MANY_MOVES { 0.4 } else { 1.0 }
}

/// A ring with a dot.
pub(super) fn start_mark(svg: &mut String, x: f64, y: f64, size: f64) {
    let _ = writeln!(
        svg,
        "<circle class=\"mark\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.1}\"/>\
         <circle class=\"dot\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.1}\"/>",
        size * (MARK_RADIUS - 1.5),
        size * 4.0
    );
}

/// A diamond with a cross.
pub(super) fn target_mark(svg: &mut String, x: f64, y: f64, size: f64) {
    let r = size * (MARK_RADIUS + 1.5);
    let (left, right, top, bottom) = (x - r, x + r, y - r, y + r);
    let _ = writeln!(
        svg,
        "<path class=\"mark\" d=\"M{left:.2} {y:.2}L{x:.2} {top:.2}L{right:.2} {y:.2}L{x:.2} {bottom:.2}Z\
         M{left:.2} {y:.2}H{right:.2}M{x:.2} {top:.2}V{bottom:.2}\"/>"
    );
}

/// An arrow in the middle of long steps.
fn arrows(svg: &mut String, path: &Path, frame: &Frame) {
    let mut since = ARROW_DISTANCE;
    for edge in path.edges() {
        let length = edge.length() * frame.scale;
        if length >= ARROW_STEP && since + length / 2.0 >= ARROW_DISTANCE {
            arrow(svg, &edge, frame);
            since = length / 2.0;
        } else {
            since += length;
        }
    }
}

fn arrow(svg: &mut String, edge: &Edge, frame: &Frame) {
    let (x, y) = frame.place(edge.point_at(0.5));
    let along = edge.direction_at(0.5);
    let degrees = (-along.y).atan2(along.x).to_degrees();
    let _ = writeln!(
        svg,
        "<path class=\"arrow\" d=\"M12 0L-8 -8L-4 0L-8 8Z\" transform=\"translate({x:.2} {y:.2}) rotate({degrees:.2})\"/>"
    );
}

/// Points along edges, close enough to tell whether a label covers them.
pub(super) fn samples(edges: impl Iterator<Item = Edge>, frame: &Frame) -> Vec<(f64, f64)> {
    /// Distance between samples, canvas units.
    const STEP: f64 = 4.0;
    let mut points = Vec::new();
    for edge in edges {
        let count = (edge.length() * frame.scale / STEP).ceil().clamp(1.0, 2000.0) as usize;
        points.extend((0..=count).map(|i| frame.place(edge.point_at(i as f64 / count as f64))));
    }
    points
}
