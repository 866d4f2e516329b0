//! The area that a closed chain encloses, and whether it encloses any.
//!
//! The shoelace sum in double-double arithmetic (T. J. Dekker, A floating-point technique for extending the available
//! precision, 1971): a slit of 1 nm over 1 m, 20 m from the origin, still has the right sign. Cost: linear.

use crate::{Arc, Edge};

/// An unevaluated sum of two floats.
#[derive(Clone, Copy, Default)]
struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// a · b, exactly.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    fn plus(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let part = sum - self.high;
        let error = (self.high - (sum - part)) + (other.high - part);
        let low = error + self.low + other.low;
        let high = sum + low;
        Self { high, low: low - (high - sum) }
    }

    fn minus(self, other: Self) -> Self {
        self.plus(Self { high: -other.high, low: -other.low })
    }
}

/// Area of a closed chain, square millimetres, positive counter-clockwise, and the rounding error that it may carry.
pub(crate) fn signed_area(edges: impl Iterator<Item = Edge>) -> (f64, f64) {
    let (mut twice, mut caps, mut error) = (Double::default(), 0.0, 0.0);
    for edge in edges {
        let (a, b) = (edge.start(), edge.end());
        let (left, right) = (Double::product(a.x, b.y), Double::product(a.y, b.x));
        twice = twice.plus(left.minus(right));
        error += (left.high.abs() + right.high.abs()) * (8.0 * f64::EPSILON * f64::EPSILON);
        if let Edge::Arc(arc) = edge {
            let cap = cap_area(&arc);
            caps += cap;
            error += 16.0 * f64::EPSILON * cap.abs();
        }
    }
    (twice.high / 2.0 + caps, error)
}

/// The area between an arc and its chord, positive counter-clockwise.
fn cap_area(arc: &Arc) -> f64 {
    let sweep = arc.sweep;
    let square = sweep * sweep;
    // sweep − sin(sweep) loses its digits for small sweeps; there the series holds to the last bit.
    let excess = if sweep.abs() < 0.5 {
        let tail =
            [156.0, 110.0, 72.0, 42.0, 20.0].iter().fold(1.0, |tail, divisor| 1.0 - square / divisor * tail);
        sweep * square / 6.0 * tail
    } else {
        sweep - sweep.sin()
    };
    arc.radius * arc.radius * excess / 2.0
}

/// Whether all points lie on one point, or the edges enclose nothing that rounding could not explain.
pub(crate) fn encloses_nothing(edges: impl Iterator<Item = Edge>) -> bool {
    let (area, error) = signed_area(edges);
    area.abs() <= error
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Point, Ring};
    use std::f64::consts::PI;

    fn edges(points: &[(f64, f64)], bulges: &[f64]) -> Vec<Edge> {
        let at = |i: usize| Point::new(points[i % points.len()].0, points[i % points.len()].1);
        (0..points.len())
            .map(|i| Edge::from_bulge(at(i), at(i + 1), bulges.get(i).copied().unwrap_or(0.0)))
            .collect()
    }

    #[test]
    fn a_slit_far_out_has_its_area() {
        // 1 m long, the neighbouring float high, 20 m from the origin.
        let (low, high) = (20_000.0, 20_000.0_f64.next_up());
        let slit = edges(&[(20_000.0, low), (21_000.0, low), (21_000.0, high), (20_000.0, high)], &[]);
        let (area, error) = signed_area(slit.iter().copied());
        assert!((area / (1000.0 * (high - low)) - 1.0).abs() < 1e-6, "{area}");
        assert!(error < area);
    }

    #[test]
    fn antennas_enclose_nothing() {
        let star = [(0.1, 0.3), (7.7, 1.9), (0.1, 0.3), (-3.3, 8.1), (0.1, 0.3), (2.2, -6.4)];
        assert!(encloses_nothing(edges(&star, &[]).into_iter()));
        assert!(encloses_nothing(edges(&[(0.1, 0.3), (7.7, 1.9)], &[0.37, -0.37]).into_iter()));
    }

    #[test]
    fn caps_agree_on_both_sides_of_the_series() {
        for bulge in [1e-6, 0.01, 0.1244, 0.1266, 0.5, 1.0] {
            let arc = Arc::from_bulge(Point::new(0.0, 0.0), Point::new(1.0, 0.0), bulge);
            let steps = 20_000;
            let fine: f64 = (0..steps)
                .map(|i| {
                    let x = (f64::from(i) + 0.5) / f64::from(steps);
                    let half = x - 0.5;
                    ((arc.radius - half) * (arc.radius + half)).sqrt() - arc.center.y.abs()
                })
                .sum::<f64>()
                / f64::from(steps);
            assert!((cap_area(&arc) - fine).abs() < 1e-6 + 1e-4 * fine, "bulge {bulge}");
        }
    }

    #[test]
    fn a_circle_has_its_area() {
        let ring = Ring::new(vec![Point::new(-2.0, 1.0), Point::new(2.0, 1.0)], vec![1.0, 1.0]).unwrap();
        assert!((ring.signed_area() - 4.0 * PI).abs() < 1e-12);
    }
}
