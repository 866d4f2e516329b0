//! The brute-force tangent-point graph: every tangent point of every pair of circles is a node, every tangent that
//! keeps its distance and every stretch of arc between neighbouring nodes that does is an edge, Dijkstra does the
//! rest. No cones, no filters, no labels, none of the planner's code: distances are worked out here again.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

type P = (f64, f64);

/// Below a distance by less than this is contact.
const CONTACT: f64 = 5e-7;

/// What a path keeps away from: a segment (of length 0 for a point) by a distance.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    pub a: P,
    pub b: P,
    pub distance: f64,
}

/// What a path may bend round.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub center: P,
    pub radius: f64,
}

/// How a path is measured.
#[derive(Clone, Copy, Debug)]
pub enum Norm {
    Length,
    /// Seconds of the slower axis, by the speeds of X and Y.
    Axes(f64, f64),
}

impl Norm {
    pub fn straight(self, v: P) -> f64 {
        match self {
            Self::Length => length(v),
            Self::Axes(x, y) => f64::max(v.0.abs() / x, v.1.abs() / y),
        }
    }

    /// An arc from an angle on, counter-clockwise. Cut where the slower axis changes or one turns back, its parts cost what
    /// their chords cost.
    pub fn arc(self, radius: f64, from: f64, turn: f64) -> f64 {
        let Self::Axes(x, y) = self else { return radius * turn };
        let kink = (x / y).atan();
        let of_turn = (-1..=3).flat_map(|half| {
            let half = std::f64::consts::PI * f64::from(half);
            [half - kink, half, half + kink, half + std::f64::consts::FRAC_PI_2]
        });
        let mut cuts: Vec<f64> =
            of_turn.map(|angle| (angle - from).rem_euclid(TAU)).filter(|&at| at < turn).collect();
        cuts.extend([0.0, turn]);
        cuts.sort_by(f64::total_cmp);
        let at = |turned: f64| (radius * (from + turned).cos(), radius * (from + turned).sin());
        cuts.windows(2).map(|pair| self.straight(sub(at(pair[1]), at(pair[0])))).sum()
    }
}

/// The length of the shortest path from `s` to `t`, infinite when there is none.
pub fn shortest(s: P, t: P, circles: &[Circle], walls: &[Wall]) -> f64 {
    least(Norm::Length, s, t, circles, walls)
}

/// The cost of the best path from `s` to `t`, infinite when there is none.
pub fn least(norm: Norm, s: P, t: P, circles: &[Circle], walls: &[Wall]) -> f64 {
    let mut nodes: Vec<Node> = Vec::new();
    let ends = [Circle { center: s, radius: 0.0 }, Circle { center: t, radius: 0.0 }];
    let all: Vec<Circle> = ends.iter().chain(circles).copied().collect();
    for (i, end) in ends.iter().enumerate() {
        for side in [1.0, -1.0] {
            nodes.push(Node { circle: i, side, angle: 0.0, at: end.center });
        }
    }
    let mut edges: Vec<Vec<(usize, f64)>> =
        vec![vec![(1, 0.0)], vec![(0, 0.0)], vec![(3, 0.0)], vec![(2, 0.0)]];
    for i in 0..all.len() {
        for j in 0..all.len() {
            if i == j {
                continue;
            }
            for side_i in [1.0, -1.0] {
                for side_j in [1.0, -1.0] {
                    let Some((from, to)) = tangent(all[i], side_i, all[j], side_j) else { continue };
                    if walls.iter().any(|w| segment_distance(from, to, w.a, w.b) < w.distance - CONTACT) {
                        continue;
                    }
                    let a = node(&mut nodes, &mut edges, i, side_i, all[i], from);
                    let b = node(&mut nodes, &mut edges, j, side_j, all[j], to);
                    edges[a].push((b, norm.straight(sub(to, from))));
                }
            }
        }
    }
    for (circle, data) in all.iter().enumerate().skip(2) {
        for side in [1.0, -1.0] {
            link_arcs(norm, &mut edges, &nodes, circle, *data, side, walls);
        }
    }
    dijkstra(&edges).map_or(f64::INFINITY, |cost| cost)
}

struct Node {
    circle: usize,
    side: f64,
    angle: f64,
    at: P,
}

fn node(
    nodes: &mut Vec<Node>,
    edges: &mut Vec<Vec<(usize, f64)>>,
    circle: usize,
    side: f64,
    data: Circle,
    at: P,
) -> usize {
    if circle < 2 {
        return 2 * circle;
    }
    let spoke = sub(at, data.center);
    nodes.push(Node { circle, side, angle: spoke.1.atan2(spoke.0).rem_euclid(TAU), at });
    edges.push(Vec::new());
    nodes.len() - 1
}

