//! A directed chain of straight and circular moves: what a rapid move is answered with.

use crate::{Arc, Edge, Point, Segment};

/// A directed chain of moves from `start` on.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Where the first step begins.
    pub start: Point,
    /// The moves, in order. None: the path stays where it is.
    pub steps: Vec<PathStep>,
}

/// One move of a path, from where the step before it ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathStep {
    /// Where the move ends.
    pub end: Point,
    /// The circle it follows. Absent: straight.
    pub arc: Option<PathArc>,
}

/// The circle that a step follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathArc {
    /// Centre of the circle.
    pub center: Point,
    /// Turned angle, radians, positive counter-clockwise, not 0, within [−2π, 2π].
    pub sweep: f64,
}

impl Path {
    /// A path that has not moved yet.
    #[must_use]
    pub fn at(start: Point) -> Self {
        Self { start, steps: Vec::new() }
    }

    /// Where the last step ends.
    #[must_use]
    pub fn end(&self) -> Point {
        self.steps.last().map_or(self.start, |step| step.end)
    }

    /// Adds a straight move, unless the path is there already.
    pub fn line_to(&mut self, end: Point) {
        if end != self.end() {
            self.steps.push(PathStep { end, arc: None });
        }
    }

    /// Adds a circular move about `center` over `sweep` radians (positive counter-clockwise), unless it is 0.
    pub fn arc_to(&mut self, end: Point, center: Point, sweep: f64) {
        if sweep != 0.0 {
            self.steps.push(PathStep { end, arc: Some(PathArc { center, sweep }) });
        }
    }

    /// The moves as edges, in order.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let mut from = self.start;
        self.steps.iter().map(move |step| {
            let start = std::mem::replace(&mut from, step.end);
            match step.arc {
                None => Edge::Segment(Segment::new(start, step.end)),
                Some(arc) => Edge::Arc(Arc::from_center(start, step.end, arc.center, arc.sweep)),
            }
        })
    }

    /// Millimetres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }

    /// The same way, run from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut back = Self::at(self.end());
        let edges: Vec<Edge> = self.edges().collect();
        for edge in edges.iter().rev() {
            match edge {
                Edge::Segment(segment) => back.steps.push(PathStep { end: segment.start, arc: None }),
                Edge::Arc(arc) => back.steps.push(PathStep {
                    end: arc.start,
                    arc: Some(PathArc { center: arc.center, sweep: -arc.sweep }),
                }),
            }
        }
        back
    }
}
