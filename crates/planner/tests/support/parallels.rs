//! Mitred barriers drawn as polygons, and the visibility graph among their corners, by brute force. Every edge of a
//! border carries one piece: the edge, its parallel, and between them at a convex end the line to where the parallels
//! meet, elsewhere the perpendicular. Barrier is what the pieces and the material cover together. None of the
//! planner's code: lines are crossed and points located here again.

use traverse_geometry::{CornerStyle, MITER_RATIO_LIMIT, Point, Polygon, Ring, Scene};

type P = (f64, f64);

/// What lies less deep in a piece than this touches it, millimetres.
const TOUCH_MM: f64 = 1e-7;

/// A region by the parity of crossings with its rings.
struct Piece {
    edges: Vec<[P; 2]>,
    /// Whether what lies outside the rings is covered.
    is_inverted: bool,
    /// Least and greatest coordinates.
    bounds: [P; 2],
}

/// The barriers of a scene of straight edges.
pub struct Drawn {
    pieces: Vec<Piece>,
    /// Where a path may bend.
    corners: Vec<P>,
}

impl Drawn {
    /// # Panics
    /// If corners are round.
    pub fn of(scene: &Scene) -> Self {
        let CornerStyle::Miter { limit } = scene.corner_style else { panic!("mitred corners") };
        let limit = limit.unwrap_or(MITER_RATIO_LIMIT);
        let mut drawn = Self { pieces: Vec::new(), corners: Vec::new() };
        for obstacle in &scene.obstacles {
            drawn.add(&obstacle.shape, true, scene.clearance_of(obstacle), limit);
        }
        if let Some(area) = &scene.work_area {
            drawn.add(area, false, scene.work_area_clearance_mm.unwrap_or(scene.clearance_mm), limit);
        }
        let corners = std::mem::take(&mut drawn.corners);
        drawn.corners = corners.into_iter().filter(|&corner| !drawn.covers(corner)).collect();
        drawn
    }

    /// The material of a polygon, and what its edges carry.
    fn add(&mut self, shape: &Polygon, is_material: bool, clearance: f64, limit: f64) {
        let rings = || shape.rings().map(points_of);
        self.pieces.push(Piece::new(rings().flat_map(|ring| edges_of(&ring)).collect(), !is_material));
        for (index, mut ring) in rings().enumerate() {
            // Material on the left: counter-clockwise round it, clockwise round what it leaves free.
            if (area(&ring) > 0.0) != ((index == 0) == is_material) {
                ring.reverse();
            }
            if clearance == 0.0 {
                self.corners.extend(ring);
                continue;
            }
            let edges = edges_of(&ring);
            for (i, &[a, b]) in edges.iter().enumerate() {
                let before = edges[(i + edges.len() - 1) % edges.len()];
                let after = edges[(i + 1) % edges.len()];
                // What lies at the beginning is what lies at the end of the edge run backwards, mirrored.
                let mirror = |p: P| (-p.0, p.1);
                let at_start = end_of_parallel(
                    [mirror(b), mirror(a)],
                    [mirror(before[1]), mirror(before[0])],
                    clearance,
                    limit,
                );
                let at_end = end_of_parallel([a, b], after, clearance, limit);
                let outer = at_start.into_iter().map(mirror).rev().chain(at_end);
                let outer: Vec<P> = outer.collect();
                self.corners.extend(&outer);
                let around: Vec<P> = [b, a].into_iter().chain(outer).collect();
                self.pieces.push(Piece::new(edges_of(&around), false));
            }
        }
    }

    /// Whether a point lies within a barrier.
    pub fn covers(&self, p: P) -> bool {
        self.pieces.iter().any(|piece| piece.covers(p))
    }

    fn sees(&self, p: P, q: P) -> bool {
        !self.pieces.iter().any(|piece| piece.meets(p, q))
    }

    /// The length of the shortest path, infinite when there is none.
    pub fn shortest(&self, start: P, target: P) -> f64 {
        let nodes: Vec<P> = [start, target].into_iter().chain(self.corners.iter().copied()).collect();
        let mut best = vec![f64::INFINITY; nodes.len()];
        let mut is_done = vec![false; nodes.len()];
        best[0] = 0.0;
        loop {
            let open = (0..nodes.len()).filter(|&i| !is_done[i]);
            let Some(at) = open.min_by(|&i, &j| best[i].total_cmp(&best[j])) else { return best[1] };
            if at == 1 || best[at].is_infinite() {
                return best[1];
            }
            is_done[at] = true;
            for next in 0..nodes.len() {
                let cost = best[at] + length(minus(nodes[next], nodes[at]));
                if cost < best[next] && self.sees(nodes[at], nodes[next]) {
                    best[next] = cost;
                }
            }
        }
    }
}

