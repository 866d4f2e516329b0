//! What tests check the crate with: sections of chance, and distances of all pairs of edges, one by one, with none of
//! the crate's code.

#![allow(dead_code, reason = "each test file uses its part")]

use rand::{Rng, RngExt};
use traverse_geometry::{
    Edge, Motion, Part, PlacedSection, Point, Polygon, Pose, Ring, Section, SectionLayout, Segment, Vector,
    cross, unit,
};

/// Which borders sections of chance have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Borders {
    /// Straight edges of any direction.
    Straight,
    /// Straight and circular ones.
    Round,
    /// Steps: edges along the axes, whole numbers, many heights in common.
    Steps,
}

/// A section of one to three parts between heights 0 and about 20.
pub(crate) fn section(id: &str, borders: Borders, chance: &mut impl Rng) -> Section {
    let count = chance.random_range(1..=3);
    let parts =
        (0..count).map(|number| part(&format!("{id}.{number}"), borders, number, count, chance)).collect();
    Section { id: id.into(), parts, quantity: 1, poses: vec![Pose::AsIs] }
}

fn part(id: &str, borders: Borders, number: usize, count: usize, chance: &mut impl Rng) -> Part {
    let whole = chance.random_range(-3..=3);
    let (height, x) = (20.0 / count as f64, f64::from(whole));
    let center = Vector::new(x, (number as f64 + 0.5) * height);
    let ring = loop {
        let corners = chance.random_range(3..9);
        let xy: Vec<f64> = match borders {
            Borders::Steps => steps(chance),
            _ => (0..corners)
                .flat_map(|corner| {
                    let angle = std::f64::consts::TAU * (corner as f64 + chance.random_range(0.0..0.9))
                        / corners as f64;
                    let spoke = unit(angle) * chance.random_range(1.0..7.0);
                    [spoke.x, spoke.y * height / 14.0]
                })
                .collect(),
        };
        let bulges: Vec<f64> = match borders {
            Borders::Round => (0..xy.len() / 2)
                .map(|_| if chance.random_bool(0.5) { chance.random_range(-0.6..0.9) } else { 0.0 })
                .collect(),
            _ => vec![],
        };
        if let Ok(ring) = Ring::from_xy(&xy, &bulges) {
            break ring;
        }
    };
    Part {
        id: id.into(),
        shape: Polygon::from_ring(ring),
        pole: Point::from(center),
        rotation_rad: 0.0,
        mirrored: false,
    }
}

/// A stack of boxes, as one ring.
fn steps(chance: &mut impl Rng) -> Vec<f64> {
    let levels: i32 = chance.random_range(1..4);
    let (mut right, mut left) = (vec![], vec![]);
    for level in 0..levels {
        let (low, high) = (f64::from(2 * level - 3), f64::from(2 * level - 1));
        let reach = f64::from(chance.random_range(1..5));
        right.extend([reach, low, reach, high]);
        let reach = -f64::from(chance.random_range(1..5));
        left.push([reach, high, reach, low]);
    }
    right.into_iter().chain(left.into_iter().rev().flatten()).collect()
}

/// A layout of sections, kept in order, without a gap.
pub(crate) fn layout(sections: Vec<Section>) -> SectionLayout {
    SectionLayout::new(sections)
}

/// The outer rings of a section where it stands: left edge of the posed box at `x`.
pub(crate) fn standing(section: &Section, pose: Pose, x: f64) -> Vec<Ring> {
    let bounds = section.bounds();
    let motion = pose.motion(&bounds).then(&Motion::translation(Vector::new(x - bounds.min.x, 0.0)));
    section.parts.iter().map(|part| part.in_section().outer().moved(&motion)).collect()
}

