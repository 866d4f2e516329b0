//! Whether a point lies inside a solid: a ray to the right crosses its border an odd number of times.
//!
//! Straight edges by exact orientation, circular ones in pieces that rise or fall throughout. Every piece holds
//! its lower end and not its upper one, so that rays through vertices and along edges count right, and doubled
//! edges count twice. Meant for points farther from the border than rounding.

use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::curve::{Circular, Curve, Straight};
use std::collections::BTreeSet;
use traverse_geometry::{Orientation, Point, Vector, orientation};

/// Every solid that holds `p`. Cost: the edges right of `p`.
pub(crate) fn solids_around(boundary: &Boundary, tree: &BoundaryTree, p: Point) -> BTreeSet<u32> {
    let mut odd: BTreeSet<u32> =
        (0..boundary.solids.len() as u32).filter(|&solid| is_outside_of_area(boundary, solid)).collect();
    tree.to_the_right(p, f64::INFINITY, |edge| {
        if crosses(&boundary.curve(edge), p) {
            let solid = boundary.solid_of(edge);
            if !odd.remove(&solid) {
                odd.insert(solid);
            }
        }
    });
    odd
}

/// Whether `solid` holds `p`. Cost: the edges between `p` and the right end of the solid's box.
pub(crate) fn is_inside(boundary: &Boundary, tree: &BoundaryTree, p: Point, solid: u32) -> bool {
    let bounds = &boundary.solids[solid as usize].bounds;
    let mut odd = is_outside_of_area(boundary, solid);
    if bounds.contains(p) {
        tree.to_the_right(p, bounds.max.x, |edge| {
            odd ^= boundary.solid_of(edge) == solid && crosses(&boundary.curve(edge), p);
        });
    }
    odd
}

fn is_outside_of_area(boundary: &Boundary, solid: u32) -> bool {
    boundary.solids[solid as usize].obstacle.is_none()
}

/// Whether the ray from `p` to the right crosses the edge an odd number of times.
fn crosses(edge: &Curve, p: Point) -> bool {
    match edge {
        Curve::Straight(Straight { a, b }) => {
            let (low, high) = if a.y <= b.y { (*a, *b) } else { (*b, *a) };
            low.y <= p.y && p.y < high.y && orientation(low, high, p) == Orientation::Left
        }
        Curve::Circular(arc) => crosses_arc(edge, arc, p),
    }
}

fn crosses_arc(edge: &Curve, arc: &Circular, p: Point) -> bool {
    let mut cuts = vec![0.0, 1.0];
    edge.cut_by_direction(Vector::y(), &mut cuts);
    cuts.sort_by(f64::total_cmp);
    let in_circle = (p - arc.center).norm() < arc.radius;
    let mut odd = false;
    for pair in cuts.windows(2) {
        let (from, to) = (edge.point_at(pair[0]).y, edge.point_at(pair[1]).y);
        if (from <= p.y) != (to <= p.y) {
            let right_half = edge.point_at((pair[0] + pair[1]) / 2.0).x >= arc.center.x;
            odd ^=
                if right_half { p.x < arc.center.x || in_circle } else { p.x < arc.center.x && !in_circle };
        }
    }
    odd
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::{CornerStyle, Obstacle, Polygon, Ring, Scene};

    fn ring(xy: &[[f64; 2]], bulges: &[f64]) -> Ring {
        let vertices = xy.iter().map(|&[x, y]| Point::new(x, y)).collect();
        Ring::new(vertices, bulges.to_vec()).expect("the ring is valid")
    }

    #[test]
    fn discs_with_holes_hold_what_their_radii_say() {
        let disc = |radius: f64, x: f64| ring(&[[x - radius, 1.0], [x + radius, 1.0]], &[1.0, 1.0]);
        let shape = Polygon::new(disc(5.0, 2.0), vec![disc(2.0, 3.0)]).expect("the hole is inside");
        let scene = Scene {
            work_area: None,
            obstacles: vec![Obstacle { id: "a".into(), shape, clearance_mm: None, top_z_mm: None }],
            clearance_mm: 0.0,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::Round,
        };
        let boundary = Boundary::of(&scene);
        let tree = BoundaryTree::over(&boundary, &|| true).unwrap();
        for i in -80..80 {
            for j in -80..80 {
                let p = Point::new(f64::from(i) / 10.0, f64::from(j) / 10.0);
                let outer = (p - Point::new(2.0, 1.0)).norm();
                let hole = (p - Point::new(3.0, 1.0)).norm();
                if (outer - 5.0).abs() < 1e-9 || (hole - 2.0).abs() < 1e-9 {
                    continue;
                }
                let expected = outer < 5.0 && hole > 2.0;
                assert_eq!(is_inside(&boundary, &tree, p, 0), expected, "{p}");
                assert_eq!(solids_around(&boundary, &tree, p).contains(&0), expected, "{p}");
            }
        }
    }
}
