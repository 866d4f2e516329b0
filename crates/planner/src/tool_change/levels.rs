//! The heights at which the moves to the place and on travel: the best pair of levels.
//!
//! Each move travels at one level ([`crate::level`]). What both cost in the plane only falls when either rises, what they
//! cost up and down only grows: so the two highest levels of a block of pairs bound all of it.

use std::collections::BTreeMap;
use traverse_solve::Interrupt;

/// A block of pairs of levels.
#[derive(Clone, Copy)]
struct Block {
    from: [usize; 2],
    to: [usize; 2],
    /// No pair of it costs less in the plane.
    plane: f64,
}

/// The best pair of levels and what `solve` made of it. `vertical` ascends for each move; `solve` gives what a pair
/// costs in the plane, which falls with either level; none where there is no way. `straight` bounds that. `tell` hears of
/// every bound of the whole. Of equally good pairs the one found first counts.
///
/// Cost: mostly a few solutions, at most one for each pair.
///
/// # Errors
/// The budget ended.
pub(crate) fn best_pair<T: Clone>(
    vertical: [&[f64]; 2],
    straight: f64,
    mut solve: impl FnMut([usize; 2]) -> Result<Option<(f64, T)>, Interrupt>,
    mut tell: impl FnMut(f64),
) -> Result<Option<([usize; 2], T)>, Interrupt> {
    let up = |pair: [usize; 2]| vertical[0][pair[0]] + vertical[1][pair[1]];
    let whole = Block { from: [0, 0], to: [vertical[0].len() - 1, vertical[1].len() - 1], plane: straight };
    let mut open = vec![whole];
    let mut solved: BTreeMap<[usize; 2], Option<f64>> = BTreeMap::new();
    let mut best: Option<(f64, [usize; 2], T)> = None;
    loop {
        let limit = best.as_ref().map_or(f64::INFINITY, |best| best.0);
        open.retain(|block| up(block.from) + block.plane < limit);
        let bounds = open.iter().map(|block| up(block.from) + block.plane).enumerate();
        let Some((next, bound)) = bounds.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        tell(bound);
        let block = open.swap_remove(next);
        let pair = block.to;
        let plane = match solved.get(&pair) {
            Some(known) => *known,
            None => {
                let found = solve(pair)?;
                let plane = found.as_ref().map(|found| found.0);
                if let Some((plane, made)) = found {
                    let cost = up(pair) + plane;
                    if best.as_ref().is_none_or(|best| cost < best.0) {
                        best = Some((cost, pair, made));
                    }
                }
                solved.insert(pair, plane);
                plane
            }
        };
        // Where its highest levels have no way, no pair of the block has.
        let Some(plane) = plane else { continue };
        let block = Block { plane: plane.max(block.plane), ..block };
        let widths = [0, 1].map(|side| block.to[side] - block.from[side]);
        if widths == [0, 0] {
            continue;
        }
        let side = usize::from(widths[1] > widths[0]);
        let middle = block.from[side] + widths[side] / 2;
        let (mut lower, mut upper) = (block, block);
        lower.to[side] = middle;
        upper.from[side] = middle + 1;
        open.extend([lower, upper]);
    }
    Ok(best.map(|(_, pair, made)| (pair, made)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_solve::Seed;

    #[test]
    fn the_best_pair_is_found_and_few_are_solved() {
        let mut most = 0;
        for case in 0..300 {
            let mut random = Seed(11).part(case).stream();
            let mut steps = |count: usize, most: f64| -> Vec<f64> {
                let mut at = 0.0;
                (0..count)
                    .map(|_| {
                        at += random.random_range(0.01..most);
                        at
                    })
                    .collect()
            };
            let vertical = [steps(12, 3.0), steps(9, 3.0)];
            let falls = [steps(12, 4.0), steps(9, 4.0)];
            let first = if case % 3 == 0 { 4 } else { 0 };
            let plane =
                |[a, b]: [usize; 2]| 150.0 - falls[0][a] - falls[1][b] - (falls[0][a] * falls[1][b]).sqrt();
            let cost = |[a, b]: [usize; 2]| vertical[0][a] + vertical[1][b] + plane([a, b]);
            let pairs = (first..12).flat_map(|a| (0..9).map(move |b| [a, b]));
            let expected = pairs.map(cost).min_by(f64::total_cmp).unwrap();
            let mut solved = 0;
            let solve = |pair: [usize; 2]| {
                solved += 1;
                Ok((pair[0] >= first).then(|| (plane(pair), ())))
            };
            let mut told = 0.0_f64;
            let found =
                best_pair([&vertical[0], &vertical[1]], 1.0, solve, |bound| told = told.max(bound)).unwrap();
            assert_eq!(cost(found.unwrap().0), expected, "case {case}");
            assert!(told <= expected);
            most = most.max(solved);
        }
        assert!(most < 100, "{most}");
    }
}
