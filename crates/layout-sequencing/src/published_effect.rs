//! The effect of a join as published in 2009: rays from local extremes only.
//!
//! With bounding boxes standing side by side, from every local minimum in x of the right section's left border a ray
//! goes left to the left section's right border, and from every local maximum of that border a ray goes right; the
//! shortest ray is the effect. Only parts near the joint count, those whose box is nearer to the facing edge than the part
//! is long (published for the pole, the box's lower left corner; here each side is measured alike); and of each part
//! only the chain that faces the joint, from its lowest to its highest point, whose ends count as extremes when they are. Between extremes a border can come nearer:
//! then the effect is too large and parts overlap. Cost: linear in the vertices, times the logarithm for each ray.

use crate::envelope::Envelope;
use crate::outline::right_outline;
use traverse_geometry::{Edge, Motion, Point, Polygon, Pose, Ring, Section, Vector};

/// What the published model sees of a section in a pose.
#[derive(Clone, Debug)]
pub(crate) struct Facing {
    width: f64,
    right: Border,
    /// Mirrored: as −x.
    left: Border,
}

/// A border that faces a joint, as if it faced right.
#[derive(Clone, Debug)]
struct Border {
    reaches: Envelope,
    extremes: Vec<Point>,
}

impl Facing {
    pub(crate) fn of(section: &Section, pose: Pose) -> Self {
        let bounds = section.bounds();
        let stand = pose.motion(&bounds).then(&Motion::translation(Vector::new(-bounds.min.x, 0.0)));
        let parts: Vec<Polygon> = section.parts.iter().map(|part| part.in_section().moved(&stand)).collect();
        let width = bounds.size().x;
        let length = |part: &Polygon| part.bounds().size().x;
        let near_right = parts.iter().filter(|part| width - part.bounds().max.x < length(part));
        let near_left = parts.iter().filter(|part| part.bounds().min.x < length(part));
        let mirrored: Vec<Ring> = near_left.map(|part| part.outer().moved(&Motion::mirror_x())).collect();
        Self {
            width,
            right: Border::of(&near_right.map(|part| part.outer().clone()).collect::<Vec<_>>()),
            left: Border::of(&mirrored),
        }
    }

    /// The effect when `right` is joined to the right of this.
    pub(crate) fn effect(&self, right: &Self) -> f64 {
        let ray =
            |from: &Point, to: &Border| to.reaches.x(from.y).map(|reaches| self.width - from.x - reaches);
        let rightwards = self.right.extremes.iter().filter_map(|from| ray(from, &right.left));
        let leftwards = right.left.extremes.iter().filter_map(|from| ray(from, &self.right));
        rightwards.chain(leftwards).fold(self.width, f64::min)
    }
}

impl Border {
    fn of(rings: &[Ring]) -> Self {
        let mut extremes = vec![];
        for ring in rings {
            if ring.is_counter_clockwise() {
                extremes_of(ring, &mut extremes);
            } else {
                extremes_of(&ring.reversed(), &mut extremes);
            }
        }
        Self { reaches: right_outline(rings.iter(), 0.0), extremes }
    }
}

/// Local maxima in x of the chain from a counter-clockwise ring's lowest to its highest point.
fn extremes_of(ring: &Ring, extremes: &mut Vec<Point>) {
    let vertices = ring.vertices();
    let count = vertices.len();
    let further_right = |a: Point, b: Point| a.x.total_cmp(&b.x);
    let lowest = (0..count).min_by(|&a, &b| {
        vertices[a].y.total_cmp(&vertices[b].y).then(further_right(vertices[b], vertices[a]))
    });
    let highest = (0..count).max_by(|&a, &b| {
        vertices[a].y.total_cmp(&vertices[b].y).then(further_right(vertices[a], vertices[b]))
    });
    let (Some(lowest), Some(highest)) = (lowest, highest) else { return };
    let chain: Vec<usize> = (lowest..).map(|at| at % count).take_while(|&at| at != highest).collect();
    let mut points: Vec<Point> = vec![];
    for &at in &chain {
        points.push(vertices[at]);
        if let Edge::Arc(arc) = ring.edge(at) {
            let rightmost = Point::new(arc.center.x + arc.radius, arc.center.y);
            let leftmost = Point::new(arc.center.x - arc.radius, arc.center.y);
            // Where the arc is steepest, it has an extreme of its own.
            if arc.sweep > 0.0 && arc.spans(Vector::new(1.0, 0.0)) {
                points.push(rightmost);
            } else if arc.sweep < 0.0 && arc.spans(Vector::new(-1.0, 0.0)) {
                points.push(leftmost);
            }
        }
    }
    points.push(vertices[highest]);
    for (at, point) in points.iter().enumerate() {
        let before = at.checked_sub(1).map(|before| points[before]);
        let after = points.get(at + 1).copied();
        // A vertical edge counts as an extreme when nothing beside it reaches further.
        if [before, after].into_iter().flatten().all(|beside| beside.x <= point.x) {
            extremes.push(*point);
        }
    }
}

/// The effect as published in 2009, millimetres, 0 or more, at most the left section's width: too large where borders
/// come nearest between extremes. The gap plays no part: it stands between the boxes before and after.
#[must_use]
pub fn published_effect(left: (&Section, Pose), right: (&Section, Pose)) -> f64 {
    Facing::of(left.0, left.1).effect(&Facing::of(right.0, right.1))
}
