//! The curve through given points that CAD programs draw for a SPLINE without control points.
//!
//! A cubic curve in pieces between the points whose parameter is the length of the chords (Piegl and Tiller, The NURBS
//! Book, 9.2), with continuous second derivative. Where a direction at an end is given, it leaves or arrives along
//! it, at unit speed; where none is given, its second derivative is zero there. A closed one has continuous first and
//! second derivative where it closes as well. Cost: linear.

use super::spline::Spline;
use traverse_geometry::{Point, Vector};

/// The curve as a B-spline with a threefold knot at each point; none for less than two different points.
///
/// A `tangents` entry of zero is none; of others the length doesn't matter.
pub(super) fn curve_through(points: &[Point], tangents: [Vector; 2], closed: bool) -> Option<Spline> {
    let mut points = points.to_vec();
    points.dedup();
    let cyclic = closed && tangents == [Vector::zeros(); 2];
    if closed && points.first() != points.last() {
        points.extend(points.first().copied());
    }
    if points.len() < 2 {
        return None;
    }
    let chords: Vec<Vector> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let lengths: Vec<f64> = chords.iter().map(Vector::norm).collect();
    let speeds = if cyclic && chords.len() > 1 {
        cyclic_speeds(&chords, &lengths)
    } else {
        open_speeds(&chords, &lengths, tangents.map(|tangent| tangent.try_normalize(0.0)))
    };
    let mut controls = vec![points[0]];
    let (mut at, mut knots) = (0.0, vec![0.0; 4]);
    for (i, &length) in lengths.iter().enumerate() {
        let (start, end) = (points[i], points[i + 1]);
        controls.extend([start + speeds[i] * (length / 3.0), end - speeds[i + 1] * (length / 3.0), end]);
        at += length;
        knots.extend([at; 3]);
    }
    knots.push(at);
    Some(Spline { degree: 3, points: controls, knots, closed, ..Spline::default() })
}

/// One row of the equations for the derivatives: below·m₋ + middle·m + above·m₊ = right.
#[derive(Clone, Copy)]
struct Row {
    below: f64,
    middle: f64,
    above: f64,
    right: Vector,
}

/// Second derivatives on both sides of the point between two chords agree.
fn inner_row(before: (Vector, f64), after: (Vector, f64)) -> Row {
    let ((chord_before, h), (chord_after, k)) = (before, after);
    let right = (chord_before * (k / h) + chord_after * (h / k)) * 3.0;
    Row { below: k, middle: 2.0 * (h + k), above: h, right }
}

fn open_speeds(chords: &[Vector], lengths: &[f64], tangents: [Option<Vector>; 2]) -> Vec<Vector> {
    let spans: Vec<(Vector, f64)> = chords.iter().copied().zip(lengths.iter().copied()).collect();
    let end_row = |tangent: Option<Vector>, chord: Vector, length: f64| match tangent {
        Some(right) => Row { below: 0.0, middle: 1.0, above: 0.0, right },
        None => Row { below: 1.0, middle: 2.0, above: 1.0, right: chord * (3.0 / length) },
    };
    let last = spans.len() - 1;
    let mut rows = vec![end_row(tangents[0], chords[0], lengths[0])];
    rows.extend(spans.windows(2).map(|pair| inner_row(pair[0], pair[1])));
    rows.push(end_row(tangents[1], chords[last], lengths[last]));
    solve(&rows)
}

