//! From rings to a valid [`Polygon`]: every finding at once.

use crate::area::signed_area;
use crate::box_tree::{BoxTree, Work};
use crate::crossing::{Between, Crossing, Crossings};
use crate::finding_list::FindingList;
use crate::loops::Loops;
use crate::ring_index::RingIndex;
use crate::{
    CONTACT_TOLERANCE_MM, CROSSING_WORK_LIMIT, FINDINGS_LIMIT, Finding, Location, Point, Polygon, Reason,
    Ring,
};
use std::collections::HashMap;
use std::ops::ControlFlow;

impl Polygon {
    /// The region inside `outer`, less `holes`. Orientations are free. Rings may touch each other at vertices and
    /// along edges. Cost: O(n log n) for rings whose edges lie apart, bounded by [`CROSSING_WORK_LIMIT`].
    ///
    /// # Errors
    /// Everything that is wrong, at once, at most [`FINDINGS_LIMIT`] findings and one that counts the rest. Fields
    /// are relative to the polygon's message: `holes[1]`, or `holes`. Edges are counted in the rings as they are
    /// after validation, equal vertices dropped.
    pub fn new(outer: Ring, holes: Vec<Ring>) -> Result<Self, Vec<Finding>> {
        Self::new_while(outer, holes, &|| true)
    }

    /// As [`Polygon::new`], given up when `go_on`, asked every millisecond or so, says no.
    ///
    /// # Errors
    /// As [`Polygon::new`]; when given up, something that may be wrong or not.
    pub fn new_while(outer: Ring, holes: Vec<Ring>, go_on: &dyn Fn() -> bool) -> Result<Self, Vec<Finding>> {
        if holes.is_empty() {
            return Ok(Self::trusted(outer, holes));
        }
        let mut findings = FindingList::default();
        let mut crossed = vec![false; holes.len()];
        report_crossings(&outer, &holes, &mut crossed, &mut findings, go_on);
        let mut work = Work::new(CROSSING_WORK_LIMIT, go_on);
        let outside = holes_outside(&outer, &holes, &crossed, &mut work, &mut findings);
        let nested = outside.and_then(|()| holes_in_holes(&holes, &crossed, &mut work, &mut findings));
        if nested.is_none() {
            findings.push(|| too_much_work(holes.len()));
        }
        if findings.is_empty() && leaves_nothing(&outer, &holes) {
            let message = "the holes cover the whole outer ring; leave the polygon out or send smaller holes";
            findings.push(|| Finding::new("holes", Reason::NoArea, holes.len(), message));
        }
        if findings.is_empty() {
            Ok(Self::trusted(outer, holes))
        } else {
            Err(findings.into_findings("holes"))
        }
    }
}

fn too_much_work(holes: usize) -> Finding {
    let message = format!(
        "too many edges of the outer ring and its {holes} holes lie over each other to be checked; split the polygon or \
         send fewer vertices"
    );
    Finding::new("holes", Reason::TooMany, holes, message)
}

fn report_crossings(
    outer: &Ring,
    holes: &[Ring],
    crossed: &mut [bool],
    findings: &mut FindingList,
    go_on: &dyn Fn() -> bool,
) {
    let rings = std::iter::once(outer).chain(holes);
    let loops = Loops::new(rings.map(|ring| (ring.vertices(), ring.bulges())));
    let crossings = Crossings::of(&loops, Between::Rings, go_on);
    for Crossing { edges: (a, b), at } in crossings.found {
        let hole = loops.chain(b) - 1;
        crossed[hole] = true;
        let other = match loops.chain(a) {
            0 => "the outer ring".to_owned(),
            chain => {
                crossed[chain - 1] = true;
                format!("holes[{}]", chain - 1)
            }
        };
        findings.push(|| {
            let (edge, of_other) = (loops.local(b), loops.local(a));
            let message = format!(
                "edge {edge} of holes[{hole}] crosses edge {of_other} of {other} near ({:.6}, {:.6}) mm; rings may touch \
                 but not cross: move the hole or merge it with what it crosses",
                at.x, at.y
            );
            let value = format!("edge {edge} and edge {of_other} of {other}");
            Finding::new(format!("holes[{hole}]"), Reason::EdgesCross, value, message).at(at)
        });
    }
    if crossings.list_full {
        let message =
            format!("the first {FINDINGS_LIMIT} crossings are listed, more may follow; mend these first");
        findings.push(|| Finding::new("holes", Reason::EdgesCross, FINDINGS_LIMIT, message));
    } else if crossings.too_much_work {
        findings.push(|| too_much_work(holes.len()));
    }
}

