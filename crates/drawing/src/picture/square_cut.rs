//! Mitred corners beyond the limit: barriers are cut square to the bisector there, at the limit's distance. SVG bevels
//! such corners nearer to the vertex; what is missing is drawn by itself.

use super::frame::Frame;
use std::fmt::Write;
use traverse_geometry::{CornerStyle, Edge, MITER_RATIO_LIMIT, Point, Ring, cross, left_of};

/// The pieces that bevelled corners lack, as path data. The region grown lies left of the rings.
pub(super) fn data(
    rings: impl Iterator<Item = Ring>,
    clearance: f64,
    style: CornerStyle,
    frame: &Frame,
) -> String {
    let mut data = String::new();
    let CornerStyle::Miter { limit } = style else { return data };
    let limit = limit.unwrap_or(MITER_RATIO_LIMIT).max(1.0);
    if clearance <= 0.0 {
        return data;
    }
    for ring in rings {
        let edges: Vec<Edge> = ring.edges().collect();
        for (before, after) in edges.iter().zip(edges.iter().cycle().skip(1)) {
            if let Some(corners) = cut(before, after, clearance, limit) {
                for (i, corner) in corners.into_iter().enumerate() {
                    let (x, y) = frame.place(corner);
                    let _ = write!(data, "{}{x:.2} {y:.2}", if i == 0 { 'M' } else { 'L' });
                }
                data.push('Z');
            }
        }
    }
    data
}

/// The vertex and the corners of the barrier's border beside it, where it is cut square.
fn cut(before: &Edge, after: &Edge, clearance: f64, limit: f64) -> Option<[Point; 5]> {
    let (along, onward) = (before.direction_at(1.0), after.direction_at(0.0));
    let turn = cross(along, onward).atan2(along.dot(&onward));
    let half = turn / 2.0;
    if turn <= 0.0 || half.cos() * limit >= 1.0 {
        return None;
    }
    let vertex = after.start();
    let (from, to) = (vertex - left_of(along) * clearance, vertex - left_of(onward) * clearance);
    let reach = clearance * (limit - half.cos()) / half.sin();
    Some([vertex, from, from + along * reach, to - onward * reach, to])
}