/// The same without ends; the last value repeats the first. By Sherman and Morrison: the two corners of the cyclic
/// equations are taken out and put back by a second solution.
fn cyclic_speeds(chords: &[Vector], lengths: &[f64]) -> Vec<Vector> {
    let count = chords.len();
    let span = |i: usize| (chords[i % count], lengths[i % count]);
    let mut rows: Vec<Row> = (0..count).map(|i| inner_row(span(i + count - 1), span(i))).collect();
    let (first, last) = (rows[0], rows[count - 1]);
    // The corners: `first.below` in the last column, `last.above` in the first one.
    let gamma = -first.middle;
    rows[0].middle -= gamma;
    rows[count - 1].middle -= last.above * first.below / gamma;
    let plain = solve(&rows);
    let mut unit_rows = rows;
    for row in &mut unit_rows {
        row.right = Vector::zeros();
    }
    unit_rows[0].right = Vector::repeat(gamma);
    unit_rows[count - 1].right += Vector::repeat(last.above);
    let correction = solve(&unit_rows);
    let share = first.below / gamma;
    let along = |values: &[Vector]| values[0] + values[count - 1] * share;
    let factor = along(&plain).component_div(&(Vector::repeat(1.0) + along(&correction)));
    let mut speeds: Vec<Vector> =
        plain.iter().zip(&correction).map(|(p, c)| p - c.component_mul(&factor)).collect();
    speeds.extend(speeds.first().copied());
    speeds
}

/// Solves equations that are strong on the diagonal, ignoring what stands outside the three diagonals (Thomas).
fn solve(rows: &[Row]) -> Vec<Vector> {
    let mut above: Vec<f64> = Vec::with_capacity(rows.len());
    let mut values: Vec<Vector> = Vec::with_capacity(rows.len());
    for (i, row) in rows.iter().enumerate() {
        let below = if i == 0 { 0.0 } else { row.below };
        let before = i.checked_sub(1).map_or((0.0, Vector::zeros()), |i| (above[i], values[i]));
        let pivot = row.middle - below * before.0;
        above.push(row.above / pivot);
        values.push((row.right - before.1 * below) / pivot);
    }
    for i in (0..rows.len().saturating_sub(1)).rev() {
        let next = values[i + 1];
        values[i] -= next * above[i];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Second derivative, by chord length, at the start and the end of piece `i`.
    fn bends(spline: &Spline, i: usize) -> (Vector, Vector) {
        let p = &spline.points[3 * i..3 * i + 4];
        let length = (p[3] - p[0]).norm();
        let second = |a: Point, b: Point, c: Point| ((c - b) - (b - a)) * (6.0 / (length * length));
        (second(p[0], p[1], p[2]), second(p[1], p[2], p[3]))
    }

    fn points() -> Vec<Point> {
        [(0.0, 0.0), (3.0, 5.0), (8.0, 4.0), (9.0, -2.0), (4.0, -3.0)].map(|(x, y)| Point::new(x, y)).to_vec()
    }

    #[test]
    fn bends_are_continuous_and_end_conditions_hold() {
        let start = Vector::new(0.0, 7.0);
        for tangents in [[Vector::zeros(); 2], [start, Vector::zeros()], [start, Vector::new(-1.0, 1.0)]] {
            let spline = curve_through(&points(), tangents, false).unwrap();
            for i in 0..3 {
                assert!((bends(&spline, i).1 - bends(&spline, i + 1).0).norm() < 1e-9);
            }
            if tangents[0] == start {
                assert!((spline.points[1] - spline.points[0]).x.abs() < 1e-12);
            } else {
                assert!(bends(&spline, 0).0.norm() < 1e-9);
            }
        }
    }

    #[test]
    fn a_closed_curve_bends_on_where_it_closes() {
        let spline = curve_through(&points(), [Vector::zeros(); 2], true).unwrap();
        assert_eq!(spline.points.first(), spline.points.last());
        for i in 0..5 {
            assert!((bends(&spline, i).1 - bends(&spline, (i + 1) % 5).0).norm() < 1e-9, "{i}");
        }
        let last = spline.points.len() - 1;
        let (leaves, arrives) =
            (spline.points[1] - spline.points[0], spline.points[last] - spline.points[last - 1]);
        assert!(leaves.perp(&arrives).abs() < 1e-9);
    }

    #[test]
    fn two_points_are_a_segment_and_one_is_nothing() {
        let points = points();
        let spline = curve_through(&points[..2], [Vector::zeros(); 2], false).unwrap();
        assert!((spline.points[1] - Point::new(1.0, 5.0 / 3.0)).norm() < 1e-12);
        assert_eq!(curve_through(&[points[0]; 3], [Vector::zeros(); 2], true), None);
    }
}
