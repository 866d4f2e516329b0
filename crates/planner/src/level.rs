//! Heights at which a move can travel, and the cheapest of them.
//!
//! **One level is enough.** What is in the way at a height is in the way at every lower one, since obstacles reach down
//! without end. Take any path of horizontal and vertical moves from start to target, and lift all of it to its highest
//! point: rise there at once, travel the same way in the plane, come down at the end. The rise and the descent are clear,
//! since both ends are clear at their own heights and so above them; the way in the plane was clear piece by piece at
//! heights not above this one. Horizontal lengths stay what they were, and the vertical ones only shrink: every path
//! rises and falls at least as much to reach its highest point and come back. So a rise, travel at one level and a
//! descent are optimal among all such paths, with any number of retracts.
//!
//! **Which levels.** Between two heights at which an obstacle gets out of the way nothing changes but the vertical moves,
//! so the lowest of each such stretch is best: the higher of both ends, and every top plus clearance from there to the
//! highest.
//!
//! Not so with undersides, with a clearance that depends on height, or when height and position may change at once.

use crate::barriers::Barriers;
use std::collections::BTreeSet;
use traverse_geometry::HeightRule;
use traverse_solve::Interrupt;

/// The heights at which a move can travel.
pub(crate) struct Levels {
    rule: Option<HeightRule>,
    /// Ascending. One of no meaning where heights do not count.
    z_mm: Vec<f64>,
}

impl Levels {
    /// The levels worth a look. Cost: n log n in the obstacles.
    pub(crate) fn of(barriers: &Barriers<'_>, rule: Option<HeightRule>) -> Self {
        let Some(rule) = rule else { return Self { rule: None, z_mm: vec![0.0] } };
        let lowest = rule.start_z_mm.max(rule.target_z_mm);
        let tops = barriers.scene.obstacles.iter().filter_map(|obstacle| obstacle.top_z_mm);
        let passes = tops.map(|top| rule.pass_z_mm(top));
        let mut z_mm: Vec<f64> = passes.filter(|&z| z > lowest && z <= rule.highest_z_mm).collect();
        z_mm.push(lowest);
        z_mm.sort_by(f64::total_cmp);
        z_mm.dedup();
        Self { rule: Some(rule), z_mm }
    }

    pub(crate) fn count(&self) -> usize {
        self.z_mm.len()
    }

    /// Height of a level; none where heights do not count.
    pub(crate) fn z_mm(&self, level: usize) -> Option<f64> {
        self.rule.map(|_| self.z_mm[level])
    }

    /// What is passed over at the level.
    pub(crate) fn passed_over(&self, barriers: &Barriers<'_>, level: usize) -> BTreeSet<usize> {
        passed_over(barriers, self.rule, self.z_mm[level])
    }

    /// How far rising to a level and coming down from it is, millimetres.
    pub(crate) fn vertical(&self, level: usize) -> f64 {
        let z = self.z_mm[level];
        self.rule.map_or(0.0, |rule| (z - rule.start_z_mm) + (z - rule.target_z_mm))
    }
}

/// Owners of the barriers that are passed over at height `z_mm`.
pub(crate) fn passed_over(barriers: &Barriers<'_>, rule: Option<HeightRule>, z_mm: f64) -> BTreeSet<usize> {
    let Some(rule) = rule else { return BTreeSet::new() };
    let obstacles = barriers.scene.obstacles.iter().enumerate();
    obstacles.filter(|(_, obstacle)| rule.passes_over(obstacle, z_mm)).map(|(owner, _)| owner).collect()
}

