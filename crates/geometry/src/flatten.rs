//! Circular edges as chords, to a stated tolerance on a stated side: only for what has no notion of arcs.
//!
//! With sagitta r (1 − cos δ/2) for chords and r (1 / cos δ/2 − 1) for tangents. No piece turns by more than a
//! quarter turn, so a circle keeps an area whatever the tolerance. Cost: linear in the points made.

use crate::{Arc, CONTACT_TOLERANCE_MM, Edge, Point, Ring, unit};
use std::f64::consts::FRAC_PI_2;

/// Where the straight pieces of a flattened arc lie, as seen from its circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Chords {
    /// In the circle: corners on the arc.
    Inscribed,
    /// Round the circle: every piece is a tangent.
    Circumscribed,
    /// Either side, with the fewest pieces.
    Nearest,
}

/// Where a flattened ring lies, as seen from the region that it encloses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FlattenSide {
    /// The flattened region lies within the true one.
    Inside,
    /// The flattened region holds the true one.
    Outside,
    /// Either side, with the fewest vertices.
    Nearest,
}

impl Edge {
    /// The edge as straight pieces: start, corners, end. No point of a piece lies further than `tolerance_mm` from
    /// the arc, and none on the wrong side by more than rounding. A straight edge gives its ends.
    ///
    /// A tolerance that is smaller than [`CONTACT_TOLERANCE_MM`], or no number, counts as that. An edge makes about
    /// 1.1 √(radius / tolerance) pieces per half turn.
    #[must_use]
    pub fn flattened(&self, chords: Chords, tolerance_mm: f64) -> Vec<Point> {
        let mut points = vec![self.start()];
        if let Self::Arc(arc) = self {
            push_corners(arc, chords, tolerance_mm.max(CONTACT_TOLERANCE_MM), &mut points);
        }
        points.push(self.end());
        points
    }
}

impl Ring {
    /// The ring with its arcs as straight pieces, as the vertices of a closed chain; the first one is not repeated.
    /// `tolerance_mm` as for [`Edge::flattened`].
    ///
    /// The chain may cross itself where the ring comes nearer to itself than the tolerance.
    #[must_use]
    pub fn flattened(&self, side: FlattenSide, tolerance_mm: f64) -> Vec<Point> {
        let region_left = self.has_arcs() && self.is_counter_clockwise();
        let tolerance = tolerance_mm.max(CONTACT_TOLERANCE_MM);
        let mut points = Vec::with_capacity(self.len());
        for edge in self.edges() {
            points.push(edge.start());
            if let Edge::Arc(arc) = edge {
                let convex = (arc.sweep > 0.0) == region_left;
                let chords = match (side, convex) {
                    (FlattenSide::Inside, true) | (FlattenSide::Outside, false) => Chords::Inscribed,
                    (FlattenSide::Outside, true) | (FlattenSide::Inside, false) => Chords::Circumscribed,
                    (FlattenSide::Nearest, _) => Chords::Nearest,
                };
                push_corners(&arc, chords, tolerance, &mut points);
            }
        }
        points
    }
}

/// First and last piece over an inner one, for corners that lie outside while the ends lie on the arc: with
/// x = r φ² / t, (x − 2)² = 8 x against r δ² / t = 16.
const END_PIECE: f64 = 0.84;

