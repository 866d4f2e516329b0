//! At clearance 0: whether a path passes between obstacles, or parts of one, that touch.
//!
//! A path is legal when a path that stays within the tolerance of it touches nothing. That fails exactly when, in
//! the corridor within the tolerance, something connected reaches from the left wall to the right one: an edge that
//! crosses it (an antenna, or a plate thinner than the tolerance), or edges on both sides that touch each other.
//! Edges are cut to their parts in the corridor, joined where they touch, and each connected group asked which walls
//! it reaches. Material matters only where edges run out through an end of the corridor: there the outermost ones
//! reach a wall if what lies between is covered. Overlap, holes and weakly simple rings are no special cases.
//!
//! Limits, all on the side of accepting: places within two tolerances of start and target belong to them; where a
//! path turns back on itself within a few tolerances both legs are looked at apart; circular edges touch within the rounding of their
//! numbers only; of edges that crowd in one place (see [`PAIR_LIMIT`]) only shared vertices and the first pairs
//! are compared. Cost: linear in the contacts, but for edges side by side, which are compared in pairs.

use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::contact::contacts;
use crate::corridor::{Corridor, Wall};
use crate::cross_cut::CrossCut;
use crate::curve::Curve;
use crate::curve_cuts::Part;
use std::collections::HashMap;
use traverse_geometry::Point;

/// Most pairs of edges that are compared for one path.
const PAIR_LIMIT: usize = 1_000_000;

/// How near the joint of two steps, in reaches, a piece goes over from one to the other.
const JOINT_REACHES: f64 = 2.0;

/// A place where a path passes between what touches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage {
    /// Index of the path's step.
    pub(crate) step: usize,
    pub(crate) at: Point,
    /// Indices of the solids that touch; twice the same where one does so itself or is crossed.
    pub(crate) solids: [u32; 2],
}

/// A part of an edge that lies in the corridor along one step.
struct Piece {
    step: usize,
    edge: u32,
    curve: Curve,
    part: Part,
    /// The fractions of the step that it lies beside.
    beside: Part,
}

/// Every passage of the corridor, as long as `go_on` says so; `edges` holds the edges within reach of each of its steps.
pub(crate) fn passages(
    boundary: &Boundary,
    tree: &BoundaryTree,
    corridor: &Corridor,
    edges: &[Vec<u32>],
    go_on: &dyn Fn() -> bool,
) -> Vec<Passage> {
    let mut groups = Groups::default();
    let covered = covered_ends(boundary, tree, corridor, edges, go_on);
    // The pieces of every edge along every step.
    let mut by_edge: HashMap<(usize, u32), Vec<usize>> = HashMap::new();
    let mut pairs = PAIR_LIMIT;
    for (at, step_edges) in edges.iter().enumerate().take_while(|_| go_on()) {
        let first = groups.pieces.len();
        for &edge in step_edges {
            add_pieces(boundary, corridor, at, edge, &mut groups);
        }
        let added = first..groups.pieces.len();
        for &(_, edge, fraction, wall) in covered.iter().filter(|covered| covered.0 == at) {
            let piece = added.clone().find(|&piece| {
                let Piece { edge: other, part, .. } = groups.pieces[piece];
                edge == other && part.0 <= fraction && fraction <= part.1
            });
            if let Some(piece) = piece {
                groups.walls[piece][wall as usize] = true;
            }
        }
        for piece in added.clone() {
            groups.report_crossing(boundary, corridor, piece);
        }
        join_shared_vertices(boundary, corridor, added.clone(), &mut groups);
        join_touching(boundary, corridor, added.clone(), &mut pairs, &mut groups);
        for piece in added.clone() {
            by_edge.entry((at, groups.pieces[piece].edge)).or_default().push(piece);
        }
    }
    for (at, step_edges) in edges.iter().enumerate().take_while(|_| go_on()) {
        let joint = corridor.steps[at].curve.end();
        for next in corridor.following(at) {
            for &edge in step_edges {
                let (Some(one), Some(other)) = (by_edge.get(&(at, edge)), by_edge.get(&(next, edge))) else {
                    continue;
                };
                for (&a, &b) in one.iter().flat_map(|a| other.iter().map(move |b| (a, b))) {
                    if let Some(place) = groups.common_place(a, b, joint, JOINT_REACHES * corridor.reach) {
                        groups.join(boundary, corridor, a, b, place);
                    }
                }
            }
        }
    }
    groups.passages
}

