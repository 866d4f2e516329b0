//! A smooth curve as a chain of arcs and segments.

use super::biarc::{arriving_bulge, departing_bulge, joint};
use super::follows::follows;
use super::smooth::Smooth;
use super::station::{Station, end_directions};
use super::track::Track;
use traverse_geometry::{FLAT_ARC_MM, Point, RADIUS_LIMIT_MM};

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
    curve: &impl Smooth,
    tolerance_mm: f64,
    most_edges: usize,
) -> Option<Vec<BulgeAndEnd>> {
    let mut edges = Vec::new();
    let mut leaves = 0;
    let whole =
        Piece { from: Station::at(curve, 0.0)?, to: Station::at(curve, 1.0)?, halvings_left: DEEPEST };
    // The pieces still to do, the nearest to the start on top.
    let mut pieces = vec![whole];
    while let Some(piece) = pieces.pop() {
        match fitted_piece(curve, &piece, tolerance_mm)? {
            Fitted::Edges(fitted) => {
                leaves += fitted.iter().flatten().count().max(1);
                if leaves > most_edges {
                    return None;
                }
                edges.extend(fitted.into_iter().flatten());
            }
            Fitted::Parted(middle, parts) => {
                piece.part(curve, &middle, parts, &mut pieces)?;
                // Each piece ends in an edge at least.
                if leaves + pieces.len() > most_edges.saturating_add(1) {
                    return None;
                }
            }
        }
    }
    Some(edges)
}

/// A piece of the curve still to do.
struct Piece {
    from: Station,
    to: Station,
    halvings_left: u32,
}

/// What became of a piece.
enum Fitted {
    /// One or two edges, nothing in place of an edge without length.
    Edges([Option<BulgeAndEnd>; 2]),
    /// It must be parted into so many, 2 to 4; with its middle.
    Parted(Station, u32),
}

impl Piece {
    /// Puts its parts on the pile, the first one on top. None when the curve is not finite there.
    fn part(&self, curve: &impl Smooth, middle: &Station, parts: u32, pieces: &mut Vec<Self>) -> Option<()> {
        let halvings_left = self.halvings_left.saturating_sub(if parts == 2 { 1 } else { 2 });
        let mut to = self.to;
        for i in (0..parts).rev() {
            let from = match i {
                0 => self.from,
                _ if 2 * i == parts => *middle,
                _ => Station::at(
                    curve,
                    self.from.t + (self.to.t - self.from.t) * f64::from(i) / f64::from(parts),
                )?,
            };
            pieces.push(Self { from, to, halvings_left });
            to = from;
        }
        Some(())
    }
}

/// The piece as edges, or into how many it must be parted. None when it is not finite.
fn fitted_piece(curve: &impl Smooth, piece: &Piece, tolerance_mm: f64) -> Option<Fitted> {
    let (from, to) = (&piece.from, &piece.to);
    let (start, end) = (from.point, to.point);
    let straight = Fitted::Edges([(start != end).then_some((0.0, end)), None]);
    let middle = Station::at(curve, from.t + (to.t - from.t) / 2.0)?;
    if piece.halvings_left == 0 || stays_near(curve, piece, tolerance_mm / 2.0)? {
        return Some(straight);
    }
    let keeps_within = |edge: BulgeAndEnd, tolerance: f64| {
        Track::new(start, end, edge.0).is_some_and(|track| {
            let near = |(distance, _): (f64, _)| f64::abs(distance) <= tolerance;
            track.beside(middle.point).is_some_and(near) && follows(curve, (from.t, to.t), &track, tolerance)
        })
    };
    let exact = SINGLE_EDGE_SHARE * tolerance_mm;
    if keeps_within((0.0, end), exact) {
        return Some(straight);
    }
    let Some((departure, arrival)) = end_directions(curve, from, &middle, to) else {
        return Some(Fitted::Parted(middle, 2));
    };
    let chord = end - start;
    let mean = f64::midpoint(departing_bulge(departure, chord), arriving_bulge(chord, arrival));
    if let Some(arc) = usable_edge(mean, start, end)
        && keeps_within(arc, exact)
    {
        return Some(Fitted::Edges([Some(arc), None]));
    }
    let biarc = || {
        let joint_at = from.t + (to.t - from.t) * joint(curve, [from, &middle, to], (departure, arrival))?;
        let met = curve.point(joint_at);
        let first = usable_edge(departing_bulge(departure, met - start), start, met)?;
        let second = usable_edge(arriving_bulge(end - met, arrival), met, end)?;
        let halves = [
            ((from.t, joint_at), Track::new(start, met, first.0)?),
            ((joint_at, to.t), Track::new(met, end, second.0)?),
        ];
        // Each half parts most from its arc in its middle.
        let mut farthest: f64 = 0.0;
        for ((from, to), track) in &halves {
            farthest = farthest.max(track.beside(curve.point(f64::midpoint(*from, *to)))?.0.abs());
        }
        let fits = farthest <= tolerance_mm
            && halves.iter().all(|(share, track)| follows(curve, *share, track, tolerance_mm));
        Some(if fits {
            Fitted::Edges([Some(first), Some(second)])
        } else {
            Fitted::Parted(middle, parts_for(farthest / tolerance_mm))
        })
    };
    Some(biarc().unwrap_or(Fitted::Parted(middle, 2)))
}

/// Into how many parts a piece goes whose biarc runs so many tolerances beside it: the error falls with the cube.
fn parts_for(tolerances: f64) -> u32 {
    const ROOM: f64 = 0.9;
    if tolerances <= 8.0 * ROOM {
        2
    } else if tolerances <= 27.0 * ROOM {
        3
    } else {
        4
    }
}

/// Whether the piece never leaves the ball of that radius about its start, as far as sampled; none when it is not
/// finite.
fn stays_near(curve: &impl Smooth, piece: &Piece, radius_mm: f64) -> Option<bool> {
    let (from, to) = (&piece.from, &piece.to);
    let mut near = (to.point - from.point).norm() <= radius_mm;
    for i in 1..8 {
        if !near {
            break;
        }
        let distance = (curve.point(from.t + (to.t - from.t) * f64::from(i) / 8.0) - from.point).norm();
        if !distance.is_finite() {
            return None;
        }
        near = distance <= radius_mm;
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
