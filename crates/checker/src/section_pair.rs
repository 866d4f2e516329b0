//! How near two sections come to one another, and how deep one lies in the other.
//!
//! Borders of parts are measured against borders by exact distances between edges. Parts whose borders touch are
//! pressed against each other both ways: every piece of the one's border inside the other and farther than the tolerance from
//! its border counts by its depth, and so do points well inside. Parts whose borders do not touch are apart or one in
//! the other: one vertex tells.

use crate::arc_distance::Nearest;
use crate::clearance::nearer;
use crate::curve::{Circular, Curve, Straight};
use crate::inside::is_inside;
use crate::posed_section::PosedSection;
use std::collections::BTreeSet;
use traverse_geometry::{Bounds, Point, Vector};

/// The worst between two sections.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    /// Distance less the gap; inside, minus the depth less the gap. And where, in the first section's coordinates.
    pub(crate) nearest: Nearest,
    /// Part of the first and of the second section.
    pub(crate) parts: [u32; 2],
    /// Whether one part lies in the other.
    pub(crate) is_overlap: bool,
}

/// Two sections, the second one `shift` to the right of the first.
pub(crate) struct SectionPair<'a> {
    pub(crate) first: &'a PosedSection,
    pub(crate) second: &'a PosedSection,
    pub(crate) shift: f64,
    pub(crate) tolerance: f64,
    pub(crate) go_on: &'a dyn Fn() -> bool,
}

impl SectionPair<'_> {
    /// The worst between both, if its margin is below `most` or the tolerance. Cost: for every edge of the second near
    /// the first O(log n + what it touches).
    pub(crate) fn worst(&self, most: f64) -> Option<Meeting> {
        let around = self.first.around(self.tolerance, self.go_on);
        let shift = Vector::new(self.shift, 0.0);
        let gap = self.first.boundary.solids.first().map_or(0.0, |solid| solid.clearance);
        let mut worst: Option<Meeting> = None;
        let mut limit = most;
        for (part, solid) in self.second.boundary.solids.iter().enumerate() {
            let part = part as u32;
            let near = |bounds: &Bounds, limit: f64| {
                apart(bounds, &self.first.bounds) - gap <= limit.max(self.tolerance)
            };
            if !near(&moved(&solid.bounds, shift), limit) {
                continue;
            }
            let mut touched = BTreeSet::new();
            for edge in solid.edges.clone() {
                let curve = shifted(&self.second.boundary.curve(edge), shift);
                if !near(&curve.bounds(), limit) {
                    continue;
                }
                if !(self.go_on)() {
                    return None;
                }
                for (other, approach) in around.approaches(&curve) {
                    if !approach.touched.is_empty() {
                        touched.insert(other);
                    }
                    if let Some(nearest) = approach.worst {
                        keep(&mut worst, Meeting { nearest, parts: [other, part], is_overlap: false });
                    }
                }
                // What is farther than the tolerance but nearer than anything so far.
                let so_far = worst.map_or(limit, |worst| worst.nearest.distance.min(limit));
                if so_far > 0.0
                    && let Some(distance) = around.least_margin(&curve, so_far, &|_| true)
                {
                    limit = limit.min(distance);
                    let nearest = Nearest { distance, at: curve.start() };
                    keep(&mut worst, Meeting { nearest, parts: [0, part], is_overlap: false });
                }
            }
            for (other, fixed) in self.first.boundary.solids.iter().enumerate() {
                if !moved(&solid.bounds, shift).meets(&fixed.bounds) {
                    continue;
                }
                if !(self.go_on)() {
                    return None;
                }
                let other = other as u32;
                if let Some(nearest) = self.overlap(other, part, touched.contains(&other)) {
                    keep(&mut worst, Meeting { nearest, parts: [other, part], is_overlap: true });
                }
            }
        }
        worst
    }

    /// How deep part `one` of the first and part `other` of the second section lie in each other.
    pub(crate) fn overlap(&self, one: u32, other: u32, do_touch: bool) -> Option<Nearest> {
        let shift = Vector::new(self.shift, 0.0);
        let there = Side { fixed: self.first, part: one, mover: self.second, moved_part: other, shift };
        let back =
            Side { fixed: self.second, part: other, mover: self.first, moved_part: one, shift: -shift };
        let into_first = there.deepest(do_touch, self.tolerance, self.go_on);
        let into_second = back.deepest(do_touch, self.tolerance, self.go_on);
        nearer(into_first, into_second.map(|nearest| Nearest { at: nearest.at + shift, ..nearest }))
    }
}

