//! The line or circle of an edge, ready to measure from.

use traverse_geometry::{Point, Vector, cross, left_of};

/// An edge of at most half a turn, by its line or circle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Track {
    /// Along a unit direction.
    Line { start: Point, direction: Vector, length: f64 },
    /// About a centre; `turn` is 1 counter-clockwise, −1 clockwise.
    Circle { center: Point, radius: f64, turn: f64, from: Vector, to: Vector },
}

impl Track {
    /// The edge between two points of that bulge, within [−1, 1]; none without length.
    pub(super) fn new(start: Point, end: Point, bulge: f64) -> Option<Self> {
        let chord = end - start;
        let length = chord.norm();
        if length == 0.0 {
            return None;
        }
        if bulge == 0.0 {
            return Some(Self::Line { start, direction: chord / length, length });
        }
        let center = start + chord / 2.0 + left_of(chord) * ((1.0 - bulge * bulge) / (4.0 * bulge));
        let radius = length * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        Some(Self::Circle { center, radius, turn: bulge.signum(), from: start - center, to: end - center })
    }

    /// The signed distance of a point from the line or circle, and the unit direction of travel at its foot; none when
    /// the foot is not on the edge.
    pub(super) fn beside(&self, point: Point) -> Option<(f64, Vector)> {
        match *self {
            Self::Line { start, direction, length } => {
                let along = (point - start).dot(&direction);
                (along >= 0.0 && along <= length).then(|| (cross(direction, point - start), direction))
            }
            Self::Circle { center, radius, turn, from, to } => {
                let spoke = point - center;
                let distance = spoke.norm();
                // At most half a turn: between both spokes is left of the first and right of the last.
                let on_it = turn * cross(from, spoke) >= 0.0 && turn * cross(spoke, to) >= 0.0;
                (on_it && distance > 0.0).then(|| (distance - radius, left_of(spoke) * (turn / distance)))
            }
        }
    }
}
