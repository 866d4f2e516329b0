//! From the parts of a section to how far right it reaches at each height, grown by a gap on the way.
//!
//! What lies within the gap of a part is the part and a disc swept round it. Its rightmost points come from edges that
//! face right, moved out along their normals (an arc's radius grows or shrinks by the gap), and from discs about
//! corners: exact, and a range of heights that is larger by the gap at either end. Every piece that is added lies in
//! the grown part, so one too many does no harm. Holes never show.

use crate::curve::Curve;
use crate::envelope::{Envelope, Piece};
use std::f64::consts::{FRAC_PI_2, TAU};
use traverse_geometry::{Arc, Edge, Point, Ring, Vector, cross};

/// How far right rings reach at each height when each is grown by `gap`, millimetres, 0 or more.
pub(crate) fn right_outline<'a>(rings: impl Iterator<Item = &'a Ring>, gap: f64) -> Envelope {
    let mut outline = Outline { gap, runs: vec![], points: vec![] };
    for ring in rings {
        if ring.is_counter_clockwise() {
            outline.add(ring);
        } else {
            outline.add(&ring.reversed());
        }
    }
    Envelope::of(outline.runs, outline.points)
}

struct Outline {
    gap: f64,
    runs: Vec<Vec<Piece>>,
    points: Vec<Piece>,
}

impl Outline {
    fn add(&mut self, ring: &Ring) {
        let count = ring.len();
        let mut before = ring.edge(count - 1);
        for i in 0..count {
            let edge = ring.edge(i);
            if self.gap > 0.0 {
                self.add_corner(&before, &edge);
            }
            match &edge {
                Edge::Segment(segment) => self.add_segment(segment.start, segment.end),
                Edge::Arc(arc) => self.add_arc(arc),
            }
            before = edge;
        }
    }

    fn push(&mut self, low: f64, high: f64, curve: Curve) {
        let piece = Piece::new(low, high, curve);
        if low < high {
            match self.runs.last_mut() {
                Some(run) if run.last().is_some_and(|last| last.high == low) => run.push(piece),
                _ => self.runs.push(vec![piece]),
            }
        }
    }

    fn add_segment(&mut self, start: Point, end: Point) {
        let along = end - start;
        if along.y > 0.0 {
            let by = right_normal(along) * self.gap;
            // Heights as corners compute them: neighbours share them bit for bit.
            let curve = Curve::Line { at: start + by, slope: along.x / along.y };
            self.push(start.y + by.y, end.y + by.y, curve);
        } else if along.y == 0.0 && self.gap == 0.0 && along.x != 0.0 {
            let tip = if along.x > 0.0 { end } else { start };
            self.points.push(Piece::new(tip.y, tip.y, Curve::Line { at: tip, slope: 0.0 }));
        }
    }

    /// The parts of an arc that run upwards: on the right half of its circle when it turns left, on the left half when
    /// it turns right.
    fn add_arc(&mut self, arc: &Arc) {
        let side = arc.sweep.signum();
        let radius = arc.radius + side * self.gap;
        if radius <= 0.0 {
            // The arc is a hollow too narrow for the disc: its ends hide the rest.
            self.add_disc(arc.start, -1.0, 1.0);
            self.add_disc(arc.end, -1.0, 1.0);
            return;
        }
        let (from, to) = (arc.start_angle, arc.start_angle + arc.sweep);
        let (first, last) = (from.min(to), from.max(to));
        // The half of the circle is centred on this direction, give or take whole turns.
        let middle = if side > 0.0 { 0.0 } else { std::f64::consts::PI };
        let mut turn = ((first - middle - FRAC_PI_2) / TAU).floor();
        loop {
            let (begin, end) = (middle + turn * TAU - FRAC_PI_2, middle + turn * TAU + FRAC_PI_2);
            if begin >= last {
                return;
            }
            let (a, b) = (first.max(begin), last.min(end));
            if a < b {
                let height = |angle: f64| {
                    if angle == from {
                        arc.start.y + self.gap * outward(arc, arc.start).y
                    } else if angle == to {
                        arc.end.y + self.gap * outward(arc, arc.end).y
                    } else {
                        // The lowest or highest point of the circle.
                        arc.center.y + radius * angle.sin().signum()
                    }
                };
                let (low, high) = if side > 0.0 { (height(a), height(b)) } else { (height(b), height(a)) };
                self.push(low, high, Curve::Arc { center: arc.center, radius, side });
            }
            turn += 1.0;
        }
    }

    /// The disc about the corner between two edges, where it may show.
    fn add_corner(&mut self, before: &Edge, after: &Edge) {
        let corner = after.start();
        let (enter, leave) = (normal_at_end(before), normal_at_start(after));
        let left_turn = cross(enter, leave) >= 0.0;
        match (enter.x > 0.0, leave.x > 0.0) {
            (true, true) => self.add_disc(corner, enter.y, leave.y),
            (false, true) if left_turn => self.add_disc(corner, -1.0, leave.y),
            (true, false) if left_turn => self.add_disc(corner, enter.y, 1.0),
            (false, false) if left_turn && enter.y <= 0.0 && leave.y >= 0.0 => {
                self.add_disc(corner, -1.0, 1.0);
            }
            _ => {}
        }
    }

    /// The right half of the disc about a corner, between two heights in parts of its radius.
    fn add_disc(&mut self, corner: Point, low: f64, high: f64) {
        let curve = Curve::Arc { center: corner, radius: self.gap, side: 1.0 };
        self.push(corner.y + self.gap * low, corner.y + self.gap * high, curve);
    }
}

/// The unit normal that points out of a region on the left, at a point of an arc.
fn outward(arc: &Arc, at: Point) -> Vector {
    (at - arc.center) * (arc.sweep.signum() / arc.radius)
}

fn normal_at_start(edge: &Edge) -> Vector {
    match edge {
        Edge::Segment(segment) => right_normal(segment.vector()),
        Edge::Arc(arc) => outward(arc, arc.start),
    }
}

fn normal_at_end(edge: &Edge) -> Vector {
    match edge {
        Edge::Segment(segment) => right_normal(segment.vector()),
        Edge::Arc(arc) => outward(arc, arc.end),
    }
}

/// Unit normal to the right; zero for an edge of length 0.
fn right_normal(along: Vector) -> Vector {
    let length = along.norm();
    if length > 0.0 { Vector::new(along.y, -along.x) / length } else { Vector::zeros() }
}
