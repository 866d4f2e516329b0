//! Whether a point lies inside, on the border of, or outside a ring or polygon.
//!
//! Nonzero winding by half-open ray crossing (D. Sunday, Practical Geometry Algorithms, 2021, ch. 2). Chords are
//! decided by exact orientation; an arc adds the turn round the cap between it and its chord. Cost: linear.

use crate::{Arc, Bounds, Orientation, Point, Polygon, Ring, orientation};

/// Where a point lies as seen from a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// In the open interior.
    Inside,
    /// On the border: exactly for straight edges, within [`Arc::rounding_mm`] for circular ones.
    Border,
    /// Elsewhere.
    Outside,
}

impl Ring {
    /// Where `p` lies as seen from the region that the ring encloses. Antennas and slits of width 0 are border.
    /// A point with a coordinate that is not finite is outside. Cost: linear.
    #[must_use]
    pub fn locate(&self, p: Point) -> Location {
        let mut winding = Winding::around(p);
        for i in 0..self.len() {
            winding.pass_edge(self, i);
        }
        winding.location()
    }

    /// Whether `p` lies inside or on the border. Cost: linear.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        self.locate(p) != Location::Outside
    }
}

impl Polygon {
    /// Where `p` lies as seen from the region: the borders of holes are border, too, even where two holes or a hole and
    /// the outer ring share an edge. A point with a coordinate that is not finite is outside. Cost: linear.
    #[must_use]
    pub fn locate(&self, p: Point) -> Location {
        match self.outer().locate(p) {
            Location::Inside => {}
            elsewhere => return elsewhere,
        }
        let mut location = Location::Inside;
        for hole in self.holes() {
            match hole.locate(p) {
                Location::Inside => return Location::Outside,
                Location::Border => location = Location::Border,
                Location::Outside => {}
            }
        }
        location
    }

    /// Whether `p` lies inside or on the border. Cost: linear.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        self.locate(p) != Location::Outside
    }
}

/// Turns of a closed chain round a point, edge by edge, in any order of the edges. Edges whose box the ray from the
/// point to the right does not meet may be left out.
pub(crate) struct Winding {
    p: Point,
    turns: i64,
    on_border: bool,
}

impl Winding {
    pub(crate) fn around(p: Point) -> Self {
        Self { p, turns: 0, on_border: false }
    }

    pub(crate) fn location(&self) -> Location {
        if self.on_border {
            Location::Border
        } else if self.turns != 0 {
            Location::Inside
        } else {
            Location::Outside
        }
    }

    /// Takes edge `i` of `ring` into account.
    pub(crate) fn pass_edge(&mut self, ring: &Ring, i: usize) {
        let vertices = ring.vertices();
        let (start, end) = (vertices[i], vertices[if i + 1 == vertices.len() { 0 } else { i + 1 }]);
        let bulge = ring.bulges().get(i).copied().unwrap_or(0.0);
        if bulge == 0.0 {
            self.pass_chord(start, end, true);
        } else {
            self.pass_chord(start, end, false);
            self.on_border |= self.p == start || self.p == end;
            self.pass_cap(start, end, bulge);
        }
    }

    fn pass_chord(&mut self, start: Point, end: Point, is_edge: bool) {
        let p = self.p;
        let (low, high) = if start.y <= end.y { (start, end) } else { (end, start) };
        if p.y < low.y || p.y > high.y || p.x > low.x.max(high.x) {
            return;
        }
        let side = orientation(low, high, p);
        if is_edge && side == Orientation::Straight && Bounds::of([start, end]).contains(p) {
            self.on_border = true;
        } else if p.y < high.y && side == Orientation::Left {
            self.turns += if start.y < end.y { 1 } else { -1 };
        }
    }

    /// Adds the turn round the cap between an arc and its chord. A point on the chord belongs to the side on which
    /// `pass_chord` counts it: to the right of a chord, above a level one.
    fn pass_cap(&mut self, start: Point, end: Point, bulge: f64) {
        let p = self.p;
        let reach = ((end.x - start.x).abs() + (end.y - start.y).abs()) * bulge.abs() / 2.0
            + crate::CONTACT_TOLERANCE_MM;
        if !Bounds::of([start, end]).grown(reach).contains(p) {
            return;
        }
        let arc = Arc::from_bulge(start, end, bulge);
        if arc.distance_to_point(p) <= arc.rounding_mm() {
            self.on_border = true;
            return;
        }
        let cap_side = if bulge > 0.0 { Orientation::Right } else { Orientation::Left };
        let side = match orientation(start, end, p) {
            Orientation::Straight => {
                let counted_left = if start.y == end.y { start.x < end.x } else { start.y > end.y };
                if counted_left { Orientation::Left } else { Orientation::Right }
            }
            side => side,
        };
        if side == cap_side && (p - arc.center).norm() < arc.radius {
            self.turns += if bulge > 0.0 { 1 } else { -1 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slits_and_antennas_are_border() {
        let ring = Ring::from_xy(&[0.0, 0.0, 4.0, 0.0, 7.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0], &[]).unwrap();
        assert_eq!(ring.locate(Point::new(6.0, 0.0)), Location::Border);
        assert_eq!(ring.locate(Point::new(6.0, 1e-300)), Location::Outside);
        assert_eq!(ring.locate(Point::new(3.0, 1e-300)), Location::Inside);
    }

    #[test]
    fn chords_of_half_circles_are_inside() {
        for xy in [[-1.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 1.0], [1.0, 1.0, -1.0, -1.0]] {
            let circle = Ring::from_xy(&xy, &[1.0, 1.0]).unwrap();
            for ring in [circle.clone(), circle.reversed()] {
                for share in [0.1, 0.25, 0.5, 0.75] {
                    let p = Point::new(xy[0] + (xy[2] - xy[0]) * share, xy[1] + (xy[3] - xy[1]) * share);
                    assert_eq!(ring.locate(p), Location::Inside);
                }
                assert_eq!(ring.locate(Point::new(-2.0, 0.0)), Location::Outside);
                assert_eq!(ring.locate(Point::new(xy[0], xy[1])), Location::Border);
            }
        }
    }

    #[test]
    fn nowhere_is_outside() {
        let circle = Ring::from_xy(&[-1.0, 0.0, 1.0, 0.0], &[1.0, 1.0]).unwrap();
        for p in [[f64::NAN, 0.0], [0.0, f64::NAN], [f64::INFINITY, 0.0], [f64::NEG_INFINITY, 0.5]] {
            assert_eq!(circle.locate(Point::from(p)), Location::Outside);
        }
    }
}
