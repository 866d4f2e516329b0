//! Parts of one section that overlap deeper than the contact tolerance.
//!
//! A sweep over heights: between two heights at which an edge begins or ends, edges are curves side by side. In their
//! order at the middle height the stretches inside each part are read off; two parts overlap when their stretches do,
//! or when the right border of one and the left border of the next come to overlap elsewhere in the band. Exact for
//! lines and arcs up to bands that are thinner than the tolerance. Cost: O(n log n + edges abreast in each band).

use crate::curve::Curve;
use std::collections::BTreeMap;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Point, Section};
use traverse_solve::{Budget, Interrupt};

/// An edge, or a part of one that runs up or down throughout.
#[derive(Clone, Copy, Debug)]
struct Border {
    low: f64,
    high: f64,
    curve: Curve,
    part: usize,
}

/// Pairs of parts (the earlier one first) that overlap, with a place where they do.
pub(crate) fn overlapping_parts(
    section: &Section,
    budget: &Budget,
) -> Result<Vec<(usize, usize, Point)>, Interrupt> {
    if section.parts.len() < 2 {
        return Ok(vec![]);
    }
    let mut borders = borders(section);
    borders.sort_by(|a, b| a.low.total_cmp(&b.low));
    let mut heights: Vec<f64> = borders.iter().flat_map(|border| [border.low, border.high]).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let mut found: BTreeMap<(usize, usize), Point> = BTreeMap::new();
    let mut abreast: Vec<Border> = vec![];
    let mut next = 0;
    for band in heights.windows(2) {
        let (low, high) = (band[0], band[1]);
        abreast.retain(|border| border.high > low);
        while let Some(border) = borders.get(next).filter(|border| border.low <= low) {
            abreast.push(*border);
            next += 1;
        }
        budget.check(0)?;
        if high - low > CONTACT_TOLERANCE_MM {
            look(&mut abreast, low, high, section.parts.len(), &mut found);
        }
    }
    Ok(found.into_iter().map(|((first, second), place)| (first, second, place)).collect())
}

fn borders(section: &Section) -> Vec<Border> {
    let mut borders = vec![];
    for (part, shape) in section.parts.iter().map(traverse_geometry::Part::in_section).enumerate() {
        for edge in shape.rings().flat_map(|ring| ring.edges().collect::<Vec<_>>()) {
            match edge {
                Edge::Segment(segment) => {
                    let (a, b) = (segment.start, segment.end);
                    if a.y != b.y {
                        let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
                        borders.push(Border {
                            low: low.y,
                            high: high.y,
                            curve: Curve::line(low, high),
                            part,
                        });
                    }
                }
                Edge::Arc(arc) => {
                    for side in [1.0, -1.0] {
                        let stretches = arc_stretches(&arc, side);
                        let curve = Curve::Arc { center: arc.center, radius: arc.radius, side };
                        borders.extend(stretches.into_iter().map(|(low, high)| Border {
                            low,
                            high,
                            curve,
                            part,
                        }));
                    }
                }
            }
        }
    }
    borders
}

/// The heights over which an arc runs on the right (1) or left (−1) half of its circle.
fn arc_stretches(arc: &traverse_geometry::Arc, side: f64) -> Vec<(f64, f64)> {
    let mut heights = vec![arc.start.y, arc.end.y];
    for direction in [1.0, -1.0] {
        if arc.spans(traverse_geometry::Vector::new(0.0, direction)) {
            heights.push(arc.center.y + direction * arc.radius);
        }
    }
    heights.sort_by(f64::total_cmp);
    let on_arc = |y: f64| {
        let rise = y - arc.center.y;
        let across = ((arc.radius - rise) * (arc.radius + rise)).max(0.0).sqrt();
        arc.spans(traverse_geometry::Vector::new(side * across, rise))
    };
    let bands = heights.windows(2).map(|band| (band[0], band[1]));
    bands.filter(|&(low, high)| low < high && on_arc(low.midpoint(high))).collect()
}

/// What overlaps in a band through which every border runs.
fn look(
    abreast: &mut [Border],
    low: f64,
    high: f64,
    parts: usize,
    found: &mut BTreeMap<(usize, usize), Point>,
) {
    let middle = low.midpoint(high);
    abreast.sort_by(|a, b| a.curve.x(middle).total_cmp(&b.curve.x(middle)));
    // For each part whether we are inside, and through which border we came in.
    let mut entered: Vec<Option<Border>> = vec![None; parts];
    let mut inside: Vec<usize> = vec![];
    let mut left_by: Option<Border> = None;
    let mut meet = |a: usize, b: usize, place: Point| {
        found.entry((a.min(b), a.max(b))).or_insert(place);
    };
    for border in abreast.iter() {
        let x = border.curve.x(middle);
        if let Some(entry) = entered[border.part].take() {
            inside.retain(|&part| part != border.part);
            for &other in &inside {
                let since =
                    entered[other].map_or(x, |other| other.curve.x(middle)).max(entry.curve.x(middle));
                if x - since > CONTACT_TOLERANCE_MM {
                    meet(other, border.part, Point::new(since.midpoint(x), middle));
                }
            }
            left_by = Some(*border);
        } else {
            if let Some(before) = left_by
                && inside.is_empty()
                && before.part != border.part
                && let Some(y) = deepest(&before.curve, &border.curve, low, high)
            {
                meet(before.part, border.part, Point::new(border.curve.x(y), y));
            }
            entered[border.part] = Some(*border);
            inside.push(border.part);
        }
    }
}

/// The height in a band at which `left` reaches furthest beyond `right`, if that is beyond the tolerance.
fn deepest(left: &Curve, right: &Curve, low: f64, high: f64) -> Option<f64> {
    let overlap = |y: f64| left.x(y) - right.x(y);
    let mirrored = match *right {
        Curve::Line { at, slope } => Curve::Line { at: Point::new(-at.x, at.y), slope: -slope },
        Curve::Arc { center, radius, side } => {
            Curve::Arc { center: Point::new(-center.x, center.y), radius, side: -side }
        }
    };
    let crest = left.crest(&mirrored).filter(|&y| low < y && y < high);
    [Some(low), Some(high), crest]
        .into_iter()
        .flatten()
        .max_by(|&a, &b| overlap(a).total_cmp(&overlap(b)))
        .filter(|&y| overlap(y) > CONTACT_TOLERANCE_MM)
}
