//! From a ring to the blockers and features of its barrier.

use super::miter::{self, Corner};
use super::{Blocker, Feature, OrientedRing};
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, CornerStyle, Edge, Orientation, Polygon, Vector, cross, left_of, orientation,
};
use traverse_solve::{Budget, Interrupt};

/// Directions that differ by less than this run on smoothly, radians: rounding, below what any tangent's direction is
/// known to. A larger turn is a corner of its own, so that no direction falls between an arc and its neighbour.
const SMOOTH_RAD: f64 = 5e-14;

/// The budget is looked at once for so many edges.
const EDGES_BETWEEN_CHECKS: usize = 4096;

/// The clearance of one barrier, and how its corners turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clearance {
    /// What was asked for, millimetres.
    pub(crate) asked: f64,
    pub(crate) style: CornerStyle,
}

impl Clearance {
    /// What is kept while planning: never below the contact tolerance.
    pub(crate) fn planned(self) -> f64 {
        if self.asked == 0.0 { CONTACT_TOLERANCE_MM } else { self.asked }
    }

    /// A move nearer than this collides.
    pub(crate) fn limit(self) -> f64 {
        self.planned() - CONTACT_TOLERANCE_MM / 2.0
    }

    /// The mitre limit where corners are mitred. Clearance 0 has no corners to mitre.
    fn miter(self) -> Option<f64> {
        match self.style {
            CornerStyle::Miter { limit } if self.asked > 0.0 => {
                Some(limit.unwrap_or(traverse_geometry::MITER_RATIO_LIMIT))
            }
            _ => None,
        }
    }
}

/// One ring with the material on the left of its edges, and the clearance kept from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline<'a> {
    pub(crate) ring: OrientedRing<'a>,
    pub(crate) clearance: Clearance,
    pub(crate) owner: usize,
}

impl<'a> Outline<'a> {
    /// Those of a polygon whose inside is the material, or leaves it free.
    pub(crate) fn of(
        polygon: &'a Polygon,
        is_material: bool,
        clearance: Clearance,
        owner: usize,
    ) -> impl Iterator<Item = Self> {
        polygon.rings().enumerate().map(move |(index, ring)| {
            let ring = OrientedRing::new(ring, (index == 0) == is_material);
            Self { ring, clearance, owner }
        })
    }

    /// Whether its blockers are others than its edges.
    pub(super) fn is_mitred(&self) -> bool {
        self.clearance.miter().is_some()
    }

    /// The blocker of edge `i`, unless it is mitred.
    pub(super) fn blocker(&self, i: usize) -> Blocker {
        Blocker { edge: self.ring.edge(i), limit: self.clearance.limit(), owner: self.owner }
    }

    /// Adds the ring's blockers. Cost: linear.
    pub(crate) fn add_blockers(&self, blockers: &mut Vec<Blocker>) {
        let (clearance, owner) = (self.clearance, self.owner);
        let Some(miter_limit) = clearance.miter() else {
            blockers.extend((0..self.ring.len()).map(|i| self.blocker(i)));
            return;
        };
        // The barrier's own border, one contact tolerance further in; half of it is kept as distance.
        let inset = clearance.asked - CONTACT_TOLERANCE_MM;
        let limit = CONTACT_TOLERANCE_MM / 2.0;
        let mut add = |edge| blockers.push(Blocker { edge, limit, owner });
        for (i, edge) in self.ring.edges().enumerate() {
            if let Some(parallel) = miter::parallel(&edge, inset) {
                add(parallel);
            }
            if let Some(corner) = self.corner_at(i) {
                corner.mitred(inset, miter_limit).edges().for_each(&mut add);
            }
        }
    }

