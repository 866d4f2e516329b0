//! Which loop lies in which.
//!
//! A loop is inside another one when a point of its interior is and the other one is larger: exact for loops that
//! do not cross, touching or not. One sweep from bottom to top answers for all points at once. Cost: n log n plus,
//! per loop, the edges at the height of its point.

use crate::Loop;
use crate::monotone::{Piece, pieces_of};
use traverse_geometry::Point;

/// Which loop lies in which.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Forest {
    /// The smallest loop around each loop.
    pub parents: Vec<Option<usize>>,
    /// The loops directly inside each loop, in order.
    pub children: Vec<Vec<usize>>,
    /// How many loops are around each loop.
    pub depths: Vec<usize>,
}

impl Forest {
    /// The forest of `loops`. Loops that cross one another are placed by one point of their interior.
    #[must_use]
    pub fn of(loops: &[Loop]) -> Self {
        let areas: Vec<f64> = loops.iter().map(Loop::area).collect();
        let larger = |a: usize, b: usize| areas[a].total_cmp(&areas[b]).then(b.cmp(&a)).is_gt();
        let pieces: Vec<Vec<Piece>> = loops.iter().map(|each| pieces_of(each.edges())).collect();
        let mut parents: Vec<Option<usize>> = vec![None; loops.len()];
        sweep(&pieces, |inner, around| {
            let around = around.iter().copied().filter(|&outer| larger(outer, inner));
            parents[inner] = around.min_by(|&a, &b| {
                if larger(a, b) { std::cmp::Ordering::Greater } else { std::cmp::Ordering::Less }
            });
        });
        Self::of_parents(parents)
    }

    /// The forest in which these are the parents.
    pub(crate) fn of_parents(parents: Vec<Option<usize>>) -> Self {
        let mut children = vec![Vec::new(); parents.len()];
        for (each, parent) in parents.iter().enumerate() {
            if let Some(parent) = *parent {
                children[parent].push(each);
            }
        }
        let mut forest = Self { depths: vec![0; parents.len()], parents, children };
        let mut waiting: Vec<usize> = forest.roots().collect();
        while let Some(each) = waiting.pop() {
            for &child in &forest.children[each] {
                forest.depths[child] = forest.depths[each] + 1;
                waiting.push(child);
            }
        }
        forest
    }

    /// For each loop the places that it and all inside it take, loops numbered from the outside in: one lies around
    /// another one, however far out, when its places contain the other's first.
    pub(crate) fn spans(&self) -> Vec<std::ops::Range<usize>> {
        let mut spans = vec![0..0; self.parents.len()];
        let mut order = Vec::with_capacity(spans.len());
        let mut waiting: Vec<usize> = self.roots().collect();
        while let Some(each) = waiting.pop() {
            spans[each] = order.len()..order.len() + 1;
            order.push(each);
            waiting.extend(&self.children[each]);
        }
        // What is inside was numbered later.
        for each in order.into_iter().rev() {
            if let Some(parent) = self.parents[each] {
                spans[parent].end = spans[parent].end.max(spans[each].end);
            }
        }
        spans
    }

    /// Loops that lie in none.
    pub fn roots(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.parents.len()).filter(|&each| self.parents[each].is_none())
    }
}

/// Calls `answer` for each loop with the other loops around a point of its interior.
fn sweep(pieces: &[Vec<Piece>], mut answer: impl FnMut(usize, &[usize])) {
    let mut questions: Vec<(usize, Point)> = pieces
        .iter()
        .enumerate()
        .filter_map(|(each, pieces)| Some((each, interior_point(pieces)?)))
        .collect();
    questions.sort_by(|a, b| a.1.y.total_cmp(&b.1.y));
    let mut waiting: Vec<(usize, Piece)> = pieces
        .iter()
        .enumerate()
        .flat_map(|(each, pieces)| pieces.iter().map(move |&piece| (each, piece)))
        .collect();
    waiting.sort_by(|a, b| b.1.low.total_cmp(&a.1.low));
    let mut active: Vec<(usize, Piece)> = Vec::new();
    let mut odd = vec![false; pieces.len()];
    for (asked, p) in questions {
        while let Some(next) = waiting.pop_if(|(_, piece)| piece.low <= p.y) {
            active.push(next);
        }
        active.retain(|(_, piece)| piece.high > p.y);
        let mut met = Vec::new();
        for (each, piece) in &active {
            if *each != asked && piece.spans(p.y) && piece.x_at(p.y) > p.x {
                odd[*each] = !odd[*each];
                met.push(*each);
            }
        }
        met.sort_unstable();
        met.dedup();
        let around: Vec<usize> = met.iter().copied().filter(|&each| odd[each]).collect();
        answer(asked, &around);
        for each in met {
            odd[each] = false;
        }
    }
}

/// Heights at which an interior point is looked for, as shares of the loop's height.
const HEIGHTS: [f64; 3] = [0.5, 0.381_966, 0.723_607];

/// A point well inside the loop of these pieces; none when it has no height.
fn interior_point(pieces: &[Piece]) -> Option<Point> {
    let low = pieces.iter().map(|piece| piece.low).reduce(f64::min)?;
    let high = pieces.iter().map(|piece| piece.high).reduce(f64::max)?;
    let widest_at = |share: f64| {
        let y = low + (high - low) * share;
        let mut crossings: Vec<f64> =
            pieces.iter().filter(|piece| piece.spans(y)).map(|piece| piece.x_at(y)).collect();
        crossings.sort_by(f64::total_cmp);
        let inside = crossings
            .chunks_exact(2)
            .map(move |pair| (pair[1] - pair[0], Point::new((pair[0] + pair[1]) / 2.0, y)));
        inside.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let best = HEIGHTS.into_iter().filter_map(widest_at).max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, p)| p)
}

#[cfg(test)]
mod tests {
    use super::Forest;

    #[test]
    fn spans_tell_what_lies_around_what() {
        let parents = vec![None, Some(0), Some(1), Some(0), None, Some(4), Some(2)];
        let children =
            (0..7).map(|each| (0..7).filter(|&inner| parents[inner] == Some(each)).collect()).collect();
        let forest = Forest { parents, children, depths: vec![0, 1, 2, 1, 0, 1, 3] };
        let spans = forest.spans();
        for outer in 0..7 {
            for inner in 0..7 {
                let mut up = Some(inner);
                while up.is_some_and(|each| each != outer) {
                    up = up.and_then(|each| forest.parents[each]);
                }
                assert_eq!(spans[outer].contains(&spans[inner].start), up.is_some(), "{outer} {inner}");
            }
        }
    }
}
