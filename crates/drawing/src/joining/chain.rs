//! Curves that follow each other from vertex to vertex.

use super::Loop;
use crate::Curve;
use traverse_geometry::Point;

/// An open curve between two snapped vertices.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) curve: usize,
    pub(super) from: usize,
    pub(super) to: usize,
}

/// A link of a chain, run forward or backward.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) link: usize,
    pub(super) forward: bool,
}

/// Links one after the other, through vertices where exactly two ends meet.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) steps: Vec<Step>,
    pub(super) closed: bool,
}

/// All chains of a layer.
pub(super) struct Chains {
    pub(super) chains: Vec<Chain>,
    /// How many ends meet at each vertex.
    pub(super) ends: Vec<usize>,
    /// Vertices where three or more ends meet and leave a chain open, each with one link that ends there.
    pub(super) junctions: Vec<(usize, usize)>,
}

/// Follows the links. Cost: linear.
pub(super) fn chains(links: &[Link], vertex_count: usize) -> Chains {
    let mut at_vertex: Vec<Vec<usize>> = vec![Vec::new(); vertex_count];
    for (i, link) in links.iter().enumerate() {
        at_vertex[link.from].push(i);
        at_vertex[link.to].push(i);
    }
    let mut used = vec![false; links.len()];
    let mut found = Vec::new();
    for first in 0..links.len() {
        if used[first] {
            continue;
        }
        let mut ahead = vec![Step { link: first, forward: true }];
        used[first] = true;
        follow(links, &at_vertex, &mut used, &mut ahead);
        let mut behind = vec![Step { link: first, forward: false }];
        follow(links, &at_vertex, &mut used, &mut behind);
        let turned = behind[1..].iter().rev().map(|step| Step { forward: !step.forward, ..*step });
        let mut chain = Chain { steps: turned.chain(ahead).collect(), closed: false };
        let (from, to) = chain.ends(links);
        chain.closed = from == to;
        found.push(chain);
    }
    let ends: Vec<usize> = at_vertex.iter().map(Vec::len).collect();
    let mut junctions: Vec<usize> = found
        .iter()
        .filter(|chain| !chain.closed)
        .flat_map(|chain| <[usize; 2]>::from(chain.ends(links)))
        .filter(|&vertex| ends[vertex] > 2)
        .collect();
    junctions.sort_unstable();
    junctions.dedup();
    let junctions = junctions.into_iter().map(|vertex| (vertex, at_vertex[vertex][0])).collect();
    Chains { chains: found, ends, junctions }
}

/// Goes on from the last step while exactly one unused link goes on.
fn follow(links: &[Link], at_vertex: &[Vec<usize>], used: &mut [bool], steps: &mut Vec<Step>) {
    while let Some(last) = steps.last() {
        let vertex = last.end(links);
        let [a, b] = at_vertex[vertex][..] else { return };
        let next = if a == last.link { b } else { a };
        if used[next] {
            return;
        }
        used[next] = true;
        steps.push(Step { link: next, forward: links[next].from == vertex });
    }
}

impl Step {
    fn start(&self, links: &[Link]) -> usize {
        if self.forward { links[self.link].from } else { links[self.link].to }
    }

    fn end(&self, links: &[Link]) -> usize {
        if self.forward { links[self.link].to } else { links[self.link].from }
    }
}

impl Chain {
    /// First and last vertex. A chain is never empty.
    pub(super) fn ends(&self, links: &[Link]) -> (usize, usize) {
        let last = self.steps.len() - 1;
        (self.steps[0].start(links), self.steps[last].end(links))
    }

    /// The closed chain as a loop, from its first curve in file order on, along that curve.
    pub(super) fn to_loop(&self, links: &[Link], curves: &[Curve], vertices: &[Point]) -> Loop {
        let count = self.steps.len();
        let first = (0..count).min_by_key(|&i| links[self.steps[i].link].curve).unwrap_or(0);
        let first_curve = links[self.steps[first].link].curve;
        let mut result = Loop::begin(first_curve);
        let along = self.steps[first].forward;
        for i in 0..count {
            let at = if along { (first + i) % count } else { (first + count - i) % count };
            let step = Step { forward: self.steps[at].forward == along, ..self.steps[at] };
            result.append(&curves[links[step.link].curve], step.forward, vertices[step.start(links)]);
        }
        result
    }
}

impl Loop {
    /// Adds a curve without its last vertex; the first becomes `start`.
    fn append(&mut self, curve: &Curve, forward: bool, start: Point) {
        let edges = curve.vertices.len() - 1;
        self.deviation_mm = self.deviation_mm.max(curve.deviation_mm);
        self.vertices.push(start);
        if forward {
            self.vertices.extend_from_slice(&curve.vertices[1..edges]);
            self.bulges.extend_from_slice(&curve.bulges[..edges]);
        } else {
            self.vertices.extend(curve.vertices[1..edges].iter().rev());
            self.bulges.extend(curve.bulges[..edges].iter().rev().map(|bulge| -bulge));
        }
    }
}

/// An open curve whose ends meet, as a loop; none when it is a single edge.
pub(super) fn closed_by_itself(curve: &Curve, index: usize, start: Point) -> Option<Loop> {
    let mut result = Loop::begin(index);
    result.append(curve, true, start);
    (result.vertices.len() > 1).then_some(result)
}