/// The best of the levels, and what `solve` made of it. `vertical` ascends with the levels; `solve` gives the cost in
/// the plane, which descends; none where there is no way. `straight` is a bound of the cost in the plane. `tell` hears
/// of every bound of the whole.
///
/// Solved are the lowest level, then the highest that can still be better, then middles: a stretch of levels costs at
/// least what rising to its lowest costs and what the plane costs just above it. A stretch whose bound is not below
/// the best cost is left alone. Of equally good levels the one found first counts. Cost: mostly a few solutions, at
/// most one per level.
///
/// # Errors
/// The budget ended.
pub(crate) fn best_level<T>(
    vertical: &[f64],
    straight: f64,
    mut solve: impl FnMut(usize) -> Result<Option<(f64, T)>, Interrupt>,
    mut tell: impl FnMut(f64),
) -> Result<Option<(usize, T)>, Interrupt> {
    let mut best: Option<(f64, usize, T)> = None;
    let mut open = vec![Stretch { from: 0, to: vertical.len() - 1, plane: straight, has_bound: false }];
    let mut at_lowest = true;
    loop {
        let limit = best.as_ref().map_or(f64::INFINITY, |best| best.0);
        open.retain(|stretch| stretch.bound(vertical) < limit);
        let lowest = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
        let bounds = open.iter().map(|stretch| stretch.bound(vertical)).enumerate();
        let Some((next, bound)) = bounds.min_by(lowest) else { break };
        tell(bound);
        let mut stretch = open.swap_remove(next);
        // Rising to levels as dear as this never pays.
        while stretch.to > stretch.from && vertical[stretch.to] + stretch.plane >= limit {
            stretch.to -= 1;
        }
        let level = match (at_lowest, stretch.has_bound) {
            (true, _) => stretch.from,
            (false, false) => stretch.to,
            (false, true) => usize::midpoint(stretch.from, stretch.to),
        };
        at_lowest = false;
        let solved = solve(level)?;
        if level < stretch.to {
            open.push(Stretch { from: level + 1, ..stretch });
        }
        // Where a level has no way, none below has.
        let Some((plane, found)) = solved else { continue };
        if level > stretch.from {
            open.push(Stretch { to: level - 1, plane: plane.max(stretch.plane), has_bound: true, ..stretch });
        }
        let cost = vertical[level] + plane;
        if best.as_ref().is_none_or(|best| cost < best.0) {
            best = Some((cost, level, found));
        }
    }
    Ok(best.map(|(_, level, found)| (level, found)))
}

/// Neighbouring levels that were not solved.
#[derive(Clone, Copy)]
struct Stretch {
    from: usize,
    to: usize,
    /// No level among them costs less in the plane.
    plane: f64,
    /// Whether that comes from the level above.
    has_bound: bool,
}

impl Stretch {
    fn bound(&self, vertical: &[f64]) -> f64 {
        vertical[self.from] + self.plane
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use traverse_solve::Seed;

    #[test]
    fn the_best_level_is_found_and_few_are_solved() {
        let mut solved_of_hundred = 0;
        for case in 0..500 {
            let mut random = Seed(3).part(case).stream();
            let count = random.random_range(1..=100);
            let mut vertical = vec![random.random_range(0.0..5.0)];
            let mut plane = vec![random.random_range(50.0..150.0)];
            for i in 1..count {
                vertical.push(vertical[i - 1] + random.random_range(0.01..2.0));
                let falls =
                    if random.random_range(0.0..1.0) < 0.2 { random.random_range(0.0..10.0) } else { 0.0 };
                plane.push(f64::max(plane[i - 1] - falls, 40.0));
            }
            // Below some level there may be no way at all.
            let first = if case % 3 == 0 { random.random_range(0..=count) } else { 0 };
            let expected = (first..count).map(|i| vertical[i] + plane[i]).min_by(f64::total_cmp);
            let (mut solved, mut told) = (0, 0.0);
            let solve = |level: usize| {
                solved += 1;
                Ok((level >= first).then_some((plane[level], ())))
            };
            let tell = |bound| told = f64::max(told, bound);
            let found = best_level(&vertical, 40.0, solve, tell).unwrap();
            let cost = found.map(|(level, ())| vertical[level] + plane[level]);
            assert_eq!(cost, expected, "case {case}");
            assert!(expected.is_none_or(|cost| told <= cost));
            if count > 90 {
                solved_of_hundred = solved_of_hundred.max(solved);
            }
        }
        assert!(solved_of_hundred < 60, "{solved_of_hundred}");
    }
}
