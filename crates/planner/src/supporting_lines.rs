//! The supporting-line scan round one obstacle, as published in 2008: the baseline that users compare with.
//!
//! The barrier is the polygon of control points V0…Vm, drawn parallel to the obstacle. Two points see each other
//! when no barrier edge crosses the segment between them properly (0 < α < 1 and 0 < β < 1 in the convex
//! combinations of both; parallel means that they see each other). A line globally supports the barrier at a vertex
//! when the whole barrier lies on one side of it. If start and target see each other, the straight line is the
//! answer; if a member of the start's global supports and of the target's is the same, or sees the other end, the
//! way goes over it; otherwise the barrier is scanned from the start's support counter-clockwise, keeping the
//! vertices whose line globally supports what is left, until a support of the target is reached (S1), the same
//! clockwise (S2), and the shorter is kept.
//!
//! From outside the convex hull there are exactly two global supports, so the published visibility test, which
//! passes diagonals through the inside, does no harm there. Cost: the square of the vertex count.

use crate::Refusal;
use traverse_geometry::{CornerStyle, Orientation, Path, Point, Ring, Scene, left_of, orientation};

/// The candidates of the scan, the shortest first: one where start and target see each other, otherwise two.
///
/// # Errors
/// [`Refusal::PublishedMethodNotApplicable`] for anything but one obstacle with straight edges, without holes,
/// mitred corners or clearance 0, no work area, and both ends outside the barrier's convex hull.
pub(crate) fn supporting_lines(scene: &Scene, start: Point, target: Point) -> Result<Vec<Path>, Refusal> {
    let not = |why| Refusal::PublishedMethodNotApplicable { why };
    let [obstacle] = scene.obstacles.as_slice() else {
        return Err(not("the scene must hold exactly one obstacle"));
    };
    let clearance = scene.clearance_of(obstacle);
    if scene.work_area.is_some() {
        return Err(not("it knows no work area"));
    }
    if obstacle.shape.outer().has_arcs() {
        return Err(not("the obstacle's edges must be straight"));
    }
    if clearance > 0.0 && scene.corner_style == CornerStyle::Round {
        return Err(not("corners must be mitred"));
    }
    if clearance > 0.0 && matches!(scene.corner_style, CornerStyle::Miter { limit: Some(_) }) {
        return Err(not("it knows no mitre limit"));
    }
    let barrier = control_points(obstacle.shape.outer(), clearance);
    let hull = convex_hull(&barrier);
    for end in [start, target] {
        if !is_outside(&hull, end) {
            return Err(not("start and target must lie outside the convex hull of the barrier"));
        }
    }
    if sees(&barrier, start, target) {
        return Ok(vec![path_through(&[start, target])]);
    }
    let mut candidates: Vec<Path> = [Turn::CounterClockwise, Turn::Clockwise]
        .into_iter()
        .filter_map(|turn| scan(&barrier, start, target, turn))
        .map(|points| path_through(&points))
        .collect();
    candidates.sort_by(|a, b| a.length().total_cmp(&b.length()));
    Ok(candidates)
}

/// In which sense the barrier is scanned; counter-clockwise keeps it on the left.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    CounterClockwise,
    Clockwise,
}

impl Turn {
    /// The side on which no vertex may lie.
    fn outside(self) -> Orientation {
        match self {
            Self::CounterClockwise => Orientation::Right,
            Self::Clockwise => Orientation::Left,
        }
    }
}

