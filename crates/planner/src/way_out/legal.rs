//! Which straight ways from an end are legal, and where an end is clear.

use super::border::crossings_with_ray;
use crate::barrier::{Blocker, Clearance, Outline};
use crate::barriers::Barriers;
use crate::standing::depth;
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Location, Point, Polygon, Segment};

/// An end inside some barriers, and what its ways keep away from.
pub(crate) struct Legal<'a> {
    pub(crate) barriers: &'a Barriers<'a>,
    pub(crate) left_out: &'a BTreeSet<usize>,
    /// Owners whose barriers hold the end, and how deep.
    pub(crate) inside: &'a [(usize, f64)],
    pub(crate) point: Point,
    /// The smaller barriers of these owners, on whose borders the end lies.
    pub(crate) smaller: Vec<Blocker>,
    /// Owners that the end touches: what is kept of them is that they are not entered.
    pub(crate) touched: Vec<usize>,
}

impl<'a> Legal<'a> {
    pub(crate) fn new(
        barriers: &'a Barriers<'a>,
        left_out: &'a BTreeSet<usize>,
        inside: &'a [(usize, f64)],
        point: Point,
    ) -> Self {
        let (mut smaller, mut touched) = (Vec::new(), Vec::new());
        for &(owner, depth) in inside {
            let clearance = barriers.clearance(owner);
            let kept = clearance.asked - depth;
            if kept <= CONTACT_TOLERANCE_MM {
                touched.push(owner);
                continue;
            }
            let clearance = Clearance { asked: kept, ..clearance };
            for outline in barriers.outlines(owner) {
                Outline { clearance, ..outline }.add_blockers(&mut smaller);
            }
        }
        Self { barriers, left_out, inside, point, smaller, touched }
    }

    pub(crate) fn is_inside(&self, owner: usize) -> bool {
        self.inside.iter().any(|&(inside, _)| inside == owner)
    }

    /// Whether `end`, which a legal way reaches, is clear of every barrier.
    pub(crate) fn is_clear(&self, end: Point) -> bool {
        self.inside.iter().all(|&(owner, _)| depth(self.barriers, owner, end).is_none())
    }

    /// Whether the straight way to `end` is legal.
    pub(crate) fn reaches(&self, end: Point) -> bool {
        let way = Segment::new(self.point, end);
        let piece = Edge::Segment(way);
        if self.smaller.iter().any(|blocker| blocker.blocks(&piece)) {
            return false;
        }
        let mut free = true;
        self.barriers.blocking(&way, |blocker| {
            if self.left_out.contains(&blocker.owner) || self.is_inside(blocker.owner) {
                return ControlFlow::Continue(());
            }
            free = false;
            ControlFlow::Break(())
        });
        free && self.touched.iter().all(|&owner| !self.enters(owner, &way))
    }

    /// Whether the way runs through what the owner covers, by more than a contact tolerance: asked in the middle between
    /// any two places where it meets the border's lines and circles.
    fn enters(&self, owner: usize, way: &Segment) -> bool {
        let Some(shape) = self.barriers.shape(owner) else { return false };
        let length = way.length();
        let Some(direction) = way.vector().try_normalize(0.0) else { return false };
        let mut cuts = vec![0.0, length];
        for edge in shape.rings().flat_map(traverse_geometry::Ring::edges) {
            crossings_with_ray(&edge, way.start, direction, &mut cuts);
        }
        cuts.retain(|cut| (0.0..=length).contains(cut));
        cuts.sort_by(f64::total_cmp);
        let is_obstacle = self.barriers.obstacle(owner).is_some();
        let is_deep =
            |p: Point| covers(shape, is_obstacle, p) && shape.distance_to_border(p) > CONTACT_TOLERANCE_MM;
        // Between two places the depth is greatest in the middle, or a piece too short to tell.
        cuts.windows(2).any(|pair| is_deep(way.start + direction * f64::midpoint(pair[0], pair[1])))
    }
}

fn covers(shape: &Polygon, is_obstacle: bool, p: Point) -> bool {
    shape.locate(p) == if is_obstacle { Location::Inside } else { Location::Outside }
}