/// One part pressed into another.
struct Side<'a> {
    fixed: &'a PosedSection,
    part: u32,
    mover: &'a PosedSection,
    moved_part: u32,
    /// From the mover's coordinates to those of what it is pressed into.
    shift: Vector,
}

impl Side<'_> {
    /// The deepest place of the moved part in the fixed one; none: it is not inside by more than the tolerance.
    fn deepest(&self, do_touch: bool, tolerance: f64, go_on: &dyn Fn() -> bool) -> Option<Nearest> {
        let around = self.fixed.around(tolerance, go_on);
        let Self { fixed, part, mover, moved_part, shift } = *self;
        let holds = |p: Point| is_inside(&fixed.boundary, &fixed.tree, p, part);
        let bounds = &fixed.boundary.solids[part as usize].bounds;
        let edges = mover.boundary.solids[moved_part as usize].edges.clone();
        let curve = |edge: u32| shifted(&mover.boundary.curve(edge), shift);
        let mut worst: Option<Nearest> = None;
        if !do_touch && !holds(curve(edges.start).start()) {
            return None;
        }
        for edge in edges {
            if !go_on() {
                return None;
            }
            let curve = curve(edge);
            if !curve.bounds().meets(bounds) {
                continue;
            }
            let touched: Vec<u32> = match do_touch {
                true => {
                    around.approaches(&curve).remove(&part).map(|found| found.touched).unwrap_or_default()
                }
                false => Vec::new(),
            };
            let parts = around.parts_inside(&curve, part, &touched);
            worst = nearer(worst, around.deepest(&curve, part, &parts));
            // Corners are where parts lie deepest.
            if parts.first().is_some_and(|part| part.0 == 0.0) {
                let corner = Curve::straight(curve.start(), curve.start());
                worst = nearer(worst, around.deepest(&corner, part, &[(0.0, 1.0)]));
            }
        }
        for &witness in &mover.witnesses[moved_part as usize] {
            let at = witness + shift;
            if bounds.contains(at) && holds(at) {
                let point = Curve::straight(at, at);
                worst = nearer(worst, around.deepest(&point, part, &[(0.0, 1.0)]));
            }
        }
        let clearance = fixed.boundary.solids[part as usize].clearance;
        worst.filter(|worst| -worst.distance - clearance > tolerance)
    }
}

fn keep(worst: &mut Option<Meeting>, next: Meeting) {
    if worst.is_none_or(|worst| next.nearest.distance < worst.nearest.distance) {
        *worst = Some(next);
    }
}

/// Distance between two boxes.
pub(crate) fn apart(one: &Bounds, other: &Bounds) -> f64 {
    (one.min - other.max).sup(&(other.min - one.max)).sup(&Vector::zeros()).norm()
}

fn moved(bounds: &Bounds, by: Vector) -> Bounds {
    Bounds { min: bounds.min + by, max: bounds.max + by }
}

fn shifted(curve: &Curve, by: Vector) -> Curve {
    match *curve {
        Curve::Straight(Straight { a, b }) => Curve::straight(a + by, b + by),
        Curve::Circular(arc) => {
            Curve::Circular(Circular { center: arc.center + by, a: arc.a + by, b: arc.b + by, ..arc })
        }
    }
}
