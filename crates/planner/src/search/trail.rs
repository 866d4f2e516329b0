//! The trail of a label: which circles its path bends round and what it passed, to tell labels apart whose paths are the same,
//! and paths that meet themselves.

use super::Ground;
use super::label::{Label, Place, Step};
use super::stance::From;
use super::tree::Tree;
use crate::barrier::Side;
use crate::measure::Measure;
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};
use traverse_geometry::{Arc, CONTACT_TOLERANCE_MM, Edge, Point, Segment};

/// Pieces of one path nearer than this touch, millimetres.
const TOUCH_MM: f64 = 1e-9;

/// Turns that differ by less than about this are the same, radians.
const SAME_TURN_RAD: f64 = 1e-6;

/// How a label is reached.
pub(super) struct Trail {
    /// Which circles the path bends round, in order, as one number.
    bends: u64,
    /// The same, with the feature that it is at and how far it has turned there: two labels of the same key are one.
    pub(super) key: u64,
    /// How far it has turned on the last circle on the way to the feature, radians.
    turned: f64,
    /// The last circle among them.
    last: Option<(Point, f64, Side)>,
    /// What was passed since the stance before: an arc, a straight move.
    pieces: [Option<Edge>; 2],
}

impl Trail {
    /// How the label is reached; `trails` are those of the stances.
    pub(super) fn of(
        label: &Label,
        tree: &Tree<'_, impl Measure>,
        ground: &impl Ground,
        trails: &[Self],
    ) -> Self {
        let mut bends = 0;
        let mut key = u32::MAX;
        let (mut last, mut turned) = (None, 0.0);
        let mut pieces = [None, None];
        if label.step != Step::Begin {
            let before = &trails[label.parent as usize];
            bends = before.bends;
            last = before.last;
            let parent = &tree.stances[label.parent as usize];
            let leg = tree.leg(ground, label);
            let mut from = tree.start.point;
            if let From::Feature(departure) = &parent.from {
                let circle = &departure.circle;
                let spoke = leg
                    .as_ref()
                    .map_or_else(|| circle.direction_at(label.left_at), |leg| parent.from.spoke_along(leg));
                let here = departure.turned(label.left_at, spoke);
                turned = before.turned + here;
                let arrival = departure.spoke.y.atan2(departure.spoke.x);
                if here * circle.price_radius > CONTACT_TOLERANCE_MM {
                    let sweep = here * departure.lane.side.sign();
                    pieces[0] =
                        Some(Edge::Arc(Arc::from_angles(circle.center, circle.price_radius, arrival, sweep)));
                }
                from = circle.center + spoke * circle.price_radius;
            }
            if let Some(leg) = leg {
                let to = match label.place {
                    Place::Feature(feature, side) => {
                        let circle = ground.feature(feature);
                        circle.center - leg.normal * (circle.price_radius * side.sign())
                    }
                    Place::Target(_) | Place::Start(_) => tree.target.point,
                };
                let segment = Segment::new(from, to);
                pieces[1] = (segment.length() > CONTACT_TOLERANCE_MM).then_some(Edge::Segment(segment));
            }
        }
        match label.place {
            Place::Feature(feature, side) => {
                let circle = *ground.feature(feature);
                let same = last.is_some_and(|(center, radius, on): (Point, f64, Side)| {
                    on == side
                        && (radius - circle.plan_radius).abs() < CONTACT_TOLERANCE_MM
                        && (center - circle.center).norm() < CONTACT_TOLERANCE_MM
                });
                // One bend may lead over several features.
                if !(same && label.step == Step::Over) {
                    turned = 0.0;
                    let mut more = FxHasher::default();
                    bends.hash(&mut more);
                    place_of(circle.center).hash(&mut more);
                    place_of(Point::new(circle.plan_radius, 0.0)).hash(&mut more);
                    side.hash(&mut more);
                    bends = more.finish();
                }
                last = Some((circle.center, circle.plan_radius, side));
                key = feature;
            }
            Place::Start(_) | Place::Target(_) => turned = 0.0,
        }
        let mut hasher = FxHasher::default();
        (bends, key, (turned / SAME_TURN_RAD).round() as i64).hash(&mut hasher);
        Self { bends, key: hasher.finish(), turned, last, pieces }
    }

    /// Whether the last pieces of the label's path meet earlier ones.
    pub(super) fn touches_itself(
        &self,
        label: &Label,
        tree: &Tree<'_, impl Measure>,
        trails: &[Self],
    ) -> bool {
        if label.step == Step::Begin {
            return false;
        }
        let [arc, leg] = &self.pieces;
        let meets = |piece: &Option<Edge>, other: &Edge| {
            piece.as_ref().is_some_and(|piece| {
                piece.bounds().grown(TOUCH_MM).meets(&other.bounds()) && piece.distance(other) < TOUCH_MM
            })
        };
        let mut is_last = true;
        let mut at = label.parent;
        loop {
            let stance = &tree.stances[at as usize];
            let before = &trails[at as usize];
            for piece in before.pieces.iter().rev().flatten() {
                // The piece just before touches the arc, and the leg where there is no arc.
                let adjoins = std::mem::take(&mut is_last);
                if meets(arc, piece) && !adjoins || meets(leg, piece) && !(adjoins && arc.is_none()) {
                    return true;
                }
            }
            if stance.label.step == Step::Begin {
                return false;
            }
            at = stance.label.parent;
        }
    }
}

/// A place as whole numbers of contact tolerances.
fn place_of(p: Point) -> [i64; 2] {
    [p.x, p.y].map(|value| (value / CONTACT_TOLERANCE_MM).round() as i64)
}
