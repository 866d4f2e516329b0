//! Mitred corners: parallel lines that meet in control points, as published in 2008.

use super::Outline;
use traverse_geometry::{
    Arc, CONTACT_TOLERANCE_MM, CornerStyle, Edge, MITER_RATIO_LIMIT, Point, Segment, Vector, left_of, unit,
};

/// A convex corner: the vertex and the outward normals of the edges that meet there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) vertex: Point,
    pub(crate) normals: [Vector; 2],
    /// Angle from the first normal counter-clockwise to the second, within (0, π].
    pub(crate) turn: f64,
}

/// A mitred corner at some clearance: one control point, or two where the corner is cut square.
pub(crate) struct Mitred {
    /// Where the border of the edge before ends, the control points, where that of the edge after begins.
    points: Vec<Point>,
    /// First normal and turned angle at each control point.
    turns: Vec<(Vector, f64)>,
}

impl Corner {
    /// The corner at `clearance`, cut square beyond `limit` times the clearance.
    pub(crate) fn mitred(&self, clearance: f64, limit: f64) -> Mitred {
        let from = self.vertex + self.normals[0] * clearance;
        let to = self.vertex + self.normals[1] * clearance;
        let half = self.turn / 2.0;
        let start_angle = self.normals[0].y.atan2(self.normals[0].x);
        let bisector = unit(start_angle + half);
        if half.cos() * limit >= 1.0 {
            let control = self.vertex + bisector * (clearance / half.cos());
            return Mitred { points: vec![from, control, to], turns: vec![(self.normals[0], self.turn)] };
        }
        // The square cut crosses each parallel where it is `limit` clearances along the bisector: from the
        // foot of the normal on, so far along the edge's direction.
        let along = clearance * (limit - half.cos()) / half.sin();
        let first = from + left_of(self.normals[0]) * along;
        let second = to - left_of(self.normals[1]) * along;
        Mitred {
            points: vec![from, first, second, to],
            turns: vec![(self.normals[0], half), (bisector, half)],
        }
    }
}

impl Mitred {
    /// The straight edges of the border.
    pub(crate) fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        self.points.windows(2).map(|pair| Edge::Segment(Segment::new(pair[0], pair[1])))
    }

    /// Every control point with its first normal and its turned angle.
    pub(crate) fn control_points(&self) -> impl Iterator<Item = (Point, Vector, f64)> + '_ {
        let inner = &self.points[1..self.points.len() - 1];
        inner.iter().zip(&self.turns).map(|(&point, &(normal, turn))| (point, normal, turn))
    }
}

/// The edge moved outwards (to its right) by `distance`. None: a hollow arc that shrank to nothing.
pub(crate) fn parallel(edge: &Edge, distance: f64) -> Option<Edge> {
    match edge {
        Edge::Segment(segment) => {
            let by = -left_of(edge.direction_at(0.0)) * distance;
            Some(Edge::Segment(Segment::new(segment.start + by, segment.end + by)))
        }
        Edge::Arc(arc) => {
            let radius = arc.radius + distance * arc.sweep.signum();
            let scaled = |p: Point| arc.center + (p - arc.center) * (radius / arc.radius);
            (radius > 0.0)
                .then(|| Edge::Arc(Arc { radius, start: scaled(arc.start), end: scaled(arc.end), ..*arc }))
        }
    }
}

/// The clearance at which the mitred barrier of an outline passes through `p` (outside it), if that is below the
/// clearance asked for: how near `p` is, as mitred barriers measure. Cost: linear.
pub(crate) fn miter_gauge(outline: &Outline<'_>, p: Point) -> Option<f64> {
    let (ring, clearance) = (outline.ring, outline.clearance);
    let limit = match clearance.style {
        CornerStyle::Miter { limit } => limit.unwrap_or(MITER_RATIO_LIMIT),
        CornerStyle::Round => return None,
    };
    let edges = ring.edges().filter_map(|edge| strip_gauge(&edge, p));
    let corners = (0..ring.len()).filter_map(|i| corner_gauge(&outline.corner_at(i)?, p, limit));
    edges.chain(corners).min_by(f64::total_cmp).filter(|&gauge| gauge < clearance.asked)
}

/// Distance outwards from the edge, where the foot lies on it.
fn strip_gauge(edge: &Edge, p: Point) -> Option<f64> {
    let direction = edge.direction_at(0.0);
    match edge {
        Edge::Segment(segment) => {
            let along = (p - segment.start).dot(&direction);
            let out = -left_of(direction).dot(&(p - segment.start));
            outwards(out).filter(|_| (0.0..=segment.length()).contains(&along))
        }
        Edge::Arc(arc) => {
            let out = ((p - arc.center).norm() - arc.radius) * arc.sweep.signum();
            outwards(out).filter(|_| arc.spans(p - arc.center))
        }
    }
}

/// The larger of the distances from both edges' lines, where `p` lies in the corner's kite; cut square likewise.
fn corner_gauge(corner: &Corner, p: Point, limit: f64) -> Option<f64> {
    let by = p - corner.vertex;
    let [n1, n2] = corner.normals;
    // In the kite: ahead of the edge before, behind the edge after.
    let inside = by.dot(&left_of(n1)) >= 0.0 && by.dot(&left_of(n2)) <= 0.0;
    let bisector = unit(n1.y.atan2(n1.x) + corner.turn / 2.0);
    let gauge = by.dot(&n1).max(by.dot(&n2)).max(by.dot(&bisector) / limit);
    outwards(gauge).filter(|_| inside)
}

/// A distance outwards; what lies on the border may come out inside by rounding.
fn outwards(distance: f64) -> Option<f64> {
    (distance >= -CONTACT_TOLERANCE_MM).then_some(distance.max(0.0))
}
