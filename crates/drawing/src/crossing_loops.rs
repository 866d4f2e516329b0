//! Loops side by side that cross one another. Those that cross the loop around them are found when holes are made.

use crate::box_pairs::meeting_boxes;
use crate::role_loops::RoleLoops;
use crate::{DrawingFinding, Fault};
use std::collections::HashMap;
use traverse_geometry::{Polygon, Reason, Ring};

/// Vertices of pairs that are looked at, at most, and for each vertex of the layer so many more: bounds the work on hostile drawings.
const WORK_LIMIT: usize = 100_000;
const WORK_LIMIT_PER_VERTEX: usize = 4;

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
    let mut rings: HashMap<usize, Option<Ring>> = HashMap::new();
    let mut ring = |each: usize| {
        // What is no ring has findings already.
        rings.entry(each).or_insert_with(|| group.ring(each, &mut Vec::new())).clone()
    };
    let vertices: usize = group.loops.iter().map(|each| each.vertices.len()).sum();
    let mut work_left = WORK_LIMIT + WORK_LIMIT_PER_VERTEX * vertices;
    let mut findings = Vec::new();
    for (a, b) in pairs {
        let pair = group.loops[a].vertices.len() + group.loops[b].vertices.len();
        let Some(left) = work_left.checked_sub(pair) else {
            complete = false;
            break;
        };
        work_left = left;
        let (Some(outer), Some(inner)) = (ring(a), ring(b)) else { continue };
        let Err(why) = Polygon::new(outer, vec![inner]) else { continue };
        let cross = why.into_iter().find(|finding| finding.reason == Reason::EdgesCross);
        if let Some(cross) = cross {
            let found = group.findings_at(a, &[b], vec![cross], |_| Fault::LoopsCross);
            findings.extend(found);
        }
    }
    if let Some(first) = group.loops.first().filter(|_| !complete) {
        findings.push(group.finding(first, first.vertices[0], Fault::NotAllCompared));
    }
    findings
}
