//! Curves that run along one another: a machine would cut there twice.

use crate::box_pairs::meeting_boxes;
use crate::{Curve, DrawingFinding, Fault};
use std::collections::BTreeMap;
use traverse_geometry::{Arc, Edge, Point, Segment, cross, positive_angle, unit};

/// What runs along another curve for less than this many joining tolerances only meets it.
const SHORTEST_OVERLAP: f64 = 10.0;

/// What leans more than this from a line leaves it, from one side to the other, within [`SHORTEST_OVERLAP`]: the sine
/// of the angle, and some.
const LARGEST_SINE: f64 = 2.2 / SHORTEST_OVERLAP;

/// A stretch that two edges share.
struct Shared {
    middle: Point,
    length_mm: f64,
}

/// One finding for each two of the `curves` of a layer that run along one another, at their longest shared stretch.
/// Curves in `left_out` are not looked at. Two curves lie on one another where they are no farther apart than
/// `tolerance_mm`. Cost: as [`meeting_boxes`].
pub(crate) fn overlaps(
    layer: &str,
    curves: &[Curve],
    left_out: &[usize],
    tolerance_mm: f64,
) -> Vec<DrawingFinding> {
    let mut edges: Vec<(usize, Edge)> = Vec::new();
    for (place, curve) in
        curves.iter().enumerate().filter(|(place, _)| left_out.binary_search(place).is_err())
    {
        edges.extend(curve.edges().map(|edge| (place, edge)));
    }
    let boxes: Vec<_> = edges.iter().map(|(_, edge)| edge.bounds().grown(tolerance_mm)).collect();
    let mut found: BTreeMap<(usize, usize), (Shared, f64)> = BTreeMap::new();
    let complete = meeting_boxes(&boxes, |a, b| {
        let ((one, first), (other, second)) = (&edges[a], &edges[b]);
        if one == other {
            return;
        }
        let Some(shared) = shared(first, second, tolerance_mm) else { return };
        if shared.length_mm <= SHORTEST_OVERLAP * tolerance_mm {
            return;
        }
        let pair = (*one.min(other), *one.max(other));
        let length_mm = shared.length_mm;
        let (longest, sum) = found.entry(pair).or_insert((Shared { length_mm: 0.0, ..shared }, 0.0));
        *sum += length_mm;
        if length_mm > longest.length_mm {
            *longest = shared;
        }
    });
    let finding =
        |curve: usize, place, fault| DrawingFinding::new(layer, &curves[curve].source, place, fault);
    let overlap = |((_, second), (longest, length_mm)): ((usize, usize), (Shared, f64))| {
        finding(second, longest.middle, Fault::Overlap { length_mm })
    };
    let mut findings: Vec<DrawingFinding> = found.into_iter().map(overlap).collect();
    if let Some(&(curve, edge)) = edges.first().filter(|_| !complete) {
        findings.push(finding(curve, edge.start(), Fault::NotAllCompared));
    }
    findings
}

/// The stretch on which both edges lie on one another.
fn shared(one: &Edge, other: &Edge, tolerance_mm: f64) -> Option<Shared> {
    match (one, other) {
        (Edge::Segment(one), Edge::Segment(other)) => shared_line(one, other, tolerance_mm),
        (Edge::Arc(one), Edge::Arc(other)) => shared_arc(one, other, tolerance_mm),
        _ => None,
    }
}

fn shared_line(one: &Segment, other: &Segment, tolerance_mm: f64) -> Option<Shared> {
    let (a, b) = (one.vector(), other.vector());
    let leaning = cross(a, b);
    if leaning * leaning > LARGEST_SINE * LARGEST_SINE * a.norm_squared() * b.norm_squared() {
        return None;
    }
    let length = one.length();
    let along = one.vector() / length;
    let place = |p: Point| ((p - one.start).dot(&along), cross(along, p - one.start));
    let ((from, off_from), (to, off_to)) = (place(other.start), place(other.end));
    let (low, high) = (from.min(to).max(0.0), from.max(to).min(length));
    // Distance from the line grows evenly from one end to the other.
    let off_at = |at: f64| off_from + (off_to - off_from) * (at - from) / (to - from);
    let near = low < high && off_at(low).abs().max(off_at(high).abs()) <= tolerance_mm;
    near.then(|| Shared { middle: one.start + along * ((low + high) / 2.0), length_mm: high - low })
}

fn shared_arc(one: &Arc, other: &Arc, tolerance_mm: f64) -> Option<Shared> {
    if (one.center - other.center).norm() + (one.radius - other.radius).abs() > tolerance_mm {
        return None;
    }
    let counter_clockwise = |arc: &Arc| {
        let start = if arc.sweep > 0.0 { arc.start_angle } else { arc.start_angle + arc.sweep };
        (start, arc.sweep.abs())
    };
    let ((start, sweep), (other_start, other_sweep)) = (counter_clockwise(one), counter_clockwise(other));
    // Where the other one begins on the first: no arc is more than half a turn, so they share one stretch at most
    // unless both are half turns that meet at both ends.
    let offset = positive_angle(other_start - start);
    let (low, high) = if offset < sweep {
        (offset, sweep.min(offset + other_sweep))
    } else {
        (0.0, sweep.min(offset + other_sweep - std::f64::consts::TAU))
    };
    (low < high).then(|| Shared {
        middle: one.center + unit(start + (low + high) / 2.0) * one.radius,
        length_mm: (high - low) * one.radius,
    })
}
