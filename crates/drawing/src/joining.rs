//! Joins the curves of one layer to loops.
//!
//! Ends within the tolerance become one vertex, shared bit for bit; arcs stay arcs. Nothing is guessed: where three
//! ends meet, or a chain stays open, a finding says so. Cost: linear but for sorting.

mod chain;
mod duplicate;
mod snap;

use crate::{Curve, DrawingFinding, Fault};
use chain::{Chain, chains};
use snap::snap;
use traverse_geometry::{Bounds, Edge, Point};

/// Ends no farther apart than this are joined unless asked otherwise, millimetres: above what CAD programs round to,
/// below what a cut shows.
pub const JOIN_TOLERANCE_MM: f64 = 0.01;

/// A closed chain of straight and circular edges, joined but not yet validated.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// At least 2; the first is not repeated.
    pub vertices: Vec<Point>,
    /// tan(sweep / 4) of the edge that leaves each vertex, within [−1, 1]; one per vertex.
    pub bulges: Vec<f64>,
    /// Place of its first curve on the layer: the order of loops.
    pub first_curve: usize,
    /// How far at most it runs from what was drawn, millimetres.
    pub deviation_mm: f64,
}

/// The loops of a layer and what could not be joined.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joined {
    /// In the order of their first curves.
    pub loops: Vec<Loop>,
    /// Open chains, junctions, duplicates, curves that are too short.
    pub findings: Vec<DrawingFinding>,
    /// Curves, by place on the layer, that belong to open chains. Sorted.
    pub open_curves: Vec<usize>,
    /// Curves, by place on the layer, that repeat others and were left out. Sorted.
    pub repeated_curves: Vec<usize>,
}

impl Loop {
    /// Edges from vertex to vertex, the last one back to the first.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let next = self.vertices.iter().cycle().skip(1);
        self.vertices
            .iter()
            .zip(&self.bulges)
            .zip(next)
            .map(|((&a, &bulge), &b)| Edge::from_bulge(a, b, if a == b { 0.0 } else { bulge }))
    }

    /// Millimetres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }

    /// Enclosed area, square millimetres, whichever way the loop runs.
    #[must_use]
    pub fn area(&self) -> f64 {
        let Some(&origin) = self.vertices.first() else { return 0.0 };
        let signed = |edge: Edge| {
            let chord = traverse_geometry::cross(edge.start() - origin, edge.end() - origin) / 2.0;
            match edge {
                Edge::Segment(_) => chord,
                Edge::Arc(arc) => chord + arc.radius * arc.radius * (arc.sweep - arc.sweep.sin()) / 2.0,
            }
        };
        self.edges().map(signed).sum::<f64>().abs()
    }

    /// Bounding box.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.edges().fold(Bounds::EMPTY, |bounds, edge| bounds.union(edge.bounds()))
    }

    /// A loop without edges yet.
    fn begin(first_curve: usize) -> Self {
        Self { vertices: Vec::new(), bulges: Vec::new(), first_curve, deviation_mm: 0.0 }
    }

    fn of_curve(curve: &Curve, first_curve: usize) -> Self {
        Self {
            vertices: curve.vertices.clone(),
            bulges: curve.bulges.clone(),
            first_curve,
            deviation_mm: curve.deviation_mm,
        }
    }
}

/// Joins `curves`, all of one layer, to loops. Closed curves are loops by themselves.
///
/// The result does not depend on the order or direction of the curves but for where each loop begins, which way it
/// runs and in which order the loops come. A curve that is none (fewer than 2 vertices, or not one bulge for each) is
/// skipped, one with a number that is not finite is a finding. A tolerance that is not positive is 0.
#[must_use]
pub fn join_loops(layer: &str, curves: &[Curve], tolerance_mm: f64) -> Joined {
    let mut joined = Joined::default();
    let mut report = |curve: usize, place: Point, fault: Fault| {
        joined.findings.push(DrawingFinding::new(layer, &curves[curve].source, place, fault));
    };
    // Also where it is no number.
    let tolerance_mm = if tolerance_mm > 0.0 { tolerance_mm } else { 0.0 };

    let mut sound: Vec<usize> = Vec::with_capacity(curves.len());
    for (i, curve) in curves.iter().enumerate().filter(|(_, curve)| curve.is_whole()) {
        if curve.is_finite() {
            sound.push(i);
        } else {
            let place = curve.vertices.iter().find(|p| p.iter().all(|number| number.is_finite()));
            report(i, place.copied().unwrap_or_default(), Fault::NotFinite);
        }
    }
    let (closed, open): (Vec<usize>, Vec<usize>) = sound.iter().partition(|&&i| curves[i].closed);
    let ends: Vec<Point> = open
        .iter()
        .flat_map(|&i| [curves[i].vertices[0], curves[i].vertices[curves[i].vertices.len() - 1]])
        .collect();
    let snapped = snap(&ends, tolerance_mm);
    let mut links = Vec::with_capacity(open.len());
    let mut loops: Vec<Loop> = Vec::new();
    for (slot, &curve) in open.iter().enumerate() {
        let [from, to] = [snapped.vertex_of[2 * slot], snapped.vertex_of[2 * slot + 1]];
        if from != to {
            links.push(chain::Link { curve, from, to });
        } else if curves[curve].length() <= 4.0 * tolerance_mm {
            report(curve, ends[2 * slot], Fault::TooShort { length_mm: curves[curve].length() });
        } else {
            loops.extend(chain::closed_by_itself(&curves[curve], curve, snapped.vertices[from]));
        }
    }
    let mut repeated = Vec::new();
    let links = duplicate::without_repeated_links(links, curves, tolerance_mm, &mut |curve| {
        report(curve, curves[curve].vertices[0], Fault::Duplicate);
        repeated.push(curve);
    });
    let found = chains(&links, snapped.vertices.len());
    for (vertex, link) in found.junctions {
        let fault = Fault::Junction { ends: found.ends[vertex] };
        report(links[link].curve, snapped.vertices[vertex], fault);
    }
    for chain in &found.chains {
        if chain.closed {
            loops.push(chain.to_loop(&links, curves, &snapped.vertices));
            continue;
        }
        joined.open_curves.extend(chain.steps.iter().map(|step| links[step.link].curve));
        if let Some((place, fault)) = open_chain(chain, &links, curves, &snapped.vertices, &found.ends) {
            report(links[chain.steps[0].link].curve, place, fault);
        }
    }
    loops.extend(closed.into_iter().map(|i| Loop::of_curve(&curves[i], i)));
    joined.open_curves.sort_unstable();
    loops.sort_by_key(|each| each.first_curve);
    joined.loops = duplicate::without_repeated_loops(loops, tolerance_mm, &mut |each| {
        report(each.first_curve, each.vertices[0], Fault::Duplicate);
        repeated.push(each.first_curve);
    });
    repeated.sort_unstable();
    joined.repeated_curves = repeated;
    joined
}

/// What to say of an open chain: nothing when both its ends lie on junctions, which are reported anyway.
fn open_chain(
    chain: &Chain,
    links: &[chain::Link],
    curves: &[Curve],
    vertices: &[Point],
    ends: &[usize],
) -> Option<(Point, Fault)> {
    let (first, last) = chain.ends(links);
    let (loose, other) = if ends[last] == 1 { (last, first) } else { (first, last) };
    if ends[loose] != 1 {
        return None;
    }
    let length_mm = chain.steps.iter().map(|step| curves[links[step.link].curve].length()).sum();
    let (place, other_end) = (vertices[loose], vertices[other]);
    Some((place, Fault::OpenChain { other_end, gap_mm: (place - other_end).norm(), length_mm }))
}
