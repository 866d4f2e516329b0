//! Points well inside a part. Two parts may lie over one another with no border of either inside the other: where they
//! are the same part, twice in one place. Then points inside tell.
//!
//! The part is cut at heights between those of its vertices, and the middle of every stretch that is inside is taken:
//! each region that its border encloses has a vertex at its top, so one of the cuts beside it runs through it.

use crate::curve::Curve;
use traverse_geometry::{Point, Polygon, Vector};

/// Most heights at which one part is cut.
const MOST_CUTS: usize = 24;

/// Heights nearer to each other than this are one, up to rounding, millimetres: between them nothing is cut.
const THINNEST_MM: f64 = 1e-6;

/// Points inside `shape`. Cost: at most [`MOST_CUTS`] times its vertices.
pub(crate) fn witnesses(shape: &Polygon) -> Vec<Point> {
    let curves: Vec<Curve> = (shape.rings())
        .flat_map(|ring| {
            let bulges = ring.bulges().iter().copied().chain(std::iter::repeat(0.0));
            ring.edges().zip(bulges).map(|(edge, bulge)| Curve::from_bulge(edge.start(), edge.end(), bulge))
        })
        .collect();
    let mut heights: Vec<f64> =
        curves.iter().flat_map(|curve| [curve.bounds().min.y, curve.bounds().max.y]).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|next, kept| *next - *kept < THINNEST_MM);
    let stride = heights.len().div_ceil(MOST_CUTS).max(1);
    heights
        .windows(2)
        .step_by(stride)
        .flat_map(|pair| middles(&curves, f64::midpoint(pair[0], pair[1])))
        .collect()
}

/// The middles of what is inside at this height.
fn middles(curves: &[Curve], height: f64) -> Vec<Point> {
    let mut crossings = Vec::new();
    let mut cuts = Vec::new();
    for curve in curves {
        curve.cut_by_line(Point::new(0.0, height), Vector::y(), 0.0, &mut cuts);
        crossings.extend(cuts.drain(..).map(|cut| curve.point_at(cut).x));
    }
    crossings.sort_by(f64::total_cmp);
    // An odd count means a tangent or a vertex by rounding: nothing can be said at this height.
    if crossings.len() % 2 == 1 {
        return Vec::new();
    }
    crossings.chunks_exact(2).map(|pair| Point::new(f64::midpoint(pair[0], pair[1]), height)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::{Location, Ring};

    fn ring(xy: &[f64], bulges: &[f64]) -> Ring {
        Ring::from_xy(xy, bulges).expect("the ring is valid")
    }

    #[test]
    fn every_lobe_and_no_hole_holds_a_witness() {
        let lobes = ring(&[0.0, 0.0, 10.0, 0.0, 5.0, 5.0, 10.0, 10.0, 0.0, 10.0, 5.0, 5.0], &[]);
        let found = witnesses(&Polygon::from_ring(lobes.clone()));
        assert!(found.iter().any(|p| p.y < 5.0) && found.iter().any(|p| p.y > 5.0), "{found:?}");
        let plate = ring(&[0.0, 0.0, 40.0, 0.0, 40.0, 20.0, 0.0, 20.0], &[]);
        let hole = ring(&[10.0, 10.0, 30.0, 10.0], &[1.0, 1.0]);
        let plate = Polygon::new(plate, vec![hole]).expect("the hole is inside");
        for shape in [Polygon::from_ring(lobes), plate] {
            let found = witnesses(&shape);
            assert!(!found.is_empty());
            for p in found {
                assert_eq!(shape.locate(p), Location::Inside, "{p}");
            }
        }
    }
}
