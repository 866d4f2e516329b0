//! From numbers to a valid [`Ring`]: every finding at once.

use crate::area::encloses_nothing;
use crate::chain_input::{ChainInput, Closure};
use crate::crossing::{Between, Crossings};
use crate::loops::Loops;
use crate::{FINDINGS_LIMIT, Finding, Point, Reason, Ring};

impl Ring {
    /// A ring through `vertices`, edge `i` with `bulges[i]` (none: all straight).
    ///
    /// Consecutive equal vertices are dropped, with the bulge of the edge between them; arcs with a rise below
    /// [`crate::FLAT_ARC_MM`] become straight; −0.0 becomes 0.0. The ring may touch itself, at vertices and along
    /// edges; where it passes through itself is decided exactly for straight edges and to
    /// [`crate::CONTACT_TOLERANCE_MM`] where arcs take part. Cost: O(n log n) for edges that lie apart, bounded by
    /// [`crate::CROSSING_WORK_LIMIT`].
    ///
    /// # Errors
    /// Everything that is wrong, at once, at most [`FINDINGS_LIMIT`] findings and one that counts the rest. Fields
    /// are relative to the ring's message: `xy_mm`, `xy_mm[4]`, `bulges`, `bulges[2]`. Edges carry the number of the
    /// vertex from which they run in the input. Crossings are looked for when every number is good.
    pub fn new(vertices: Vec<Point>, bulges: Vec<f64>) -> Result<Self, Vec<Finding>> {
        validated(ChainInput::from_vertices(vertices, bulges, Closure::Closed), &|| true)
    }

    /// A ring from x0, y0, x1, y1, … as they are on the wire; otherwise as [`Ring::new`].
    ///
    /// # Errors
    /// As [`Ring::new`], and an odd count of numbers.
    pub fn from_xy(xy_mm: &[f64], bulges: &[f64]) -> Result<Self, Vec<Finding>> {
        Self::from_xy_while(xy_mm, bulges, &|| true)
    }

    /// As [`Ring::from_xy`], given up when `go_on`, asked every millisecond or so, says no.
    ///
    /// # Errors
    /// As [`Ring::from_xy`]; when given up, something that may be wrong or not.
    pub fn from_xy_while(
        xy_mm: &[f64],
        bulges: &[f64],
        go_on: &dyn Fn() -> bool,
    ) -> Result<Self, Vec<Finding>> {
        validated(ChainInput::from_xy(xy_mm, bulges, Closure::Closed), go_on)
    }
}

fn validated(mut input: ChainInput, go_on: &dyn Fn() -> bool) -> Result<Ring, Vec<Finding>> {
    let (count, needed) = (input.vertices.len(), if input.bulges.is_empty() { 3 } else { 2 });
    if input.is_placed() && count < needed {
        input.findings.push(|| {
            let arcs = if needed == 3 { "without arcs" } else { "with arcs" };
            let message = format!(
                "{count} distinct vertices; a ring {arcs} needs at least {needed}, none equal to the one before it"
            );
            Finding::new("xy_mm", Reason::TooFewVertices, count, message)
        });
    }
    if !input.findings.is_empty() {
        return Err(input.findings.into_findings("xy_mm"));
    }
    let loops = Loops::new(std::iter::once((input.vertices.as_slice(), input.bulges.as_slice())));
    let no_area = encloses_nothing((0..loops.len()).map(|k| loops.edge(k)));
    let crossings = Crossings::of(&loops, Between::OneRing, go_on);
    drop(loops);
    if no_area && crossings.found.is_empty() {
        // Where the ring crosses itself, that is why its lobes cancel out.
        let message =
            "the ring encloses no area; send an open chain as a line, not as a ring, or leave it out";
        return Err(vec![Finding::new("xy_mm", Reason::NoArea, 0, message)]);
    }
    report(&crossings, &mut input);
    if input.findings.is_empty() {
        Ok(Ring::trusted(input.vertices, input.bulges, crossings.contact))
    } else {
        Err(input.findings.into_findings("xy_mm"))
    }
}

fn report(crossings: &Crossings, input: &mut ChainInput) {
    let mut findings = Vec::new();
    for crossing in &crossings.found {
        let (a, b) = (input.number(crossing.edges.0), input.number(crossing.edges.1));
        let message = format!(
            "edge {a} crosses edge {b} near ({:.6}, {:.6}) mm; a ring may touch itself but not cross: move a vertex or \
             split the ring there",
            crossing.at.x, crossing.at.y
        );
        let crossing_edges = format!("edges {a} and {b}");
        findings.push(Finding::new("xy_mm", Reason::EdgesCross, crossing_edges, message).at(crossing.at));
    }
    if crossings.list_full {
        let message =
            format!("the first {FINDINGS_LIMIT} crossings are listed, more may follow; mend these first");
        findings.push(Finding::new("xy_mm", Reason::EdgesCross, FINDINGS_LIMIT, message));
    } else if crossings.too_much_work {
        let count = input.vertices.len();
        let message = format!(
            "too many of the {count} edges lie over each other to look for crossings; split the ring or send fewer \
             vertices"
        );
        findings.push(Finding::new("xy_mm", Reason::TooMany, count, message));
    } else if let Some(rounds) = rounds(&input.vertices, &input.bulges).filter(|_| findings.is_empty()) {
        let message = format!("the ring runs round itself {rounds} times; send one round of it");
        findings.push(Finding::new("xy_mm", Reason::EdgesCross, format!("{rounds} rounds"), message));
    }
    input.findings.extend(findings);
}

/// How often the same chain of edges is run through, if more than once.
fn rounds(vertices: &[Point], bulges: &[f64]) -> Option<usize> {
    let n = vertices.len();
    (2..=n / 2).filter(|rounds| n.is_multiple_of(*rounds)).find(|rounds| {
        let period = n / rounds;
        vertices[period..].iter().zip(vertices).all(|(later, earlier)| later == earlier)
            && bulges.iter().skip(period).zip(bulges).all(|(later, earlier)| later == earlier)
    })
}
