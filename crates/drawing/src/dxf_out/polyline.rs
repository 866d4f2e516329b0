//! Edges as one LWPOLYLINE.

use super::groups::Groups;
use std::f64::consts::PI;
use traverse_geometry::{Edge, Point};

/// Connected edges as one LWPOLYLINE; a closed one leaves out the last point.
pub(crate) fn polyline(
    groups: &mut Groups,
    owner: u32,
    layer: &str,
    edges: impl Iterator<Item = Edge>,
    closed: bool,
) {
    let mut vertices: Vec<(Point, f64)> = Vec::new();
    let mut end = None;
    for edge in edges {
        match edge {
            Edge::Segment(segment) => vertices.push((segment.start, 0.0)),
            // Beyond half a turn the chord shrinks and the bulge loses digits.
            Edge::Arc(arc) if arc.sweep.abs() > PI => {
                let bulge = (arc.sweep / 8.0).tan();
                vertices.extend([(arc.start, bulge), (arc.point_at(0.5), bulge)]);
            }
            Edge::Arc(arc) => vertices.push((arc.start, arc.bulge())),
        }
        end = Some(edge.end());
    }
    if !closed {
        vertices.extend(end.map(|end| (end, 0.0)));
    }
    groups.entity("LWPOLYLINE", owner, layer, "AcDbPolyline");
    groups.add(90, vertices.len());
    groups.add(70, i32::from(closed));
    groups.number(43, 0.0);
    for (p, bulge) in vertices {
        groups.number(10, p.x);
        groups.number(20, p.y);
        if bulge != 0.0 {
            groups.number(42, bulge);
        }
    }
}
