//! Points that lie together become one vertex.
//!
//! The points are gone through from left to right; each joins the nearest vertex within the tolerance or becomes one
//! itself. Vertices are then more than the tolerance apart, so each looks at a bounded number of neighbours and the
//! order of the input does not matter. Cost: n log n.

use std::collections::HashMap;
use traverse_geometry::Point;

/// Vertices, and which of them each point became.
pub(super) struct Snapped {
    pub(super) vertices: Vec<Point>,
    pub(super) vertex_of: Vec<usize>,
}

/// Smallest side of a grid cell, millimetres: keeps cell numbers within integers at tolerance 0.
const SMALLEST_CELL_MM: f64 = 1e-9;

pub(super) fn snap(points: &[Point], tolerance_mm: f64) -> Snapped {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (points[a], points[b]);
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
    });
    let side = tolerance_mm.max(SMALLEST_CELL_MM);
    let mut grid: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    let mut snapped = Snapped { vertices: Vec::new(), vertex_of: vec![0; points.len()] };
    for i in order {
        let p = points[i];
        let cell = ((p.x / side).floor() as i64, (p.y / side).floor() as i64);
        let nearest = (-1..=1)
            .flat_map(|dx| (-1..=1).map(move |dy| (cell.0 + dx, cell.1 + dy)))
            .filter_map(|near| grid.get(&near))
            .flatten()
            .map(|&vertex| ((snapped.vertices[vertex] - p).norm(), vertex))
            .filter(|&(distance, _)| distance <= tolerance_mm)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        snapped.vertex_of[i] = match nearest {
            Some((_, vertex)) => vertex,
            None => {
                snapped.vertices.push(p);
                grid.entry(cell).or_default().push(snapped.vertices.len() - 1);
                snapped.vertices.len() - 1
            }
        };
    }
    snapped
}

#[cfg(test)]
mod tests {
    use super::snap;
    use traverse_geometry::Point;

    #[test]
    fn points_within_the_tolerance_share_a_vertex_whatever_their_order() {
        let points: Vec<Point> =
            [(0.0, 0.0), (0.004, 0.004), (5.0, 5.0), (5.0, 5.02), (-0.004, 0.0), (5.0, 5.0)]
                .map(|(x, y)| Point::new(x, y))
                .to_vec();
        let snapped = snap(&points, 0.01);
        let v = &snapped.vertex_of;
        assert_eq!(snapped.vertices.len(), 3);
        assert!(v[0] == v[1] && v[0] == v[4] && v[2] == v[5] && v[2] != v[3]);
        let back: Vec<Point> = points.iter().rev().copied().collect();
        assert_eq!(snap(&back, 0.01).vertices, snapped.vertices);
    }

    #[test]
    fn tolerance_zero_joins_equal_points_only() {
        let points = [Point::new(0.0, 1.0), Point::new(-0.0, 1.0), Point::new(1e-12, 1.0)];
        assert_eq!(snap(&points, 0.0).vertices.len(), 2);
    }
}