/// The corners at the end of the edge's parallel, as the border to the right of the edge runs on: where it meets the parallel
/// of the next edge; where that is further away than `limit` clearances, the ends of half of the square cut; the foot
/// of the perpendicular where the border turns away.
fn end_of_parallel(edge: [P; 2], next: [P; 2], clearance: f64, limit: f64) -> Vec<P> {
    let along = unit(minus(edge[1], edge[0]));
    let after = unit(minus(next[1], next[0]));
    let (out, out_after) = ((along.1, -along.0), (after.1, -after.0));
    let vertex = edge[1];
    let foot = plus(vertex, out, clearance);
    if cross(along, after) <= 0.0 {
        return vec![foot];
    }
    let to_meeting = clearance * (1.0 - dot(out, out_after)) / dot(along, out_after);
    let meeting = plus(foot, along, to_meeting);
    let far = length(minus(meeting, vertex));
    if far <= limit * clearance {
        return vec![meeting];
    }
    let middle = unit(minus(meeting, vertex));
    let to_cut = (limit * clearance - clearance * dot(out, middle)) / dot(along, middle);
    vec![plus(foot, along, to_cut), plus(vertex, middle, limit * clearance)]
}

impl Piece {
    fn new(edges: Vec<[P; 2]>, is_inverted: bool) -> Self {
        let all = || edges.iter().map(|edge| edge[0]);
        let least = all().fold((f64::INFINITY, f64::INFINITY), |m, p| (m.0.min(p.0), m.1.min(p.1)));
        let most = all().fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |m, p| (m.0.max(p.0), m.1.max(p.1)));
        let everywhere = [(f64::NEG_INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::INFINITY)];
        Self { is_inverted, bounds: if is_inverted { everywhere } else { [least, most] }, edges }
    }

    /// Whether `p` lies inside, and not on the border.
    fn covers(&self, p: P) -> bool {
        let crosses = |&&[a, b]: &&[P; 2]| {
            (a.1 > p.1) != (b.1 > p.1) && cross(minus(b, a), minus(p, a)) * (b.1 - a.1) > 0.0
        };
        let is_within = self.edges.iter().filter(crosses).count() % 2 == 1;
        is_within != self.is_inverted && self.edges.iter().all(|edge| distance(p, edge) > TOUCH_MM)
    }

    /// Whether a part of the straight move lies inside. It enters and leaves where it crosses the lines of edges.
    fn meets(&self, p: P, q: P) -> bool {
        let [least, most] = self.bounds;
        if p.0.max(q.0) < least.0 || p.0.min(q.0) > most.0 || p.1.max(q.1) < least.1 || p.1.min(q.1) > most.1
        {
            return false;
        }
        let by = minus(q, p);
        let mut cuts = vec![0.0, 1.0];
        for &[a, b] in &self.edges {
            let edge = minus(b, a);
            cuts.push(cross(minus(a, p), edge) / cross(by, edge));
            cuts.push(dot(minus(a, p), by) / dot(by, by));
        }
        cuts.retain(|cut| (0.0..=1.0).contains(cut));
        cuts.sort_by(f64::total_cmp);
        cuts.windows(2).any(|pair| self.covers(plus(p, by, (pair[0] + pair[1]) / 2.0)))
    }
}

fn points_of(ring: &Ring) -> Vec<P> {
    ring.vertices().iter().map(|p: &Point| (p.x, p.y)).collect()
}

fn edges_of(ring: &[P]) -> Vec<[P; 2]> {
    (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]).collect()
}

fn area(ring: &[P]) -> f64 {
    edges_of(ring).iter().map(|&[a, b]| cross(a, b) / 2.0).sum()
}

fn minus(a: P, b: P) -> P {
    (a.0 - b.0, a.1 - b.1)
}

fn plus(p: P, by: P, times: f64) -> P {
    (p.0 + by.0 * times, p.1 + by.1 * times)
}

fn dot(a: P, b: P) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

fn cross(a: P, b: P) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

fn length(v: P) -> f64 {
    v.0.hypot(v.1)
}

fn unit(v: P) -> P {
    (v.0 / length(v), v.1 / length(v))
}

/// From a point to an edge.
fn distance(p: P, &[a, b]: &[P; 2]) -> f64 {
    let edge = minus(b, a);
    let share = (dot(minus(p, a), edge) / dot(edge, edge)).clamp(0.0, 1.0);
    length(minus(p, plus(a, edge, share)))
}
