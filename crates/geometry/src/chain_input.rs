//! Coordinates and bulges as they arrive, checked number by number: what rings and open chains have in common.

use crate::finding_list::FindingList;
use crate::{COORDINATE_LIMIT_MM, FLAT_ARC_MM, Finding, Point, RADIUS_LIMIT_MM, Reason};

/// Whether the last vertex is joined to the first.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Closure {
    Closed,
    Open,
}

/// Vertices and bulges without edges of length 0, with the numbers that they had in the input.
pub(crate) struct ChainInput {
    pub(crate) vertices: Vec<Point>,
    /// Empty when every edge is straight.
    pub(crate) bulges: Vec<f64>,
    placed: bool,
    odd: bool,
    /// Input number of each vertex. Empty: none was dropped.
    numbers: Vec<u32>,
    pub(crate) findings: FindingList,
}

impl ChainInput {
    /// Reads x0, y0, x1, y1, …
    pub(crate) fn from_xy(xy_mm: &[f64], bulges: &[f64], closure: Closure) -> Self {
        let mut findings = FindingList::default();
        let (pairs, rest) = xy_mm.as_chunks::<2>();
        if let [last] = rest {
            findings.push(|| {
                Finding::new(
                    "xy_mm",
                    Reason::OddCoordinateCount,
                    xy_mm.len(),
                    format!(
                        "xy_mm holds {} numbers, the last one {last:?}; send an x and a y for every vertex",
                        xy_mm.len()
                    ),
                )
            });
        }
        let vertices = pairs.iter().map(|&[x, y]| Point::new(x, y)).collect();
        Self::read(vertices, bulges.to_vec(), closure, findings)
    }

    pub(crate) fn from_vertices(vertices: Vec<Point>, bulges: Vec<f64>, closure: Closure) -> Self {
        Self::read(vertices, bulges, closure, FindingList::default())
    }

    fn read(
        mut vertices: Vec<Point>,
        mut bulges: Vec<f64>,
        closure: Closure,
        mut findings: FindingList,
    ) -> Self {
        let odd = !findings.is_empty();
        let edges =
            if closure == Closure::Closed { vertices.len() } else { vertices.len().saturating_sub(1) };
        if !bulges.is_empty() && bulges.len() != edges && !(odd && bulges.len() == edges + 1) {
            findings.push(|| bulge_count(bulges.len(), edges, vertices.len()));
        }
        let mut placed = true;
        for (number, vertex) in vertices.iter_mut().enumerate() {
            for axis in 0..2 {
                if let Some(finding) = coordinate_finding(2 * number + axis, vertex[axis]) {
                    findings.push(|| finding);
                    placed = false;
                }
                // −0.0 becomes 0.0.
                vertex[axis] += 0.0;
            }
        }
        for (number, bulge) in bulges.iter_mut().enumerate() {
            if let Some(finding) = bulge_finding(number, *bulge) {
                findings.push(|| finding);
            }
            *bulge += 0.0;
        }
        let mut input = Self { vertices, bulges, placed, odd, numbers: Vec::new(), findings };
        if placed {
            input.drop_empty_edges(closure);
        } else {
            input.vertices.clear();
        }
        if placed && input.findings.is_empty() {
            input.straighten(closure);
        }
        if input.bulges.iter().all(|&bulge| bulge == 0.0) {
            input.bulges.clear();
        }
        input
    }

    /// Whether every coordinate is there and good, so that vertices may be counted.
    pub(crate) fn is_placed(&self) -> bool {
        self.placed && !self.odd
    }

    /// The number that vertex or edge `i` had in the input.
    pub(crate) fn number(&self, i: usize) -> usize {
        self.numbers.get(i).map_or(i, |&number| number as usize)
    }

    /// Drops every edge of length 0 with its first vertex and its bulge.
    fn drop_empty_edges(&mut self, closure: Closure) {
        let n = self.vertices.len();
        let keeps = |i: usize| match closure {
            Closure::Open if i + 1 == n => true,
            _ => self.vertices[i] != self.vertices[if i + 1 == n { 0 } else { i + 1 }],
        };
        if (0..n).all(keeps) {
            return;
        }
        self.numbers = (0..n).filter(|&i| keeps(i)).map(|i| i as u32).collect();
        self.bulges = self.numbers.iter().filter_map(|&i| self.bulges.get(i as usize).copied()).collect();
        self.vertices = self.numbers.iter().map(|&i| self.vertices[i as usize]).collect();
    }

    /// Makes arcs straight that can't be told from their chord, and refuses those that are too flat otherwise.
    fn straighten(&mut self, closure: Closure) {
        let n = self.vertices.len();
        for i in 0..self.bulges.len() {
            let bulge = self.bulges[i].abs();
            if bulge == 0.0 || (closure == Closure::Open && i + 1 == n) {
                continue;
            }
            let chord = (self.vertices[(i + 1) % n] - self.vertices[i]).norm();
            if bulge * chord / 2.0 < FLAT_ARC_MM {
                self.bulges[i] = 0.0;
                continue;
            }
            let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge);
            if radius > RADIUS_LIMIT_MM {
                let (number, value, start) = (self.number(i), self.bulges[i], self.vertices[i]);
                self.findings.push(|| {
                    Finding::new(
                        format!("bulges[{number}]"),
                        Reason::ArcTooFlat,
                        format!("{value:?}"),
                        format!(
                            "bulge {value:?} over a chord of {chord:?} mm makes a radius of {radius:.4e} mm, beyond \
                             {RADIUS_LIMIT_MM:e} mm; send 0 for a straight edge"
                        ),
                    )
                    .at(start)
                });
            }
        }
    }
}

fn bulge_count(bulges: usize, edges: usize, vertices: usize) -> Finding {
    Finding::new(
        "bulges",
        Reason::BulgeCountMismatch,
        bulges,
        format!(
            "{bulges} bulges for {vertices} vertices; send {edges}, one per edge, or none when every edge is straight"
        ),
    )
}

fn coordinate_finding(index: usize, value: f64) -> Option<Finding> {
    let field = || format!("xy_mm[{index}]");
    if !value.is_finite() {
        let message = format!("{} is {value:?}; send a finite number of millimetres", field());
        Some(Finding::new(field(), Reason::NotFinite, format!("{value:?}"), message))
    } else if value.abs() > COORDINATE_LIMIT_MM {
        let message = format!(
            "{} is {value:?} mm; keep coordinates within ±{COORDINATE_LIMIT_MM:e} mm, or move the origin closer",
            field()
        );
        Some(Finding::new(field(), Reason::CoordinateTooLarge, format!("{value:?}"), message))
    } else {
        None
    }
}

fn bulge_finding(index: usize, value: f64) -> Option<Finding> {
    let field = || format!("bulges[{index}]");
    if !value.is_finite() {
        let message =
            format!("{} is {value:?}; send tan(sweep / 4), within [-1, 1], 0 for a straight edge", field());
        Some(Finding::new(field(), Reason::NotFinite, format!("{value:?}"), message))
    } else if value.abs() > 1.0 {
        let message = format!(
            "{} is {value:?}, outside [-1, 1]; split an arc of more than half a turn into two",
            field()
        );
        Some(Finding::new(field(), Reason::BulgeOutOfRange, format!("{value:?}"), message))
    } else {
        None
    }
}
