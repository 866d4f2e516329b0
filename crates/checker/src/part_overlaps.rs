//! Parts of one section that lie in one another.

use crate::posed_section::PosedSection;
use crate::section_pair::SectionPair;
use std::collections::BTreeSet;
use traverse_geometry::{Point, Pose, Section};

/// Most overlaps that are listed for one section.
pub const OVERLAP_LIMIT: usize = 100;

/// Two parts of a section that lie in one another.
#[derive(Clone, Debug, PartialEq)]
pub struct PartOverlap {
    /// The part that comes first in the section.
    pub first: usize,
    /// The other one.
    pub second: usize,
    /// How deep, millimetres.
    pub depth_mm: f64,
    /// Where, in the section's coordinates.
    pub at: Point,
}

/// Every two parts of `section` that lie in one another by more than `tolerance_mm`, at most [`OVERLAP_LIMIT`]. Touching
/// is no overlap. Given up when `go_on` says no: then there is no answer. Cost: O(n log n + what touches) for n
/// vertices, and the pairs of parts whose boxes lie over one another.
#[must_use]
pub fn part_overlaps_while(
    section: &Section,
    tolerance_mm: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<PartOverlap>> {
    let posed = PosedSection::new(section, Pose::AsIs, 0.0, go_on)?;
    let pair = SectionPair { first: &posed, second: &posed, shift: 0.0, tolerance: tolerance_mm, go_on };
    let solids = &posed.boundary.solids;
    let mut from_left: Vec<u32> = (0..solids.len() as u32).collect();
    let bounds = |part: u32| &solids[part as usize].bounds;
    from_left.sort_by(|&a, &b| bounds(a).min.x.total_cmp(&bounds(b).min.x));
    let mut active: Vec<u32> = Vec::new();
    let mut found = Vec::new();
    for part in from_left {
        if !go_on() {
            return None;
        }
        active.retain(|&earlier| bounds(earlier).max.x > bounds(part).min.x);
        let beside: Vec<u32> =
            active.iter().copied().filter(|&earlier| bounds(earlier).meets(bounds(part))).collect();
        active.push(part);
        if beside.is_empty() {
            continue;
        }
        let touched = touched_by(&posed, part, tolerance_mm, go_on);
        for earlier in beside {
            let (first, second) = (earlier.min(part), earlier.max(part));
            if let Some(nearest) = pair.overlap(first, second, touched.contains(&earlier)) {
                found.push(PartOverlap {
                    first: first as usize,
                    second: second as usize,
                    depth_mm: -nearest.distance,
                    at: Point::new(nearest.at.x + section.bounds().min.x, nearest.at.y),
                });
            }
            if !go_on() {
                return None;
            }
            if found.len() == OVERLAP_LIMIT {
                return Some(found);
            }
        }
    }
    found.sort_by_key(|overlap| (overlap.first, overlap.second));
    Some(found)
}

/// The parts whose borders the border of `part` touches.
fn touched_by(posed: &PosedSection, part: u32, tolerance: f64, go_on: &dyn Fn() -> bool) -> BTreeSet<u32> {
    let around = posed.around(tolerance, go_on);
    let edges = posed.boundary.solids[part as usize].edges.clone();
    let approaches =
        edges.take_while(|_| go_on()).flat_map(|edge| around.approaches(&posed.boundary.curve(edge)));
    approaches
        .filter(|(other, found)| *other != part && !found.touched.is_empty())
        .map(|(other, _)| other)
        .collect()
}
