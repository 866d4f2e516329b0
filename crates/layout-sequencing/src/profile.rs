//! A section in a pose as joins see it: how far it reaches to the left and to the right at each height. Computed once
//! for each section; poses are reflections of it.

use crate::envelope::Envelope;
use crate::outline::right_outline;
use traverse_geometry::{Bounds, Motion, Polygon, Pose, Section};

/// A section in a pose as joins see it. Heights are those of the section as it was sent; x is 0 at the left edge of
/// the bounding box.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Profile {
    /// Width of the bounding box, millimetres.
    pub(crate) width: f64,
    /// How far right it reaches.
    pub(crate) right: Envelope,
    /// The same, grown by the gap.
    pub(crate) grown_right: Envelope,
    /// How far left it reaches, as −x.
    pub(crate) left: Envelope,
}

/// A section as joins see it, ready for every pose.
#[derive(Clone, Debug)]
pub(crate) struct Silhouette {
    width: f64,
    /// Lowest and highest point of the bounding box, added: poses that turn it upside down turn y into this less y.
    heights: f64,
    right: Envelope,
    left: Envelope,
    grown_right: Envelope,
    grown_left: Envelope,
}

impl Silhouette {
    /// The silhouette of a section grown by `gap` where it stands on the left. Cost: O(n log n).
    pub(crate) fn of(section: &Section, gap: f64) -> Self {
        let parts: Vec<Polygon> = section.parts.iter().map(traverse_geometry::Part::in_section).collect();
        let bounds = parts.iter().fold(Bounds::EMPTY, |bounds, part| bounds.union(part.bounds()));
        let mirror = Motion::mirror_x();
        let mirrored: Vec<_> = parts.iter().map(|part| part.outer().moved(&mirror)).collect();
        let outer = || parts.iter().map(Polygon::outer);
        let right = right_outline(outer(), 0.0).shifted(-bounds.min.x);
        let left = right_outline(mirrored.iter(), 0.0).shifted(bounds.min.x);
        let (grown_right, grown_left) = if gap > 0.0 {
            (
                right_outline(outer(), gap).shifted(-bounds.min.x),
                right_outline(mirrored.iter(), gap).shifted(bounds.min.x),
            )
        } else {
            (right.clone(), left.clone())
        };
        Self {
            width: bounds.max.x - bounds.min.x,
            heights: bounds.min.y + bounds.max.y,
            right,
            left,
            grown_right,
            grown_left,
        }
    }

    /// The section in a pose.
    pub(crate) fn profile(&self, pose: Pose) -> Profile {
        let upright = |envelope: &Envelope| match pose {
            Pose::AsIs | Pose::MirrorX => envelope.clone(),
            Pose::HalfTurn | Pose::MirrorY => envelope.flipped(self.heights),
        };
        let [right, left, grown_right, grown_left] =
            [&self.right, &self.left, &self.grown_right, &self.grown_left].map(upright);
        match pose {
            Pose::AsIs | Pose::MirrorY => Profile { width: self.width, right, grown_right, left },
            // What was left is right: x becomes width − x.
            Pose::HalfTurn | Pose::MirrorX => Profile {
                width: self.width,
                right: left.shifted(self.width),
                grown_right: grown_left.shifted(self.width),
                left: right.shifted(-self.width),
            },
        }
    }
}

impl Profile {
    /// From the leftmost to the rightmost point at height y, millimetres; nothing where the section does not reach.
    pub(crate) fn thickness(&self, y: f64) -> Option<f64> {
        Some(self.right.x(y)? + self.left.x(y)?)
    }
}