/// Start, kept vertices, target.
fn scan(barrier: &[Point], start: Point, target: Point, turn: Turn) -> Option<Vec<Point>> {
    let n = barrier.len();
    let first = support(barrier, start, turn)?;
    // Towards the target the barrier lies on the same side; seen from there it is the other support.
    let last = support_to(barrier, target, turn)?;
    let step = |i: usize| match turn {
        Turn::CounterClockwise => (i + 1) % n,
        Turn::Clockwise => (i + n - 1) % n,
    };
    let mut left = vec![first];
    let mut at = first;
    while at != last {
        at = step(at);
        left.push(at);
        if left.len() > n {
            return None;
        }
    }
    let mut points = vec![start, barrier[first]];
    let mut kept = 0;
    while left[kept] != last {
        let here = barrier[left[kept]];
        // The vertex whose line from here has all that is left on one side; the farthest of several in line.
        kept = (kept + 1..left.len()).rev().find(|&candidate| {
            let there = barrier[left[candidate]];
            there != here
                && left[kept + 1..]
                    .iter()
                    .all(|&other| orientation(here, there, barrier[other]) != turn.outside())
        })?;
        points.push(barrier[left[kept]]);
    }
    points.push(target);
    points.dedup();
    Some(points)
}

/// The vertex at which a line from `end` globally supports the barrier, which lies on its inner side.
fn support(barrier: &[Point], end: Point, turn: Turn) -> Option<usize> {
    supports(barrier, end, turn.outside())
}

/// The vertex at which a line to `end` globally supports the barrier.
fn support_to(barrier: &[Point], end: Point, turn: Turn) -> Option<usize> {
    let outside = match turn {
        Turn::CounterClockwise => Orientation::Left,
        Turn::Clockwise => Orientation::Right,
    };
    supports(barrier, end, outside)
}

/// The vertex whose line from `end` leaves no vertex on the `outside`; the nearest of several in line.
fn supports(barrier: &[Point], end: Point, outside: Orientation) -> Option<usize> {
    (0..barrier.len())
        .filter(|&i| barrier[i] != end && barrier.iter().all(|&p| orientation(end, barrier[i], p) != outside))
        .min_by(|&i, &j| (barrier[i] - end).norm().total_cmp(&(barrier[j] - end).norm()))
}

/// No barrier edge crosses the segment properly.
fn sees(barrier: &[Point], a: Point, b: Point) -> bool {
    let n = barrier.len();
    (0..n).all(|i| !crosses_properly(a, b, barrier[i], barrier[(i + 1) % n]))
}

fn crosses_properly(a: Point, b: Point, c: Point, d: Point) -> bool {
    let apart =
        |p: Orientation, q: Orientation| p != Orientation::Straight && q != Orientation::Straight && p != q;
    apart(orientation(a, b, c), orientation(a, b, d)) && apart(orientation(c, d, a), orientation(c, d, b))
}

/// Where the parallels at `clearance` of neighbouring edges meet, counter-clockwise.
fn control_points(ring: &Ring, clearance: f64) -> Vec<Point> {
    let turned;
    let ring = if ring.is_counter_clockwise() {
        ring
    } else {
        turned = ring.reversed();
        &turned
    };
    let n = ring.len();
    if clearance == 0.0 {
        return ring.vertices().to_vec();
    }
    (0..n)
        .map(|i| {
            let before = ring.edge((i + n - 1) % n).direction_at(0.0);
            let after = ring.edge(i).direction_at(0.0);
            let vertex = ring.vertices()[i];
            let (n1, n2) = (-left_of(before), -left_of(after));
            // Both parallels: (x − vertex) · n = clearance.
            let opening = 1.0 + n1.dot(&n2);
            if opening > 1e-12 { vertex + (n1 + n2) * (clearance / opening) } else { vertex + n1 * clearance }
        })
        .collect()
}

/// Convex hull, counter-clockwise, without collinear points (monotone chain, A. M. Andrew 1979).
fn convex_hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = chain.as_slice() {
                if orientation(*a, *b, p) == Orientation::Left {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}

/// Outside or on the border, but not in line with a hull edge that it touches.
fn is_outside(hull: &[Point], p: Point) -> bool {
    let n = hull.len();
    (0..n).any(|i| orientation(hull[i], hull[(i + 1) % n], p) == Orientation::Right)
}

fn path_through(points: &[Point]) -> Path {
    let mut path = Path::at(points[0]);
    points[1..].iter().for_each(|&p| path.line_to(p));
    path
}
