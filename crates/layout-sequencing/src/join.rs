//! The exact join of two sections.

use crate::meeting::meeting;
use crate::profile::{Profile, Silhouette};
use traverse_geometry::{Point, Pose, Section};

/// How one section stands tightly to the right of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Join {
    /// From the left section's left edge to the right section's left edge, millimetres. Absent: they share no height,
    /// nothing is in the way.
    pub offset_mm: Option<f64>,
    /// How far the right section slides into the left one, against joining their bounding boxes with the gap between
    /// them, millimetres, 0 or more. At most width and gap: no section passes the left edge of the one before it.
    pub effect_mm: f64,
    /// Where they touch, on the left and on the right section, with the left section's left edge at x = 0 and the right
    /// one at the offset; heights as the sections were sent. Absent with the offset.
    pub witness: Option<[Point; 2]>,
}

/// The exact join of two sections in their poses, `gap_mm` (0 or more) apart: every height counts, all corners, arcs
/// and both sides of every step; where one ends at the height where the other begins they touch. Cost: O(n log n) for
/// the envelopes, linear for the join.
#[must_use]
pub fn join(left: (&Section, Pose), right: (&Section, Pose), gap_mm: f64) -> Join {
    let stands = Silhouette::of(left.0, gap_mm).profile(left.1);
    let slides = Silhouette::of(right.0, gap_mm).profile(right.1);
    let Some(met) = meeting(&stands.grown_right, &slides.left) else {
        return Join { offset_mm: None, effect_mm: stands.width + gap_mm, witness: None };
    };
    let touched = Point::new(met.offset - slides.left.x(met.y).unwrap_or_default(), met.y);
    Join {
        offset_mm: Some(met.offset),
        effect_mm: effect(&stands, Some(met.offset), gap_mm),
        witness: Some([nearest_point(left.0, left.1, touched), touched]),
    }
}

/// What an offset saves against bounding boxes.
pub(crate) fn effect(left: &Profile, offset: Option<f64>, gap: f64) -> f64 {
    (left.width + gap - offset.unwrap_or(0.0).max(0.0)).max(0.0)
}

/// The point of a section in its pose, left edge at 0, that is nearest to `p`.
pub(crate) fn nearest_point(section: &Section, pose: Pose, p: Point) -> Point {
    let bounds = section.bounds();
    let motion = pose.motion(&bounds);
    // The pose leaves the box where it is, and is its own inverse.
    let to_section = motion.inverse();
    let asked = to_section.point(Point::new(p.x + bounds.min.x, p.y));
    let nearest = section
        .parts
        .iter()
        .map(|part| part.in_section().outer().nearest_point(asked))
        .min_by(|a, b| (a - asked).norm_squared().total_cmp(&(b - asked).norm_squared()));
    let moved = motion.point(nearest.unwrap_or(asked));
    Point::new(moved.x - bounds.min.x, moved.y)
}