/// Edges that run out through an end of the corridor with nothing but material between them and a wall: step, edge,
/// fraction of the edge, wall.
fn covered_ends(
    boundary: &Boundary,
    tree: &BoundaryTree,
    corridor: &Corridor,
    edges: &[Vec<u32>],
    go_on: &dyn Fn() -> bool,
) -> Vec<(usize, u32, f64, Wall)> {
    let mut covered = Vec::new();
    for (at, fraction) in corridor.end_cuts().into_iter().take_while(|_| go_on()) {
        let cut = CrossCut::across(boundary, &corridor.steps[at].curve, fraction, &edges[at], corridor.reach);
        let right = cut.cover_right(boundary, tree).and(cut.lines.first());
        let left = cut.cover_left(boundary, tree).and(cut.lines.last());
        covered.extend(right.map(|line| (at, line.edge, line.fraction, Wall::Right)));
        covered.extend(left.map(|line| (at, line.edge, line.fraction, Wall::Left)));
    }
    covered
}

fn add_pieces(boundary: &Boundary, corridor: &Corridor, at: usize, edge: u32, groups: &mut Groups) {
    let step = &corridor.steps[at].curve;
    let curve = boundary.curve(edge);
    for part in curve.parts_within(step, corridor.reach) {
        let exits: Vec<Point> = [(part.0 > 0.0, part.0), (part.1 < 1.0, part.1)]
            .into_iter()
            .filter(|&(leaves, _)| leaves)
            .map(|(_, fraction)| curve.point_at(fraction))
            .collect();
        // Past an end of the step it may go round the joint; only beside the step it crosses for certain.
        let side = |p: Point| {
            let fraction = step.nearest_fraction(p);
            (fraction > 0.0 && fraction < 1.0).then(|| corridor.side_of(at, fraction, p))
        };
        let sides: Vec<Wall> = exits.iter().filter_map(|&p| side(p)).collect();
        let crosses = matches!(sides[..], [one, other] if one != other);
        let mut walls = [false; 2];
        for wall in exits.into_iter().filter_map(|p| corridor.wall_at(at, p, crosses)) {
            walls[wall as usize] = true;
        }
        let places =
            [part.0, (part.0 + part.1) / 2.0, part.1].map(|f| step.nearest_fraction(curve.point_at(f)));
        let beside = places.iter().fold((1.0, 0.0), |range: Part, &f| (range.0.min(f), range.1.max(f)));
        groups.add(Piece { step: at, edge, curve, part, beside }, walls);
    }
}

/// Joins pieces that end in the same vertex within the corridor.
fn join_shared_vertices(
    boundary: &Boundary,
    corridor: &Corridor,
    pieces: std::ops::Range<usize>,
    groups: &mut Groups,
) {
    let mut at_vertex: HashMap<[u64; 2], usize> = HashMap::new();
    for piece in pieces {
        let Piece { step, curve, part, .. } = groups.pieces[piece];
        let ends = [(part.0 <= 0.0, curve.start()), (part.1 >= 1.0, curve.end())];
        for (_, vertex) in ends.into_iter().filter(|&(reached, _)| reached) {
            if corridor.is_near_end(step, vertex) {
                continue;
            }
            // + 0.0 makes one zero of both.
            let key = [(vertex.x + 0.0).to_bits(), (vertex.y + 0.0).to_bits()];
            let first = *at_vertex.entry(key).or_insert(piece);
            groups.join(boundary, corridor, first, piece, vertex);
        }
    }
}

