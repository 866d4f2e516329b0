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
//! Where the published text is wrong or silent, and what is done here. Its visibility test decides proper crossings only,
//! so a diagonal through two corners passes: whether start and target see each other is decided by the exact planner
//! instead. "Exactly two global supports" holds outside the convex hull only: elsewhere the scan is refused. A common
//! support of both ends is the first vertex of both, which the scan finds as a way over one vertex. Holes do not
//! matter from outside. Cost: linear per kept vertex.

use crate::Refusal;
use traverse_geometry::{CornerStyle, Obstacle, Orientation, Path, Point, Ring, Scene, left_of, orientation};
use traverse_solve::{Budget, Interrupt};

/// A request that the published scan covers.
pub(crate) struct Scan {
    barrier: Vec<Point>,
    start: Point,
    target: Point,
}

impl Scan {
    /// # Errors
    /// [`Refusal::PublishedMethodNotApplicable`] for anything but one obstacle with straight edges that does not touch
    /// itself, mitred corners without a limit or clearance 0, no work area, and both ends outside the barrier's convex
    /// hull.
    pub(crate) fn of(scene: &Scene, start: Point, target: Point) -> Result<Self, Refusal> {
        let not = |why| Refusal::PublishedMethodNotApplicable { why };
        let obstacle = only_obstacle(scene).map_err(not)?;
        let barrier = control_points(obstacle.shape.outer(), scene.clearance_of(obstacle));
        let hull = convex_hull(&barrier);
        if [start, target].iter().any(|&end| !is_outside(&hull, end)) {
            return Err(not("start and target must lie outside the convex hull of the barrier"));
        }
        Ok(Self { barrier, start, target })
    }

    /// The candidates of the scan, the shortest first; where both ends see each other, the straight line alone.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn candidates(&self, see_each_other: bool, budget: &Budget) -> Result<Vec<Path>, Interrupt> {
        if see_each_other {
            return Ok(vec![path_through(&[self.start, self.target])]);
        }
        let mut candidates = Vec::new();
        for turn in [Turn::CounterClockwise, Turn::Clockwise] {
            candidates.extend(
                scan(&self.barrier, self.start, self.target, turn, budget)?.map(|way| path_through(&way)),
            );
        }
        candidates.sort_by(|a, b| a.length().total_cmp(&b.length()));
        Ok(candidates)
    }
}

fn only_obstacle(scene: &Scene) -> Result<&Obstacle, &'static str> {
    let [obstacle] = scene.obstacles.as_slice() else {
        return Err("the scene must hold exactly one obstacle");
    };
    let (outer, clearance) = (obstacle.shape.outer(), scene.clearance_of(obstacle));
    if scene.work_area.is_some() {
        return Err("it knows no work area");
    }
    if outer.has_arcs() {
        return Err("the obstacle's edges must be straight");
    }
    if outer.touches_itself() {
        return Err("the obstacle must not touch itself");
    }
    if clearance > 0.0 && scene.corner_style == CornerStyle::Round {
        return Err("corners must be mitred");
    }
    if clearance > 0.0 && matches!(scene.corner_style, CornerStyle::Miter { limit: Some(_) }) {
        return Err("it knows no mitre limit");
    }
    Ok(obstacle)
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

/// Start, kept vertices, target. None: the barrier has no support on that side.
fn scan(
    barrier: &[Point],
    start: Point,
    target: Point,
    turn: Turn,
    budget: &Budget,
) -> Result<Option<Vec<Point>>, Interrupt> {
    let n = barrier.len();
    // Towards the target the barrier lies on the same side; seen from there it is the other support.
    let (Some(first), Some(last)) = (support(barrier, start, turn), support_to(barrier, target, turn)) else {
        return Ok(None);
    };
    let step = |i: usize| match turn {
        Turn::CounterClockwise => (i + 1) % n,
        Turn::Clockwise => (i + n - 1) % n,
    };
    let mut left = vec![first];
    while left[left.len() - 1] != last {
        left.push(step(left[left.len() - 1]));
    }
    let mut points = vec![start, barrier[first]];
    let mut kept = 0;
    while kept + 1 < left.len() {
        budget.check(0)?;
        let here = barrier[left[kept]];
        // The vertex whose line from here has all that is left on one side; the farthest of several in line.
        let mut next = kept + 1;
        for candidate in kept + 2..left.len() {
            let (best, other) = (barrier[left[next]], barrier[left[candidate]]);
            let side = orientation(here, best, other);
            let farther = (other - here).norm_squared() >= (best - here).norm_squared();
            if side == turn.outside() || best == here || (side == Orientation::Straight && farther) {
                next = candidate;
            }
        }
        kept = next;
        points.push(barrier[left[kept]]);
    }
    points.push(target);
    points.dedup();
    Ok(Some(points))
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

/// The vertex whose line from `end` leaves no vertex on the `outside`; the nearest of several in line. None: `end` is
/// a vertex of the barrier, or lies within its hull.
fn supports(barrier: &[Point], end: Point, outside: Orientation) -> Option<usize> {
    let mut best = 0;
    for (i, &p) in barrier.iter().enumerate() {
        let side = orientation(end, barrier[best], p);
        let nearer = (p - end).norm_squared() < (barrier[best] - end).norm_squared();
        if side == outside || (side == Orientation::Straight && nearer) {
            best = i;
        }
    }
    let supports =
        barrier[best] != end && barrier.iter().all(|&p| orientation(end, barrier[best], p) != outside);
    supports.then_some(best)
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

/// Outside, not on the border.
fn is_outside(hull: &[Point], p: Point) -> bool {
    let n = hull.len();
    (0..n).any(|i| orientation(hull[i], hull[(i + 1) % n], p) == Orientation::Right)
}

fn path_through(points: &[Point]) -> Path {
    let mut path = Path::at(points[0]);
    points[1..].iter().for_each(|&p| path.line_to(p));
    path
}
