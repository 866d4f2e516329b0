//! A smooth curve as a chain of arcs and segments.

use super::biarc::{arriving_bulge, departing_bulge, joint};
use super::follows::follows;
use super::smooth::{Smooth, end_directions};
use traverse_geometry::{Edge, FLAT_ARC_MM, Point, RADIUS_LIMIT_MM};

/// Halvings after which a piece is left as it is: too short to matter.
const DEEPEST: u32 = 48;

/// One edge instead of two is taken when it keeps within this share of the tolerance: a line drawn as a curve, or a
/// circle's arc. Such an edge may make a corner with its neighbours, of a few millionths of a radian.
const SINGLE_EDGE_SHARE: f64 = 0.01;

/// An edge: its bulge and its end.
type BulgeAndEnd = (f64, Point);

/// A chain of at most `most_edges` arcs and segments that runs within `tolerance_mm` of the curve, both ways: no
/// point of the curve is farther from the chain, and no point of the chain farther from the curve.
///
/// The chain begins at point(0); each edge is tan(sweep / 4), within [−1, 1], with its end, which is on the curve;
/// the last end is exactly point(1). Arcs meet without a corner wherever the curve has none, but for corners far
/// below the tolerance. Nothing for a curve that never leaves its start. None when more edges would be needed, or when the
/// curve holds a coordinate that is no finite number. How the distance is assured: see [`super::follows`].
pub(crate) fn fitted_edges(
    curve: &dyn Smooth,
    tolerance_mm: f64,
    most_edges: usize,
) -> Option<Vec<BulgeAndEnd>> {
    let mut edges = Vec::new();
    let mut leaves = 0;
    // The pieces still to do, the nearest to the start on top.
    let mut pieces = vec![(0.0, 1.0, DEEPEST)];
    while let Some((from, to, halvings_left)) = pieces.pop() {
        if let Some(fitted) = fitted_piece(curve, (from, to), tolerance_mm, halvings_left == 0)? {
            leaves += fitted.len().max(1);
            if leaves > most_edges {
                return None;
            }
            edges.extend(fitted.into_iter().flatten());
        } else {
            let middle = from + (to - from) / 2.0;
            pieces.push((middle, to, halvings_left - 1));
            pieces.push((from, middle, halvings_left - 1));
            // Each piece ends in an edge at least.
            if leaves + pieces.len() > most_edges.saturating_add(1) {
                return None;
            }
        }
    }
    Some(edges)
}

/// The piece as one or two edges, nothing in place of an edge without length; `Some(None)` when it must be halved.
/// None when it is not finite.
fn fitted_piece(
    curve: &dyn Smooth,
    (from, to): (f64, f64),
    tolerance_mm: f64,
    as_it_is: bool,
) -> Option<Option<Vec<Option<BulgeAndEnd>>>> {
    let (start, end) = (curve.point(from), curve.point(to));
    if !(start - end).norm_squared().is_finite() {
        return None;
    }
    let straight = || Some(vec![(start != end).then_some((0.0, end))]);
    if as_it_is || stays_near(curve, (from, to), tolerance_mm / 2.0)? {
        return Some(straight());
    }
    let keeps_within = |edge: BulgeAndEnd, share: (f64, f64), tolerance: f64| {
        let (bulge, edge_end) = edge;
        let edge = Edge::from_bulge(curve.point(share.0), edge_end, bulge);
        follows(curve, share, &edge, tolerance)
    };
    let exact = SINGLE_EDGE_SHARE * tolerance_mm;
    if keeps_within((0.0, end), (from, to), exact) {
        return Some(straight());
    }
    let Some((departure, arrival)) = end_directions(curve, from, to) else { return Some(None) };
    let chord = end - start;
    let mean = f64::midpoint(departing_bulge(departure, chord), arriving_bulge(chord, arrival));
    if let Some(arc) = usable_edge(mean, start, end)
        && keeps_within(arc, (from, to), exact)
    {
        return Some(Some(vec![Some(arc)]));
    }
    let biarc = || {
        let joint_at = from + (to - from) * joint(curve, (from, to), (departure, arrival))?;
        let met = curve.point(joint_at);
        let first = usable_edge(departing_bulge(departure, met - start), start, met)?;
        let second = usable_edge(arriving_bulge(end - met, arrival), met, end)?;
        let fits = keeps_within(first, (from, joint_at), tolerance_mm)
            && keeps_within(second, (joint_at, to), tolerance_mm);
        fits.then(|| vec![Some(first), Some(second)])
    };
    Some(biarc())
}

/// Whether the piece never leaves the ball of that radius about its start, as far as sampled; none when it is not
/// finite.
fn stays_near(curve: &dyn Smooth, (from, to): (f64, f64), radius_mm: f64) -> Option<bool> {
    let start = curve.point(from);
    let mut near = true;
    for i in 1..=8 {
        let distance = (curve.point(from + (to - from) * f64::from(i) / 8.0) - start).norm();
        if !distance.is_finite() {
            return None;
        }
        near &= distance <= radius_mm;
        if !near {
            break;
        }
    }
    Some(near)
}

/// The edge with that bulge, straight when it is flat or its radius too large; none when it turns by more than half a
/// turn or has no length.
fn usable_edge(bulge: f64, start: Point, end: Point) -> Option<BulgeAndEnd> {
    let chord = (end - start).norm();
    if bulge.abs() * chord / 2.0 <= FLAT_ARC_MM
        || chord * (1.0 + bulge * bulge) > 4.0 * bulge.abs() * RADIUS_LIMIT_MM
    {
        return (start != end).then_some((0.0, end));
    }
    (bulge.abs() <= 1.0).then_some((bulge, end))
}

#[cfg(test)]
mod tests;