/// Joins pieces beside the same part of a step that touch anywhere else within the corridor.
fn join_touching(
    boundary: &Boundary,
    corridor: &Corridor,
    pieces: std::ops::Range<usize>,
    pairs: &mut usize,
    groups: &mut Groups,
) {
    let Some(step) = pieces.clone().next().map(|first| groups.pieces[first].step) else { return };
    let curve = corridor.steps[step].curve;
    let slack = 4.0 * corridor.reach / curve.length();
    let mut order: Vec<usize> = pieces.collect();
    order.sort_by(|&a, &b| groups.pieces[a].beside.0.total_cmp(&groups.pieces[b].beside.0));
    let mut open: Vec<usize> = Vec::new();
    for piece in order {
        let from = groups.pieces[piece].beside.0;
        open.retain(|&other| groups.pieces[other].beside.1 + slack >= from);
        for &other in &open {
            if groups.find(other) == groups.find(piece) {
                continue;
            }
            if *pairs == 0 {
                return;
            }
            *pairs -= 1;
            let (one, two) = (&groups.pieces[other], &groups.pieces[piece]);
            let place = contacts(&one.curve, &two.curve).into_iter().find(|&p| {
                curve.distance_to_point(p) <= corridor.reach
                    && !corridor.is_near_end(step, p)
                    && [one, two].into_iter().all(|piece| {
                        let fraction = piece.curve.nearest_fraction(p);
                        piece.part.0 <= fraction && fraction <= piece.part.1
                    })
            });
            if let Some(place) = place {
                groups.join(boundary, corridor, other, piece, place);
            }
        }
        open.push(piece);
    }
}

/// Connected groups of pieces: a union-find that knows which walls each group reaches.
#[derive(Default)]
struct Groups {
    pieces: Vec<Piece>,
    parent: Vec<usize>,
    /// Left, right.
    walls: Vec<[bool; 2]>,
    passages: Vec<Passage>,
}

impl Groups {
    fn add(&mut self, piece: Piece, walls: [bool; 2]) {
        self.parent.push(self.pieces.len());
        self.pieces.push(piece);
        self.walls.push(walls);
    }

    fn find(&mut self, piece: usize) -> usize {
        let mut root = piece;
        while self.parent[root] != root {
            self.parent[root] = self.parent[self.parent[root]];
            root = self.parent[root];
        }
        root
    }

    /// Where pieces of one edge along neighbouring steps overlap, if that is within `reach` of the joint between:
    /// farther along, neighbours that run side by side meet the same edge on different sheets of the corridor.
    fn common_place(&self, a: usize, b: usize, joint: Point, reach: f64) -> Option<Point> {
        let (one, other) = (&self.pieces[a], &self.pieces[b]);
        let (from, to) = (one.part.0.max(other.part.0), one.part.1.min(other.part.1));
        if from > to {
            return None;
        }
        let place = one.curve.point_at(one.curve.nearest_fraction(joint).clamp(from, to));
        ((place - joint).norm() <= reach).then_some(place)
    }

    fn report_crossing(&mut self, boundary: &Boundary, corridor: &Corridor, piece: usize) {
        if self.walls[piece] == [true; 2] {
            let Piece { part, curve, .. } = self.pieces[piece];
            self.report(boundary, corridor, piece, piece, curve.point_at((part.0 + part.1) / 2.0));
        }
    }

    fn report(&mut self, boundary: &Boundary, corridor: &Corridor, a: usize, b: usize, at: Point) {
        let solids = [a, b].map(|piece| boundary.solid_of(self.pieces[piece].edge));
        self.passages.push(Passage { step: corridor.steps[self.pieces[b].step].index, at, solids });
    }

    /// Joins two pieces that touch at `place`, and reports it when only that closes the corridor.
    fn join(&mut self, boundary: &Boundary, corridor: &Corridor, a: usize, b: usize, place: Point) {
        let (one, other) = (self.find(a), self.find(b));
        if one == other {
            return;
        }
        let (before, after) = (self.walls[one], self.walls[other]);
        let joined = [before[0] || after[0], before[1] || after[1]];
        self.parent[other] = one;
        self.walls[one] = joined;
        if joined == [true; 2] && before != joined && after != joined {
            self.report(boundary, corridor, a, b, place);
        }
    }
}
