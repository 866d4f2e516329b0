//! A ring with a tree over its edges: many locations in far less than linear time each.

use crate::box_tree::{BoxTree, Work};
use crate::location::Winding;
use crate::{Bounds, CONTACT_TOLERANCE_MM, Location, Point, Ring};
use std::ops::ControlFlow;

pub(crate) struct RingIndex<'a> {
    ring: &'a Ring,
    tree: BoxTree,
}

impl<'a> RingIndex<'a> {
    pub(crate) fn new(ring: &'a Ring, go_on: &dyn Fn() -> bool) -> Self {
        // Arcs count as border within their rounding error, which stays below the tolerance.
        let boxes: Vec<_> = ring.edges().map(|edge| edge.bounds().grown(CONTACT_TOLERANCE_MM)).collect();
        Self { ring, tree: BoxTree::new(&boxes, go_on) }
    }

    pub(crate) fn ring(&self) -> &'a Ring {
        self.ring
    }

    /// As [`Ring::locate`]; nothing when the work is spent.
    pub(crate) fn locate(&self, p: Point, work: &mut Work<'_>) -> Option<Location> {
        let ray = Bounds { min: p, max: Point::new(f64::INFINITY, p.y) };
        let mut winding = Winding::around(p);
        match self.tree.meeting(&ray, work, &mut |i| winding.pass_edge(self.ring, i)) {
            ControlFlow::Continue(()) => Some(winding.location()),
            ControlFlow::Break(()) => None,
        }
    }

    /// Whether `p` lies further from the ring than touching explains; nothing when the work is spent.
    pub(crate) fn is_clear(&self, p: Point, work: &mut Work<'_>) -> Option<bool> {
        let near = Bounds::of([p]).grown(CONTACT_TOLERANCE_MM);
        let mut clear = true;
        let outcome = self.tree.meeting(&near, work, &mut |i| {
            clear &= self.ring.edge(i).distance_to_point(p) > CONTACT_TOLERANCE_MM;
        });
        outcome.is_continue().then_some(clear)
    }
}