    /// Adds the ring's features. Cost: linear.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn add_features(&self, features: &mut Vec<Feature>, budget: &Budget) -> Result<(), Interrupt> {
        let first = features.len();
        let n = self.ring.len();
        // Per edge and per corner, which features stand for its beginning and its end.
        let mut chain: Vec<Option<(usize, usize)>> = Vec::with_capacity(2 * n);
        for (i, edge) in self.ring.edges().enumerate() {
            if i % EDGES_BETWEEN_CHECKS == 0 {
                budget.check(0)?;
            }
            chain.push(self.corner_at(i).map(|corner| self.add_corner(&corner, features)));
            chain.push(self.add_arc(&edge, features));
        }
        // Neighbours on the chain go over into each other where no straight edge lies between. A corner too flat
        // to have a feature is passed over.
        let is_straight = |link: usize| link % 2 == 1 && matches!(self.ring.edge(link / 2), Edge::Segment(_));
        for link in 0..2 * n {
            let Some((_, last)) = chain[link] else { continue };
            let mut next = (link + 1) % (2 * n);
            if chain[next].is_none() && next.is_multiple_of(2) && self.is_smooth(next / 2) {
                next = (next + 1) % (2 * n);
            }
            if is_straight(next) {
                continue;
            }
            let Some((following, _)) = chain[next] else { continue };
            let is_mitred = self.clearance.miter().is_some() && (link + next) % 2 == 1;
            if is_mitred {
                // From a control point to an arc and back, half of the mitre lies between.
                features[last].straight_after = Some(following as u32);
            } else {
                features[last].after = Some(following as u32);
                features[following].before = Some(last as u32);
            }
        }
        if self.ring.touches_itself() {
            self.add_hidden_corners(features);
        }
        debug_assert!(features[first..].iter().all(|feature| feature.sweep >= 0.0));
        Ok(())
    }

    /// The corner between edge `i − 1` and edge `i`, where the barrier is convex.
    pub(super) fn corner_at(&self, i: usize) -> Option<Corner> {
        let (before, after) = self.edges_at(i);
        let (arriving, leaving) = (before.direction_at(1.0), after.direction_at(0.0));
        let turned = cross(arriving, leaving);
        let forward = arriving.dot(&leaving);
        let both_straight = matches!((before, after), (Edge::Segment(_), Edge::Segment(_)));
        let turn = if both_straight {
            match orientation(before.start(), before.end(), after.end()) {
                Orientation::Left => turned.max(0.0).atan2(forward),
                Orientation::Straight if forward < 0.0 => std::f64::consts::PI,
                Orientation::Straight | Orientation::Right => return None,
            }
        } else if turned.abs() < SMOOTH_RAD {
            // A cusp ends like a needle; where the border runs on smoothly there is no corner.
            if forward > 0.0 {
                return None;
            }
            std::f64::consts::PI
        } else if turned > 0.0 {
            turned.atan2(forward)
        } else {
            return None;
        };
        Some(Corner { vertex: after.start(), normals: [-left_of(arriving), -left_of(leaving)], turn })
    }

    fn is_smooth(&self, i: usize) -> bool {
        let (before, after) = self.edges_at(i);
        let (arriving, leaving) = (before.direction_at(1.0), after.direction_at(0.0));
        cross(arriving, leaving).abs() < SMOOTH_RAD && arriving.dot(&leaving) > 0.0
    }

    fn edges_at(&self, i: usize) -> (Edge, Edge) {
        let n = self.ring.len();
        (self.ring.edge((i + n - 1) % n), self.ring.edge(i))
    }

    /// Adds the features of a corner; answers the first and the last of them.
    fn add_corner(&self, corner: &Corner, features: &mut Vec<Feature>) -> (usize, usize) {
        let first = features.len();
        match self.clearance.miter() {
            None => features.push(self.round_corner(corner)),
            Some(limit) => {
                let mitred = corner.mitred(self.clearance.asked, limit);
                features.extend(mitred.control_points().map(|(point, from, turn)| Feature {
                    center: point,
                    plan_radius: 0.0,
                    price_radius: 0.0,
                    ..self.feature(point, from, turn)
                }));
            }
        }
        (first, features.len() - 1)
    }

    fn round_corner(&self, corner: &Corner) -> Feature {
        self.feature(corner.vertex, corner.normals[0], corner.turn)
    }

    fn feature(&self, center: traverse_geometry::Point, from: Vector, sweep: f64) -> Feature {
        Feature {
            center,
            plan_radius: self.clearance.planned(),
            price_radius: self.clearance.asked,
            start_angle: from.y.atan2(from.x),
            sweep,
            before: None,
            after: None,
            straight_after: None,
            owner: self.owner,
        }
    }

    /// Adds the feature of a circular edge that is convex from outside. A hollow one never bends a path.
    fn add_arc(&self, edge: &Edge, features: &mut Vec<Feature>) -> Option<(usize, usize)> {
        let Edge::Arc(arc) = edge else { return None };
        if arc.sweep <= 0.0 {
            return None;
        }
        let index = features.len();
        features.push(Feature {
            plan_radius: arc.radius + self.clearance.planned(),
            price_radius: arc.radius + self.clearance.asked,
            start_angle: arc.start_angle,
            ..self.feature(arc.center, arc.start - arc.center, arc.sweep)
        });
        Some((index, index))
    }

    /// Where a ring touches itself, the outside may lie on the left of some of its edges: corners that look hollow
    /// can bend a path there. Those inside the material are never reached.
    fn add_hidden_corners(&self, features: &mut Vec<Feature>) {
        for i in 0..self.ring.len() {
            let (before, after) = self.edges_at(i);
            let (arriving, leaving) = (before.direction_at(1.0), after.direction_at(0.0));
            let turned = cross(arriving, leaving);
            if turned < 0.0 {
                let turn = (-turned).atan2(arriving.dot(&leaving));
                let corner =
                    Corner { vertex: after.start(), normals: [left_of(leaving), left_of(arriving)], turn };
                self.add_corner(&corner, features);
            }
        }
    }
}
