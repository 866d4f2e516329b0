//! The point of a border that is nearest to a given one.

use crate::{Edge, Point, Polygon, Ring};

impl Ring {
    /// The point of the ring nearest to `p`; the first one in edge order where several are equally near. `p` is
    /// finite. Cost: linear.
    #[must_use]
    pub fn nearest_point(&self, p: Point) -> Point {
        nearest(self.edges(), p).unwrap_or(self.vertices()[0])
    }

    /// Distance from `p` to the nearest point of the ring, millimetres; 0 on it, positive inside and outside alike.
    /// Cost: linear.
    #[must_use]
    pub fn distance_to_point(&self, p: Point) -> f64 {
        self.edges().map(|edge| edge.distance_to_point(p)).fold(f64::INFINITY, f64::min)
    }
}

impl Polygon {
    /// The point of the border, holes included, nearest to `p`; of several, the first in the order of the rings.
    /// `p` is finite. Cost: linear.
    #[must_use]
    pub fn nearest_point(&self, p: Point) -> Point {
        nearest(self.rings().flat_map(Ring::edges), p).unwrap_or(self.outer().vertices()[0])
    }

    /// Distance from `p` to the border, holes included, millimetres; 0 on it, positive inside and outside alike.
    /// Cost: linear.
    #[must_use]
    pub fn distance_to_border(&self, p: Point) -> f64 {
        self.rings().map(|ring| ring.distance_to_point(p)).fold(f64::INFINITY, f64::min)
    }
}

fn nearest(edges: impl Iterator<Item = Edge>, p: Point) -> Option<Point> {
    let mut nearest: Option<(f64, Point)> = None;
    for edge in edges {
        let candidate = edge.nearest_point(p);
        let square = (candidate - p).norm_squared();
        if nearest.is_none_or(|(least, _)| square < least) {
            nearest = Some((square, candidate));
        }
    }
    nearest.map(|(_, point)| point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_border_of_a_hole_counts() {
        let outer = Ring::from_xy(&[0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0], &[]).unwrap();
        let hole = Ring::from_xy(&[4.0, 5.0, 6.0, 5.0], &[1.0, 1.0]).unwrap();
        let polygon = Polygon::new(outer, vec![hole]).unwrap();
        assert_eq!(polygon.nearest_point(Point::new(5.0, 7.0)), Point::new(5.0, 6.0));
        assert_eq!(polygon.distance_to_border(Point::new(5.0, 7.0)), 1.0);
        assert_eq!(polygon.distance_to_border(Point::new(5.0, -2.0)), 2.0);
        assert_eq!(polygon.distance_to_border(Point::new(5.0, 5.0)), 1.0);
        assert_eq!(polygon.distance_to_border(Point::new(0.0, 3.0)), 0.0);
    }
}