/// None: the work is spent.
fn holes_outside(
    outer: &Ring,
    holes: &[Ring],
    crossed: &[bool],
    work: &mut Work<'_>,
    findings: &mut FindingList,
) -> Option<()> {
    let index = RingIndex::new(outer, work.question());
    for (number, hole) in holes.iter().enumerate().filter(|&(number, _)| !crossed[number]) {
        if !lies_inside(hole, &index, work)? {
            findings.push(|| {
                let at = hole.vertices()[0];
                let message = format!(
                    "holes[{number}], from ({:?}, {:?}) mm on, is not inside the outer ring; leave it out, or send it as \
                     a polygon of its own",
                    at.x, at.y
                );
                Finding::new(format!("holes[{number}]"), Reason::HoleOutside, number, message).at(at)
            });
        }
    }
    Some(())
}

/// None: the work is spent.
fn holes_in_holes(
    holes: &[Ring],
    crossed: &[bool],
    work: &mut Work<'_>,
    findings: &mut FindingList,
) -> Option<()> {
    let bounds: Vec<_> = holes.iter().map(|hole| hole.bounds().grown(CONTACT_TOLERANCE_MM)).collect();
    let mut candidates = Vec::new();
    let mut indices = HashMap::new();
    let mut spent = false;
    let _ = BoxTree::new(&bounds, work.question()).pairs(work, &mut |work, a, b| {
        let (a, b) = (a.min(b), a.max(b));
        if crossed[a] || crossed[b] {
            return ControlFlow::Continue(());
        }
        for (inner, outer) in [(a, b), (b, a)] {
            let fits = bounds[outer].grown(CONTACT_TOLERANCE_MM);
            if !(fits.contains(bounds[inner].min) && fits.contains(bounds[inner].max)) {
                continue;
            }
            let index =
                indices.entry(outer).or_insert_with(|| RingIndex::new(&holes[outer], work.question()));
            match lies_inside(&holes[inner], index, work) {
                Some(true) => {
                    candidates.push((inner, outer));
                    break;
                }
                Some(false) => {}
                None => {
                    spent = true;
                    return ControlFlow::Break(());
                }
            }
        }
        if candidates.len() > FINDINGS_LIMIT { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    candidates.sort_unstable();
    for (inner, outer) in candidates {
        findings.push(|| {
            let message = format!(
                "holes[{inner}] lies inside holes[{outer}]; leave it out, or send what stands inside holes[{outer}] as a \
                 polygon of its own"
            );
            Finding::new(format!("holes[{inner}]"), Reason::HoleInHole, outer, message).at(holes[inner].vertices()[0])
        });
    }
    (!spent && !work.is_spent()).then_some(())
}

/// Whether `ring`, which does not cross the other one, lies inside it. None: the work is spent.
fn lies_inside(ring: &Ring, other: &RingIndex<'_>, work: &mut Work<'_>) -> Option<bool> {
    for &vertex in ring.vertices() {
        match other.locate(vertex, work)? {
            Location::Border => {}
            location => {
                // Arcs touch within the tolerance: a vertex that near to the border says nothing.
                if !(ring.has_arcs() || other.ring().has_arcs()) || other.is_clear(vertex, work)? {
                    return Some(location == Location::Inside);
                }
            }
        }
    }
    for edge in ring.edges() {
        let middle = edge.point_at(0.5);
        if other.is_clear(middle, work)? {
            return Some(other.locate(middle, work)? == Location::Inside);
        }
    }
    // The whole ring runs along the other one: a point between its edges decides.
    Some(other.locate(inner_point(ring, work)?, work)? == Location::Inside)
}

/// A point strictly inside `ring`, next to the middle of its longest edge; that middle when rounding leaves no room.
fn inner_point(ring: &Ring, work: &mut Work<'_>) -> Option<Point> {
    let longest = ring.edges().max_by(|a, b| a.length().total_cmp(&b.length()));
    let edge = longest.unwrap_or_else(|| ring.edge(0));
    let (middle, normal) = (edge.point_at(0.5), crate::left_of(edge.direction_at(0.5)));
    let mut step = edge.length();
    for _ in 0..40 {
        step /= 2.0;
        for p in [middle + normal * step, middle - normal * step] {
            spend(work, ring.len())?;
            if ring.locate(p) == Location::Inside {
                return Some(p);
            }
        }
    }
    Some(middle)
}

fn spend(work: &mut Work<'_>, edges: usize) -> Option<()> {
    work.spend(edges as u64).is_continue().then_some(())
}

/// Whether nothing that rounding could not explain is left of `outer`.
fn leaves_nothing(outer: &Ring, holes: &[Ring]) -> bool {
    let (area, error) = signed_area(outer.edges());
    let mut left = (area.abs(), error);
    for hole in holes {
        let (area, error) = signed_area(hole.edges());
        left = (left.0 - area.abs(), left.1 + error + f64::EPSILON * area.abs());
    }
    left.0 <= left.1
}
