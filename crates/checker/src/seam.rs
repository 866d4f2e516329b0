//! At clearance 0: whether a step runs along a seam, where two obstacles (or parts of one) touch along an edge.
//!
//! Across the step, between one tolerance to the left and one to the right, there must be a gap that no obstacle
//! covers. Asked in the middle of every part that has the same edges beside it and is longer than four tolerances;
//! gaps that rounding can't tell from nothing count as free.

use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::contact::coincide;
use crate::cross_cut::CrossCut;
use crate::curve::Curve;
use traverse_geometry::Point;

/// Most places of one step that are asked.
const PLACE_LIMIT: usize = 10_000;

/// Where `step` runs along a seam, and the solids on both sides; `edges` lie within `reach` of it.
pub(crate) fn seam(
    boundary: &Boundary,
    tree: &BoundaryTree,
    step: &Curve,
    edges: &[u32],
    reach: f64,
) -> Option<(Point, [u32; 2])> {
    let shortest = 4.0 * reach / step.length();
    let mut events: Vec<(f64, bool, u32)> = Vec::new();
    for &edge in edges {
        for (from, to) in step.parts_within(&boundary.curve(edge), reach) {
            if to - from > shortest {
                events.extend([(from, true, edge), (to, false, edge)]);
            }
        }
    }
    events.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut beside: Vec<u32> = Vec::new();
    let mut asked = 0;
    for (i, &(from, opens, edge)) in events.iter().enumerate() {
        if opens {
            beside.push(edge);
        } else if let Some(found) = beside.iter().position(|&other| other == edge) {
            beside.swap_remove(found);
        }
        let to = events.get(i + 1).map_or(from, |event| event.0);
        if beside.len() < 2 || to - from <= shortest || asked == PLACE_LIMIT {
            continue;
        }
        asked += 1;
        if let Some(found) = closed(boundary, tree, step, (from + to) / 2.0, &beside, reach) {
            return Some(found);
        }
    }
    None
}

/// The place at `fraction` and what lies on both sides, when nothing is free there.
fn closed(
    boundary: &Boundary,
    tree: &BoundaryTree,
    step: &Curve,
    fraction: f64,
    beside: &[u32],
    reach: f64,
) -> Option<(Point, [u32; 2])> {
    let cut = CrossCut::across(boundary, step, fraction, beside, reach);
    if cut.lines.len() < 2 {
        return None;
    }
    let right = cut.cover_right(boundary, tree)?;
    let left = cut.cover_left(boundary, tree)?;
    let rounding = 16.0 * f64::EPSILON * cut.at.x.abs().max(cut.at.y.abs());
    let free_between = cut.lines.windows(2).any(|pair| {
        let gap = pair[1].offset - pair[0].offset;
        let middle = pair[0].offset + gap / 2.0;
        !coincide(&pair[0].curve, &pair[1].curve, gap)
            && (gap <= rounding || cut.cover(middle, boundary, tree).is_none())
    });
    (!free_between).then_some((cut.at, [right, left]))
}