/// Neighbouring tangent points of one circle and side are linked in the sense of travel where the arc is free.
fn link_arcs(
    norm: Norm,
    edges: &mut [Vec<(usize, f64)>],
    nodes: &[Node],
    circle: usize,
    data: Circle,
    side: f64,
    walls: &[Wall],
) {
    let mut on: Vec<usize> =
        (0..nodes.len()).filter(|&n| nodes[n].circle == circle && nodes[n].side == side).collect();
    on.sort_by(|&a, &b| nodes[a].angle.total_cmp(&nodes[b].angle));
    for k in 0..on.len() {
        let (a, b) = (on[k], on[(k + 1) % on.len()]);
        if a == b {
            continue;
        }
        let mut turn = nodes[b].angle - nodes[a].angle;
        if turn < 0.0 || k + 1 == on.len() {
            turn += TAU;
        }
        let same = turn * data.radius.max(1.0) < 1e-9 || (TAU - turn) * data.radius.max(1.0) < 1e-9;
        if same {
            // Rounding may have put equal points in either order.
            edges[a].push((b, 0.0));
            edges[b].push((a, 0.0));
            continue;
        }
        let samples = 2 + (turn * 40.0) as usize;
        let free = (0..=samples).all(|i| {
            let angle = nodes[a].angle + turn * (i as f64) / (samples as f64);
            let at = (data.center.0 + data.radius * angle.cos(), data.center.1 + data.radius * angle.sin());
            walls.iter().all(|w| point_distance(at, w.a, w.b) >= w.distance - CONTACT)
        });
        if free {
            let (from, to) = if side > 0.0 { (a, b) } else { (b, a) };
            edges[from].push((to, norm.arc(data.radius, nodes[a].angle, turn)));
        }
    }
}

fn dijkstra(edges: &[Vec<(usize, f64)>]) -> Option<f64> {
    let mut best = vec![f64::INFINITY; edges.len()];
    let mut open = BinaryHeap::new();
    best[0] = 0.0;
    open.push(Open(0.0, 0));
    while let Some(Open(cost, n)) = open.pop() {
        if n == 2 {
            return Some(cost);
        }
        if cost > best[n] {
            continue;
        }
        for &(next, step) in &edges[n] {
            if cost + step < best[next] {
                best[next] = cost + step;
                open.push(Open(best[next], next));
            }
        }
    }
    None
}

struct Open(f64, usize);
impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Open {}
impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0)
    }
}

/// From circle `a` to circle `b`, each on the left (+1) or right (−1) of the way.
fn tangent(a: Circle, side_a: f64, b: Circle, side_b: f64) -> Option<(P, P)> {
    let axis = sub(b.center, a.center);
    let d = length(axis);
    let across = b.radius * side_b - a.radius * side_a;
    if d < 1e-12 || across.abs() > d + 1e-6 {
        return None;
    }
    let base = axis.1.atan2(axis.0);
    let tilt = (across / d).clamp(-1.0, 1.0).asin();
    // Left normal of the direction of travel.
    let angle = base + std::f64::consts::FRAC_PI_2 - tilt;
    let n = (angle.cos(), angle.sin());
    let touch =
        |c: Circle, side: f64| (c.center.0 - n.0 * c.radius * side, c.center.1 - n.1 * c.radius * side);
    Some((touch(a, side_a), touch(b, side_b)))
}

fn sub(a: P, b: P) -> P {
    (a.0 - b.0, a.1 - b.1)
}

fn length(v: P) -> f64 {
    v.0.hypot(v.1)
}

fn turn(a: P, b: P) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

fn point_distance(p: P, a: P, b: P) -> f64 {
    let (v, w) = (sub(b, a), sub(p, a));
    let square = v.0 * v.0 + v.1 * v.1;
    let t = if square == 0.0 { 0.0 } else { ((w.0 * v.0 + w.1 * v.1) / square).clamp(0.0, 1.0) };
    length(sub(p, (a.0 + v.0 * t, a.1 + v.1 * t)))
}

fn segment_distance(p: P, q: P, a: P, b: P) -> f64 {
    let side = |o: P, d: P, x: P| turn(sub(d, o), sub(x, o));
    if side(p, q, a) * side(p, q, b) < 0.0 && side(a, b, p) * side(a, b, q) < 0.0 {
        return 0.0;
    }
    point_distance(p, a, b)
        .min(point_distance(q, a, b))
        .min(point_distance(a, p, q))
        .min(point_distance(b, p, q))
}