/// Distance between two edges that don't cross.
fn edge_distance(a: &Edge, b: &Edge) -> f64 {
    let ends = [(a.start(), b), (a.end(), b), (b.start(), a), (b.end(), a)];
    let from_ends = ends.iter().map(|(p, edge)| edge.distance_to_point(*p)).fold(f64::INFINITY, f64::min);
    let inner = match (a, b) {
        (Edge::Segment(_), Edge::Segment(_)) => f64::INFINITY,
        (Edge::Segment(segment), Edge::Arc(arc)) | (Edge::Arc(arc), Edge::Segment(segment)) => {
            arc.distance_to_point(segment.nearest_point(arc.center))
        }
        (Edge::Arc(a), Edge::Arc(b)) => {
            let along = (b.center - a.center).try_normalize(0.0).unwrap_or_default();
            let near = |side: f64| a.nearest_point(a.center + along * side);
            b.distance_to_point(near(1.0)).min(b.distance_to_point(near(-1.0)))
        }
    };
    from_ends.min(inner)
}

/// Whether two edges cross properly, arcs taken as chains of short chords.
fn cross_properly(a: &Edge, b: &Edge) -> bool {
    let chords = |edge: &Edge| -> Vec<Segment> {
        let pieces = if matches!(edge, Edge::Arc(_)) { 16 } else { 1 };
        let at = |i: usize| edge.point_at(i as f64 / f64::from(pieces));
        (0..pieces as usize).map(|i| Segment::new(at(i), at(i + 1))).collect()
    };
    let apart = |s: &Segment, p: Point, q: Point| {
        let side = |p: Point| cross(s.vector(), p - s.start) / s.length().max(1e-9);
        (side(p) > DEEP && side(q) < -DEEP) || (side(p) < -DEEP && side(q) > DEEP)
    };
    let others = chords(b);
    chords(a).iter().any(|s| others.iter().any(|t| apart(s, t.start, t.end) && apart(t, s.start, s.end)))
}

/// Crossings less deep than this are contacts to the oracle; chords of arcs lie off by more where they touch.
const DEEP: f64 = 0.02;

/// True distance between regions; negative when one lies deep in the other.
pub(crate) fn distance(a: &[Ring], b: &[Ring]) -> f64 {
    let mut least = f64::INFINITY;
    for a in a {
        for b in b {
            let deep = |p: Point, ring: &Ring| {
                ring.locate(p) == traverse_geometry::Location::Inside && ring.distance_to_point(p) > 1e-9
            };
            let depth = |p: Point, ring: &Ring| {
                if deep(p, ring) { -ring.distance_to_point(p) } else { f64::INFINITY }
            };
            for (p, ring) in a.vertices().iter().map(|p| (p, b)).chain(b.vertices().iter().map(|p| (p, a))) {
                least = least.min(depth(*p, ring));
            }
            for e in a.edges() {
                for f in b.edges() {
                    if cross_properly(&e, &f) {
                        least = least.min(-DEEP);
                    }
                    least = least.min(edge_distance(&e, &f));
                }
            }
        }
    }
    least
}

/// Where `right`, coming from far right, is stopped by `left` at x = 0: as far left as the distance permits, again and
/// again. Nothing when it passes.
pub(crate) fn stopped(
    left: &[Ring],
    right_at: impl Fn(f64) -> Vec<Ring>,
    from: f64,
    until: f64,
    gap: f64,
) -> Option<f64> {
    let mut x = from;
    while x > until {
        let room = distance(left, &right_at(x)) - gap;
        if room < 1e-9 {
            return Some(x);
        }
        x -= room;
    }
    None
}

/// The least margin between any two placed sections: distance less gap.
pub(crate) fn least_margin(layout: &SectionLayout, placed: &[PlacedSection]) -> f64 {
    let rings: Vec<Vec<Ring>> =
        placed.iter().map(|p| standing(&layout.sections[p.section], p.pose, p.x_mm)).collect();
    let mut least = f64::INFINITY;
    for k in 0..rings.len() {
        for m in 0..k {
            least = least.min(distance(&rings[m], &rings[k]) - layout.gap_mm);
        }
    }
    least
}
