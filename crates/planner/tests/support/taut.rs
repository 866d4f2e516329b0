//! All taut paths among circles that neither cross nor touch themselves, by brute force.

use super::oracle::Norm;
use std::f64::consts::TAU;
use traverse_geometry::Point;

/// An arc on this circle: the angle that it begins at and the turn, counter-clockwise.
type Bend = (usize, f64, f64);

/// Every sequence of circles and sides whose tangents and arcs are free and that
/// never turns back.
pub struct Taut<'a> {
    pub norm: Norm,
    pub circles: &'a [(Point, f64)],
    pub target: Point,
    /// What costs more is not looked for.
    pub limit: f64,
    /// What each costs, and its length.
    pub found: Vec<(f64, f64)>,
}

impl Taut<'_> {
    fn segment_is_free(&self, a: Point, b: Point) -> bool {
        self.circles.iter().all(|&(center, radius)| {
            let along = b - a;
            let at = ((center - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            (center - (a + along * at)).norm() >= radius - 5e-7
        })
    }

    fn arc_is_free(&self, on: usize, from: f64, turn: f64) -> bool {
        let (center, radius) = self.circles[on];
        let count = 2 + (turn.abs() * 200.0) as usize;
        (0..=count).all(|i| {
            let p = center + traverse_geometry::unit(from + turn * i as f64 / count as f64) * radius;
            self.circles.iter().all(|&(center, radius)| (p - center).norm() >= radius - 5e-7)
        })
    }

    /// All of them, cheapest first, each once: a bend of no turn is found with and without it.
    pub fn all(mut self, start: Point) -> Vec<f64> {
        self.go(start, None, (0.0, 0.0), (&[start], &[]), 14);
        self.found.sort_by(|a, b| a.1.total_cmp(&b.1));
        self.found.dedup_by(|a, b| (a.0 - b.0).abs() < 1e-7 && (a.1 - b.1).abs() < 1e-7);
        self.found.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.found.iter().map(|found| found.0).collect()
    }

    /// Goes on from `at`, on circle `on` with its side and the direction of arrival there; `line` and `bends`: what was
    /// passed.
    fn go(
        &mut self,
        at: Point,
        on: Option<(usize, f64)>,
        (cost, length): (f64, f64),
        (line, bends): (&[Point], &[Bend]),
        depth: usize,
    ) {
        let options = (0..self.circles.len()).flat_map(|i| [(Some(i), 1.0), (Some(i), -1.0)]);
        for (next, side) in options.chain([(None, 1.0)]) {
            let (center, radius) = next.map_or((self.target, 0.0), |i| self.circles[i]);
            let (from_center, from_radius) =
                on.map_or((at, 0.0), |(i, side)| (self.circles[i].0, self.circles[i].1 * side));
            let axis = center - from_center;
            let across = radius * side - from_radius;
            if next.is_some() && next == on.map(|on| on.0) || axis.norm() <= across.abs() {
                continue;
            }
            let angle = axis.y.atan2(axis.x) + TAU / 4.0 - (across / axis.norm()).asin();
            let normal = traverse_geometry::unit(angle);
            let (leaves, arrives) = (from_center - normal * from_radius, center - normal * radius * side);
            let (mut passed, mut bent) = (line.to_vec(), bends.to_vec());
            let by = arrives - leaves;
            let (mut more, mut longer) = (self.norm.straight((by.x, by.y)), by.norm());
            if let Some((i, side)) = on {
                let (center, radius) = self.circles[i];
                let angle_of = |p: Point| (p.y - center.y).atan2(p.x - center.x);
                let mut turn = ((angle_of(leaves) - angle_of(at)) * side).rem_euclid(TAU);
                if turn > TAU - 1e-7 {
                    turn = 0.0;
                }
                if !self.arc_is_free(i, angle_of(at), turn * side) {
                    continue;
                }
                let from = angle_of(at) - if side < 0.0 { turn } else { 0.0 };
                if bends.iter().any(|other| meet(other, &(i, from, turn))) {
                    continue;
                }
                bent.push((i, from, turn));
                more += self.norm.arc(radius, from, turn);
                longer += radius * turn;
                let count = 1 + (turn * 60.0) as usize;
                passed.extend((1..=count).map(|k| {
                    center
                        + traverse_geometry::unit(angle_of(at) + turn * side * k as f64 / count as f64)
                            * radius
                }));
            }
            passed.push(arrives);
            let rest = self.target - arrives;
            if cost + more + self.norm.straight((rest.x, rest.y)) > self.limit
                || !self.segment_is_free(leaves, arrives)
                || crosses_itself(&passed, line.len())
            {
                continue;
            }
            match next {
                None => self.found.push((cost + more, length + longer)),
                Some(i) if depth > 0 => {
                    self.go(
                        arrives,
                        Some((i, side)),
                        (cost + more, length + longer),
                        (&passed, &bent),
                        depth - 1,
                    );
                }
                Some(_) => panic!("paths of more bends than expected"),
            }
        }
    }
}

/// Whether two arcs have a point in common. Two ways round one circle do not cross where they run along it: one of them can
/// be moved aside. They touch.
fn meet(a: &Bend, b: &Bend) -> bool {
    a.0 == b.0 && ((b.1 - a.1).rem_euclid(TAU) <= a.2 || (a.1 - b.1).rem_euclid(TAU) <= b.2)
}

/// Whether any of the line's segments from `new` on crosses an earlier one.
fn crosses_itself(line: &[Point], new: usize) -> bool {
    let crossing = |a: Point, b: Point, c: Point, d: Point| {
        let side = |p: Point, q: Point, r: Point| traverse_geometry::cross(q - p, r - p);
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    };
    (new..line.len())
        .any(|i| (1..i.saturating_sub(1)).any(|j| crossing(line[i - 1], line[i], line[j - 1], line[j])))
}
