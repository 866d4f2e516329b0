//! A directed chain of straight, circular and vertical moves: what a rapid move is answered with.

use crate::{Arc, Edge, Point, Segment};

/// A directed chain of moves from `start` on.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Where the first step begins.
    pub start: Point,
    /// Height where it begins, millimetres. Absent: the path uses no heights.
    pub start_z_mm: Option<f64>,
    /// The moves, in order. None: the path stays where it is.
    pub steps: Vec<PathStep>,
}

/// One move of a path, from where the step before it ended. It changes the position in the plane or the height, not both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathStep {
    /// Where the move ends.
    pub end: Point,
    /// The circle it follows. Absent: straight.
    pub arc: Option<PathArc>,
    /// Height where the move ends, millimetres. Absent: the path uses no heights.
    pub z_mm: Option<f64>,
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
        Self { start, start_z_mm: None, steps: Vec::new() }
    }

    /// A path that has not moved yet, at a height.
    #[must_use]
    pub fn at_height(start: Point, z_mm: f64) -> Self {
        Self { start, start_z_mm: Some(z_mm), steps: Vec::new() }
    }

    /// Where the last step ends.
    #[must_use]
    pub fn end(&self) -> Point {
        self.steps.last().map_or(self.start, |step| step.end)
    }

    /// Height where the last step ends, millimetres. Absent: the path uses no heights.
    #[must_use]
    pub fn end_z_mm(&self) -> Option<f64> {
        self.steps.last().map_or(self.start_z_mm, |step| step.z_mm)
    }

    /// Adds a straight move, unless the path is there already.
    pub fn line_to(&mut self, end: Point) {
        if end != self.end() {
            let z_mm = self.end_z_mm();
            self.steps.push(PathStep { end, arc: None, z_mm });
        }
    }

    /// Adds a circular move about `center` over `sweep` radians (positive counter-clockwise), unless it is 0.
    pub fn arc_to(&mut self, end: Point, center: Point, sweep: f64) {
        if sweep != 0.0 {
            let z_mm = self.end_z_mm();
            self.steps.push(PathStep { end, arc: Some(PathArc { center, sweep }), z_mm });
        }
    }

    /// Adds a vertical move, unless the path is at that height already or uses no heights.
    pub fn height_to(&mut self, z_mm: f64) {
        if self.end_z_mm().is_some_and(|z| z != z_mm) {
            self.steps.push(PathStep { end: self.end(), arc: None, z_mm: Some(z_mm) });
        }
    }

    /// The path with every move at one height.
    #[must_use]
    pub fn at_level(mut self, z_mm: f64) -> Self {
        self.start_z_mm = Some(z_mm);
        for step in &mut self.steps {
            step.z_mm = Some(z_mm);
        }
        self
    }

    /// The path as seen from above: no heights, no vertical moves.
    #[must_use]
    pub fn in_plane(&self) -> Self {
        let mut path = Self::at(self.start);
        for step in &self.steps {
            match step.arc {
                None => path.line_to(step.end),
                Some(arc) => path.arc_to(step.end, arc.center, arc.sweep),
            }
        }
        path
    }

    /// Adds the steps of `next`, which begins where this path ends.
    pub fn append(&mut self, next: &Self) {
        self.steps.extend_from_slice(&next.steps);
    }

    /// The moves as edges of the plane, in order; a vertical one is a segment of length 0.
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

    /// Millimetres, vertical moves included.
    #[must_use]
    pub fn length(&self) -> f64 {
        let mut from = self.start_z_mm;
        let vertical = |step: &PathStep| {
            let before = std::mem::replace(&mut from, step.z_mm);
            before.zip(step.z_mm).map_or(0.0, |(before, after)| (after - before).abs())
        };
        self.edges().map(|edge| edge.length()).sum::<f64>() + self.steps.iter().map(vertical).sum::<f64>()
    }

    /// The same way, run from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let heights = std::iter::once(self.start_z_mm).chain(self.steps.iter().map(|step| step.z_mm));
        let mut heights: Vec<Option<f64>> = heights.collect();
        let mut back = Self { start: self.end(), start_z_mm: heights.pop().flatten(), steps: Vec::new() };
        let edges: Vec<Edge> = self.edges().collect();
        for edge in edges.iter().rev() {
            let z_mm = heights.pop().flatten();
            let (end, arc) = match edge {
                Edge::Segment(segment) => (segment.start, None),
                Edge::Arc(arc) => (arc.start, Some(PathArc { center: arc.center, sweep: -arc.sweep })),
            };
            back.steps.push(PathStep { end, arc, z_mm });
        }
        back
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_count_and_turn_round() {
        let mut path = Path::at_height(Point::new(0.0, 0.0), 1.0);
        path.height_to(4.0);
        path.line_to(Point::new(10.0, 0.0));
        path.arc_to(Point::new(10.0, 4.0), Point::new(10.0, 2.0), std::f64::consts::PI);
        path.height_to(-1.0);
        assert!((path.length() - (3.0 + 10.0 + 2.0 * std::f64::consts::PI + 5.0)).abs() < 1e-12);
        let back = path.reversed();
        assert_eq!((back.start_z_mm, back.end_z_mm()), (Some(-1.0), Some(1.0)));
        assert!((back.length() - path.length()).abs() < 1e-12);
        assert_eq!(back.reversed(), path);
    }
}
