//! How far can be seen from a point, at most, in every direction: what leaves out most tangents from a start before they
//! are worked out.
//!
//! The directions are divided into narrow bands; a band ends where a chain of edges crosses all of it. Cost: constant
//! per question.

use traverse_geometry::{Edge, Point, Vector, cross};

/// Bands in a quarter turn.
const BANDS: usize = 64;

/// A farthest distance for every band of directions.
pub(super) struct Horizon {
    from: Point,
    half_width: f64,
    /// Beyond this nothing is seen, millimetres.
    far: Vec<f64>,
}

impl Horizon {
    /// No horizon yet, for moves from `from` that are as wide as two times `half_width`.
    pub(super) fn new(from: Point, half_width: f64) -> Self {
        Self { from, half_width, far: vec![f64::INFINITY; 4 * BANDS] }
    }

    /// Takes in a connected chain of edges.
    pub(super) fn add_chain<'a>(&mut self, chain: impl Iterator<Item = &'a Edge>) {
        // The chain's extent, from its first point on: angles are told apart while it stays within a half turn.
        let mut extremes: Option<[Vector; 2]> = None;
        let mut far = 0.0_f64;
        let mut end: Option<Point> = None;
        for edge in chain {
            let Edge::Segment(segment) = edge else { return };
            if end.is_some_and(|end| end != segment.start) {
                return;
            }
            end = Some(segment.end);
            if segment.distance_to_point(self.from) < 2.0 * self.half_width + 1e-9 {
                return;
            }
            for p in [segment.start, segment.end] {
                let by = p - self.from;
                far = far.max(by.norm());
                let [low, high] = extremes.get_or_insert([by, by]);
                if cross(*low, by) < 0.0 {
                    *low = by;
                } else if cross(*high, by) > 0.0 {
                    *high = by;
                }
                // Still within a quarter turn?
                if low.dot(high) <= 0.0 {
                    return;
                }
            }
        }
        let Some([low, high]) = extremes else { return };
        let inward = |by: Vector, sign: f64| {
            by + traverse_geometry::left_of(by) * (sign * 1.2 * self.half_width / by.norm())
        };
        let (low, high) = (inward(low, 1.0), inward(high, -1.0));
        if cross(low, high) <= 0.0 {
            return;
        }
        let total = self.far.len();
        let first = band_place(low).floor() as usize + 1;
        let last = band_place(high).floor() as usize;
        let count = (last + total - first) % total;
        // More than a quarter turn: the range wrapped round nothing.
        if count > BANDS {
            return;
        }
        for band in first..first + count {
            let known = &mut self.far[band % total];
            *known = known.min(far + 2.0 * self.half_width);
        }
    }

    /// Whether a circle of `radius`, at most half the width of the moves, is hidden when its centre lies `by` away.
    pub(super) fn hides(&self, by: Vector, radius: f64) -> bool {
        radius <= self.half_width && {
            let band = band_place(by) as usize % self.far.len();
            by.norm() > self.far[band]
        }
    }
}

/// Where among the bands a direction lies, from 0 to the count of bands: grows with the angle.
fn band_place(by: Vector) -> f64 {
    let share = by.y.abs() / (by.x.abs() + by.y.abs()).max(f64::MIN_POSITIVE);
    let quarter = match (by.x >= 0.0, by.y >= 0.0) {
        (true, true) => share,
        (false, true) => 2.0 - share,
        (false, false) => 2.0 + share,
        (true, false) => 4.0 - share,
    };
    quarter * BANDS as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_geometry::{Segment, unit};
    use traverse_solve::Seed;

    /// What is hidden can't be seen: the straight line to it crosses an edge.
    #[test]
    fn what_is_hidden_is_behind_an_edge() {
        let mut hidden = 0;
        for seed in 0..300 {
            let mut random = Seed(seed).stream();
            let from = Point::new(random.random_range(-5.0..5.0), random.random_range(-5.0..5.0));
            let mut horizon = Horizon::new(from, 1e-6);
            let edges: Vec<Edge> = (0..12)
                .map(|_| {
                    let at = from + unit(random.random_range(0.0..7.0)) * random.random_range(1.0..20.0);
                    let to = at + unit(random.random_range(0.0..7.0)) * random.random_range(0.1..15.0);
                    Edge::Segment(Segment::new(at, to))
                })
                .collect();
            edges.iter().for_each(|edge| horizon.add_chain(std::iter::once(edge)));
            for _ in 0..300 {
                let by = unit(random.random_range(0.0..7.0)) * random.random_range(0.1..60.0);
                if horizon.hides(by, 0.0) {
                    hidden += 1;
                    let line = Edge::Segment(Segment::new(from, from + by));
                    assert!(edges.iter().any(|edge| edge.distance(&line) == 0.0), "seed {seed}: {by:?}");
                }
            }
        }
        assert!(hidden > 5_000, "{hidden}");
    }
}
