//! Loops that cross one another. They are put side by side, whatever the one point says that places them, so that every answer
//! about the drawing takes them for the same: two shapes that overlap, and not a shape with a hole.

use crate::box_pairs::meeting_boxes;
use crate::role_loops::RoleLoops;
use crate::{DrawingFinding, Fault, Forest};
use std::collections::HashMap;
use traverse_geometry::{Finding, Polygon, Reason, Ring};

/// Vertices of pairs that are looked at, at most, and for each vertex of the layer so many more: bounds the work on hostile drawings.
const WORK_LIMIT: usize = 100_000;
const WORK_LIMIT_PER_VERTEX: usize = 4;

/// Looks at pairs of loops until the work is done or its limit is reached.
struct Pairs<'g, 'a> {
    group: &'g RoleLoops<'a>,
    rings: HashMap<usize, Option<Ring>>,
    work_left: usize,
}

impl<'g, 'a> Pairs<'g, 'a> {
    fn of(group: &'g RoleLoops<'a>) -> Self {
        let vertices: usize = group.loops.iter().map(|each| each.vertices.len()).sum();
        let work_left = WORK_LIMIT + WORK_LIMIT_PER_VERTEX * vertices;
        Self { group, rings: HashMap::new(), work_left }
    }

    fn ring(&mut self, each: usize) -> Option<Ring> {
        let group = self.group;
        // What is no ring has findings already.
        self.rings.entry(each).or_insert_with(|| group.ring(each, &mut Vec::new())).clone()
    }

    /// What geometry says where the loops cross, if they do; an error past the limit.
    fn crossing(&mut self, a: usize, b: usize) -> Result<Option<Finding>, PastLimit> {
        let pair = self.group.loops[a].vertices.len() + self.group.loops[b].vertices.len();
        self.work_left = self.work_left.checked_sub(pair).ok_or(PastLimit)?;
        let (Some(outer), Some(inner)) = (self.ring(a), self.ring(b)) else { return Ok(None) };
        let why = Polygon::new(outer, vec![inner]).err().unwrap_or_default();
        Ok(why.into_iter().find(|finding| finding.reason == Reason::EdgesCross))
    }
}

/// Too many vertices to compare.
struct PastLimit;

/// The forest of the group, in which no loop lies inside one that it crosses, as far as the limit lets that be known.
pub(crate) fn beside_what_they_cross(group: &RoleLoops<'_>) -> Forest {
    let mut parents = group.forest.parents.clone();
    let mut pairs = Pairs::of(group);
    let mut from_outside: Vec<usize> = (0..parents.len()).collect();
    from_outside.sort_by_key(|&each| group.forest.depths[each]);
    for each in from_outside {
        while let Some(parent) = parents[each] {
            match pairs.crossing(parent, each) {
                Ok(Some(_)) => parents[each] = parents[parent],
                Ok(None) => break,
                Err(PastLimit) => return Forest::of_parents(parents),
            }
        }
    }
    Forest::of_parents(parents)
}

/// One finding for each two loops that cross and of which neither is directly around the other.
pub(crate) fn crossing_loops(group: &RoleLoops<'_>) -> Vec<DrawingFinding> {
    let bounds: Vec<_> = group.loops.iter().map(crate::Loop::bounds).collect();
    let spans = group.forest.spans();
    let mut pairs = Vec::new();
    let mut complete = meeting_boxes(&bounds, |a, b| {
        if !spans[a].contains(&spans[b].start) && !spans[b].contains(&spans[a].start) {
            pairs.push((a, b));
        }
    });
    pairs.sort_unstable();
    let mut looked_at = Pairs::of(group);
    let mut findings = Vec::new();
    for (a, b) in pairs {
        match looked_at.crossing(a, b) {
            Ok(None) => {}
            Ok(Some(cross)) => {
                findings.extend(group.findings_at(a, &[b], vec![cross], |_| Fault::LoopsCross));
            }
            Err(PastLimit) => {
                complete = false;
                break;
            }
        }
    }
    if let Some(first) = group.loops.first().filter(|_| !complete) {
        findings.push(group.finding(first, first.vertices[0], Fault::NotAllCompared));
    }
    findings
}
