//! B-splines as Bézier curves, one for each stretch between two knots.
//!
//! The control points of a stretch are values of the B-spline's blossom (Ramshaw 1987): degree² steps each. Corners
//! can be at knots only, so every piece is smooth.

use super::affine::Affine;
use super::spline::Spline;
use crate::fit::{CubicBezier, Smooth};
use traverse_geometry::{Point, Vector, left_of};

/// Largest degree that is read. CAD programs write 3 mostly, 11 at most.
pub(super) const LARGEST_DEGREE: usize = 11;

/// Knots that differ by less than this share of the whole are one knot that was rounded.
const KNOT_TOLERANCE: f64 = 1e-10;

/// Ends of neighbouring pieces must meet within this share of the spline's size.
const GAP: f64 = 1e-9;

/// A point times its weight, and the weight.
type Weighted = [f64; 3];

/// Knots without differences that come from rounding.
pub(super) fn without_rounding(mut knots: Vec<f64>) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (knots.first(), knots.last()) else { return knots };
    let mut before = first;
    for knot in &mut knots {
        if (*knot - before).abs() <= KNOT_TOLERANCE * (last - first) {
            *knot = before;
        }
        before = *knot;
    }
    knots
}

/// Whether degree, knots, weights and control points belong together.
pub(super) fn is_consistent(spline: &Spline) -> bool {
    let (degree, count) = (spline.degree, spline.points.len());
    let knots = &spline.knots;
    (1..=LARGEST_DEGREE).contains(&degree)
        && count > degree
        && knots.len() == count + degree + 1
        && knots.iter().all(|knot| knot.is_finite())
        && knots.windows(2).all(|pair| pair[0] <= pair[1])
        && knots[degree] < knots[count]
        && (spline.weights.is_empty() || spline.weights.len() == count)
        && spline.weights.iter().all(|&weight| weight > 0.0 && weight.is_finite())
        && !is_torn(spline)
}

/// The pieces of a consistent spline in order, each beginning where the one before ends.
pub(super) fn pieces(spline: &Spline) -> impl Iterator<Item = Bezier> + '_ {
    let degree = spline.degree;
    let rational = !spline.weights.is_empty();
    let weighted: Vec<Weighted> = spline
        .points
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let weight = spline.weights.get(i).copied().unwrap_or(1.0);
            [p.x * weight, p.y * weight, weight]
        })
        .collect();
    let stretches = spline.knots.windows(2).enumerate().take(spline.points.len()).skip(degree);
    stretches.filter(|(_, pair)| pair[0] < pair[1]).map(move |(i, _)| {
        let mut piece = Bezier { degree, rational, points: [[0.0; 3]; LARGEST_DEGREE + 1] };
        for (at_end, point) in piece.points.iter_mut().enumerate().take(degree + 1) {
            *point = blossom(&spline.knots, &weighted[i - degree..=i], i, at_end);
            if !rational {
                point[2] = 1.0;
            }
        }
        piece
    })
}

/// Whether a piece does not begin where the one before ends: at a knot that is there more often than its degree.
fn is_torn(spline: &Spline) -> bool {
    let inner = &spline.knots[1..spline.knots.len() - 1];
    if inner.windows(spline.degree + 1).all(|knots| knots[0] < knots[spline.degree]) {
        return false;
    }
    let size = spline.points.iter().map(|p| (p - spline.points[0]).norm()).fold(0.0, f64::max);
    let mut end = None;
    pieces(spline).any(|piece| {
        let before = end.replace(piece.point(1.0));
        before.is_some_and(|before: Point| (before - piece.point(0.0)).norm() > GAP * size)
    })
}

/// The blossom of the stretch from knot `i` on, at its start and, for `at_end` of its arguments, at its end.
fn blossom(knots: &[f64], controls: &[Weighted], i: usize, at_end: usize) -> Weighted {
    let degree = controls.len() - 1;
    let mut points = [[0.0; 3]; LARGEST_DEGREE + 1];
    points[..=degree].copy_from_slice(controls);
    for round in 1..=degree {
        let at = if round <= at_end { knots[i + 1] } else { knots[i] };
        for j in (round..=degree).rev() {
            let (low, high) = (knots[i - degree + j], knots[i + 1 + j - round]);
            let share = (at - low) / (high - low);
            points[j] = mix(points[j - 1], points[j], share);
        }
    }
    points[degree]
}

/// A Bézier curve, rational or not.
#[derive(Clone, Debug)]
pub(super) struct Bezier {
    degree: usize,
    /// Whether weights differ; they are all 1 otherwise.
    rational: bool,
    /// One more than its degree are used.
    points: [Weighted; LARGEST_DEGREE + 1],
}

impl Bezier {
    /// A circular arc by its ends and tan(sweep / 4), mapped by `map`: it stays well conditioned however flat it is.
    /// It must turn by much less than half a turn.
    pub(super) fn of_arc(start: Point, end: Point, bulge: f64, map: &Affine) -> Self {
        let height = bulge / (1.0 - bulge * bulge);
        let corner = (start + (end - start) / 2.0) - left_of(end - start) * height;
        let weight = (1.0 - bulge * bulge) / (1.0 + bulge * bulge);
        let mut points = [[0.0; 3]; LARGEST_DEGREE + 1];
        for (point, (p, weight)) in points.iter_mut().zip([(start, 1.0), (corner, weight), (end, 1.0)]) {
            let p = map.point(p);
            *point = [p.x * weight, p.y * weight, weight];
        }
        Self { degree: 2, rational: true, points }
    }

