//! Which directions are covered, as seen from a point, by what stands nearer.
//!
//! Only the directions within a quarter turn of a middle one are told apart, by a measure that grows with the angle and
//! costs one division: `across / (|across| + ahead)`, from −1 to 1.

use traverse_geometry::{Edge, Point, Vector, cross, left_of};

/// A tilt whose sine is at most a half has a tangent at most this much larger.
const SINE_TO_TANGENT: f64 = 1.2;

/// Directions that are covered.
pub(super) struct Occlusion {
    from: Point,
    middle: Vector,
    /// Half the width of what may pass, and that with a margin.
    half_width: f64,
    /// Disjoint, ascending.
    covered: Vec<(f64, f64)>,
    /// Covers that count from a distance on: that distance and the directions.
    waiting: Vec<(f64, (f64, f64))>,
}

impl Occlusion {
    /// Nothing covered yet for moves from round `from` that are as wide as two times `half_width`.
    pub(super) fn new(from: Point, middle: Vector, half_width: f64) -> Self {
        Self { from, middle, half_width, covered: Vec::new(), waiting: Vec::new() }
    }

    /// The measure of a direction; none for one that points back.
    pub(super) fn measure(&self, direction: Vector) -> Option<f64> {
        let ahead = self.middle.dot(&direction);
        let across = cross(self.middle, direction);
        (ahead > 0.0).then(|| across / (across.abs() + ahead))
    }

    /// Adds the cover of a connected chain of edges, if it is one that covers anything for sure.
    pub(super) fn add_chain<'a>(&mut self, chain: impl Iterator<Item = &'a Edge>) {
        let mut lowest: Option<(f64, Vector)> = None;
        let mut highest: Option<(f64, Vector)> = None;
        let mut far = 0.0_f64;
        let mut end: Option<Point> = None;
        for edge in chain {
            let Edge::Segment(segment) = edge else { return };
            // A chain with gaps hides nothing for sure.
            if end.is_some_and(|end| end != segment.start) {
                return;
            }
            end = Some(segment.end);
            if segment.distance_to_point(self.from) < 2.0 * self.half_width + 1e-9 {
                return;
            }
            for p in [segment.start, segment.end] {
                let by = p - self.from;
                let Some(measure) = self.measure(by) else { return };
                far = far.max(by.norm());
                if lowest.is_none_or(|(known, _)| measure < known) {
                    lowest = Some((measure, by));
                }
                if highest.is_none_or(|(known, _)| measure > known) {
                    highest = Some((measure, by));
                }
            }
        }
        let (Some((_, lowest)), Some((_, highest))) = (lowest, highest) else { return };
        // Both ends stand out from the middle of what is covered by half the width of the move.
        let inward = |by: Vector, sign: f64| {
            let tilt = left_of(by) * (sign * SINE_TO_TANGENT * self.half_width / by.norm());
            self.measure(by + tilt)
        };
        let (Some(from), Some(to)) = (inward(lowest, 1.0), inward(highest, -1.0)) else { return };
        if from < to {
            self.waiting.push((far + 2.0 * self.half_width, (from, to)));
        }
    }

    /// From now on only what is at least so far away is looked at.
    pub(super) fn advance(&mut self, distance: f64) {
        let mut waiting = std::mem::take(&mut self.waiting);
        waiting.retain(|&(from_distance, range)| {
            let due = from_distance <= distance;
            if due {
                self.cover(range);
            }
            !due
        });
        self.waiting = waiting;
    }

    fn cover(&mut self, (from, to): (f64, f64)) {
        let first = self.covered.partition_point(|&(_, end)| end < from);
        let last = self.covered.partition_point(|&(begin, _)| begin <= to);
        if first == last {
            self.covered.insert(first, (from, to));
            return;
        }
        let joined = (from.min(self.covered[first].0), to.max(self.covered[last - 1].1));
        self.covered[first] = joined;
        self.covered.drain(first + 1..last);
    }

    /// Whether every direction from `from` to `to` is covered.
    pub(super) fn covers(&self, from: f64, to: f64) -> bool {
        let at = self.covered.partition_point(|&(_, end)| end < from);
        self.covered.get(at).is_some_and(|&(begin, end)| begin <= from && to <= end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::Segment;

    #[test]
    fn covers_join_and_count_from_their_distance_on() {
        let mut occlusion = Occlusion::new(Point::origin(), Vector::x(), 1e-6);
        let wall = |x: f64, low: f64, high: f64| {
            [Edge::Segment(Segment::new(Point::new(x, low), Point::new(x, high)))]
        };
        occlusion.add_chain(wall(1.0, -0.5, 0.1).iter());
        occlusion.add_chain(wall(2.0, 0.1, 1.0).iter());
        occlusion.advance(1.5);
        assert!(occlusion.covers(-0.2, 0.05));
        assert!(!occlusion.covers(-0.2, 0.2));
        occlusion.advance(3.0);
        assert!(occlusion.covers(-0.3, 0.3));
        assert!(!occlusion.covers(-0.3, 0.4));
    }

    #[test]
    fn a_chain_behind_or_through_the_eye_covers_nothing() {
        let mut occlusion = Occlusion::new(Point::origin(), Vector::x(), 1e-6);
        let edge = |a: (f64, f64), b: (f64, f64)| {
            [Edge::Segment(Segment::new(Point::new(a.0, a.1), Point::new(b.0, b.1)))]
        };
        occlusion.add_chain(edge((-1.0, -1.0), (-1.0, 1.0)).iter());
        occlusion.add_chain(edge((0.0, 0.0), (1.0, 1.0)).iter());
        occlusion.add_chain(edge((1.0, -1.0), (-1.0, -1.0)).iter());
        occlusion.advance(100.0);
        assert!(occlusion.covered.is_empty());
    }
}