/// Adds the corners between start and end.
fn push_corners(arc: &Arc, chords: Chords, tolerance: f64, points: &mut Vec<Point>) {
    let (radius, turn) = (arc.radius, arc.sweep.abs());
    let mut push = |fraction: f64, distance: f64| {
        points.push(arc.center + unit(arc.start_angle + arc.sweep * fraction) * distance);
    };
    // sin²(δ / 4) = (1 − cos(δ / 2)) / 2 keeps its digits where acos would not.
    let widest = |half_versine: f64| (4.0 * half_versine.min(1.0).sqrt().asin()).min(FRAC_PI_2);
    match chords {
        Chords::Inscribed => {
            let pieces = (turn / widest(tolerance / (2.0 * radius))).ceil();
            (1..pieces as u32).for_each(|i| push(f64::from(i) / pieces, radius));
        }
        Chords::Circumscribed => {
            let pieces = (turn / widest(tolerance / (2.0 * (radius + tolerance)))).ceil().max(1.0);
            let distance = radius / (turn / pieces / 2.0).cos();
            (0..pieces as u32).for_each(|i| push((f64::from(i) + 0.5) / pieces, distance));
        }
        Chords::Nearest => {
            if turn <= widest(tolerance / (2.0 * radius)) {
                return;
            }
            let inner = (turn / widest(tolerance / (radius + tolerance)) - 2.0 * END_PIECE).ceil().max(0.0);
            let total = inner + 2.0 * END_PIECE;
            // Half of what a piece rises over its chord lies outside.
            let distance = radius * 2.0 / (1.0 + (turn / total / 2.0).cos());
            (0..=inner as u32).for_each(|i| push((f64::from(i) + END_PIECE) / total, distance));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Segment;
    use proptest::prelude::*;

    fn arcs() -> impl Strategy<Value = Arc> {
        (-1e3..1e3, 0.01..1e4, 0.0..6.3, prop_oneof![0.01..6.2, -6.2..-0.01]).prop_map(
            |(x, radius, angle, sweep)| Arc::from_angles(Point::new(x, -x / 3.0), radius, angle, sweep),
        )
    }

    proptest! {
        #[test]
        fn pieces_keep_tolerance_and_side(arc in arcs(), exponent in -5.0..1.0) {
            let tolerance: f64 = 10f64.powf(exponent);
            for chords in [Chords::Inscribed, Chords::Circumscribed, Chords::Nearest] {
                let points = Edge::Arc(arc).flattened(chords, tolerance);
                prop_assert_eq!((points[0], points[points.len() - 1]), (arc.start, arc.end));
                for pair in points.windows(2).take(50).chain(points.windows(2).rev().take(50)) {
                    for i in 0..=16 {
                        let p = Segment::new(pair[0], pair[1]).point_at(f64::from(i) / 16.0);
                        let height = (p - arc.center).norm() - arc.radius;
                        prop_assert!(height.abs() <= tolerance + 1e-9, "{height} over {tolerance}, {chords:?}");
                        prop_assert!(chords != Chords::Inscribed || height <= 1e-9);
                        prop_assert!(chords != Chords::Circumscribed || height >= -1e-9);
                    }
                }
            }
        }

        #[test]
        fn nearest_takes_no_more_pieces(arc in arcs()) {
            let count = |chords| Edge::Arc(arc).flattened(chords, 0.01).len();
            prop_assert!(count(Chords::Nearest) <= count(Chords::Inscribed) + 1);
        }
    }

    #[test]
    fn a_moon_has_convex_and_concave_sides() {
        let moon = Ring::from_xy(&[0.0, 0.0, 20.0, 0.0], &[1.0, -0.5]).unwrap();
        for ring in [moon.clone(), moon.reversed()] {
            let area = |side| Ring::new(ring.flattened(side, 0.01), Vec::new()).unwrap().signed_area().abs();
            let exact = ring.signed_area().abs();
            assert!(area(FlattenSide::Inside) < exact && exact < area(FlattenSide::Outside));
            assert!((area(FlattenSide::Nearest) - exact).abs() < 0.01 * ring.length());
        }
    }

    #[test]
    fn odd_tolerances_end() {
        let circle = Ring::from_xy(&[0.0, 0.0, 2.0, 0.0], &[1.0, 1.0]).unwrap();
        assert_eq!(circle.flattened(FlattenSide::Inside, 1e9).len(), 4);
        for tolerance in [f64::NAN, -1.0, 0.0] {
            assert!((1000..10_000).contains(&circle.flattened(FlattenSide::Inside, tolerance).len()));
        }
    }
}