    /// The same as a cubic curve, which takes a fraction of the time; none when it is none.
    pub(super) fn as_cubic(&self) -> Option<CubicBezier> {
        if self.rational {
            return None;
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| plain(self.points[i]));
        match self.degree {
            1 => Some(CubicBezier::new(a, a + (b - a) / 3.0, b - (b - a) / 3.0, b)),
            2 => Some(CubicBezier::from_quadratic(a, b, c)),
            3 => Some(CubicBezier::new(a, b, c, d)),
            _ => None,
        }
    }

    /// The two points that the last step of de Casteljau's scheme mixes.
    fn last_step(&self, t: f64) -> [Weighted; 2] {
        let mut points = self.points;
        for count in (2..=self.degree).rev() {
            for j in 0..count {
                points[j] = mix(points[j], points[j + 1], t);
            }
        }
        [points[0], points[1]]
    }
}

impl Smooth for Bezier {
    fn point(&self, t: f64) -> Point {
        self.at(t).0
    }

    fn at(&self, t: f64) -> (Point, Vector) {
        let [a, b] = self.last_step(t);
        let at = mix(a, b, t);
        (plain(at), (plain(b) - plain(a)) * (self.degree as f64 * a[2] * b[2] / (at[2] * at[2])))
    }
}

fn mix(a: Weighted, b: Weighted, share: f64) -> Weighted {
    [0, 1, 2].map(|i| a[i] * (1.0 - share) + b[i] * share)
}

fn plain([x, y, weight]: Weighted) -> Point {
    Point::new(x / weight, y / weight)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of the unit circle, then one more, as a rational quadratic spline.
    fn half_circle() -> Spline {
        let root = std::f64::consts::FRAC_1_SQRT_2;
        Spline {
            degree: 2,
            points: [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (-1.0, 0.0)]
                .map(|(x, y)| Point::new(x, y))
                .to_vec(),
            weights: vec![1.0, root, 1.0, root, 1.0],
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0],
            closed: false,
            climbs: false,
        }
    }

    #[test]
    fn a_rational_spline_is_a_circle() {
        let spline = half_circle();
        let pieces: Vec<_> = pieces(&spline).collect();
        assert_eq!(pieces.len(), 2);
        for piece in &pieces {
            for i in 0..=20 {
                let t = f64::from(i) / 20.0;
                let (p, d) = piece.at(t);
                assert!((p.coords.norm() - 1.0).abs() < 1e-14);
                assert!(p.coords.dot(&d).abs() < 1e-14 && p.coords.perp(&d) > 0.5);
            }
        }
    }

    #[test]
    fn a_spline_without_clamped_ends_begins_inside_its_knots() {
        // The uniform cubic B-spline: a piece begins at (a + 4 b + c) / 6.
        let points: Vec<Point> = [(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0), (0.0, 0.0)]
            .map(|(x, y)| Point::new(x, y))
            .to_vec();
        let knots = (0..9).map(f64::from).collect();
        let spline = Spline { degree: 3, points, knots, ..Spline::default() };
        assert!(is_consistent(&spline));
        let pieces: Vec<_> = pieces(&spline).collect();
        assert_eq!(pieces.len(), 2);
        assert!((pieces[0].point(0.0) - Point::new(5.0, 1.0)).norm() < 1e-12);
        assert!((pieces[1].as_cubic().unwrap().point(1.0) - Point::new(1.0, 5.0)).norm() < 1e-12);
    }

    #[test]
    fn what_contradicts_itself_is_seen() {
        let good = half_circle();
        assert!(is_consistent(&good));
        let broken = |change: fn(&mut Spline)| {
            let mut spline = good.clone();
            change(&mut spline);
            !is_consistent(&spline)
        };
        assert!(broken(|spline| spline.degree = 1000));
        assert!(broken(|spline| spline.degree = 0));
        assert!(broken(|spline| spline.knots[3] = -1.0));
        assert!(broken(|spline| spline.knots[7] = f64::INFINITY));
        assert!(broken(|spline| spline.knots.truncate(7)));
        assert!(broken(|spline| spline.points.truncate(4)));
        assert!(broken(|spline| spline.weights[1] = 0.0));
        assert!(broken(|spline| spline.weights.truncate(4)));
        assert!(broken(|spline| spline.knots.fill(1.0)));
    }

    #[test]
    fn a_torn_spline_is_seen() {
        let mut spline = half_circle();
        spline.points.insert(2, Point::new(0.0, 2.0));
        spline.weights.insert(2, 1.0);
        spline.knots.insert(3, 1.0);
        assert!(!is_consistent(&spline));
        spline.points[2] = Point::new(0.0, 1.0);
        assert!(is_consistent(&spline));
        assert_eq!(pieces(&spline).count(), 2);
    }
}
