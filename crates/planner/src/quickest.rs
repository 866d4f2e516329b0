//! By limits of speed and acceleration, the best of several short ways.
//!
//! What corners cost depends on what comes before and after, so no search along tangents is exact. The shortest way at the
//! best level is tried first, then other levels, then ways that do not bend round one or the other thing on the side on
//! which the best way so far does, as long as that gets better. Each is priced exactly, as the machine runs it. How good
//! the best is, the bound says: the least length at top speed, with what speeding up and slowing down at the ends adds.
//!
//! Cost: at most [`WAYS`] searches more.

use crate::Stats;
use crate::at_clearance::{AtClearance, Found};
use crate::barrier::Side;
use crate::ends::ClearEnds;
use crate::measure::{Barred, Length};
use crate::price::travel_cost;
use traverse_geometry::Path;
use traverse_solve::Interrupt;

/// So many ways are looked at after the first.
const WAYS: usize = 16;

/// A way as the machine runs it.
pub(crate) struct Way {
    pub(crate) level: usize,
    /// What it does not bend round, and on which side.
    barred: Vec<(usize, Side)>,
    cost: f64,
    pub(crate) path: Path,
    pub(crate) found: Found,
}

impl Way {
    pub(crate) fn new(
        at: &AtClearance<'_>,
        level: usize,
        barred: Vec<(usize, Side)>,
        path: Path,
        found: Found,
    ) -> Self {
        let cost = travel_cost(&path, &at.query.rules.cost);
        Self { level, barred, cost, path, found }
    }

    /// What it bends round, on which side, each once.
    fn bends(&self) -> Vec<(usize, Side)> {
        let mut bends: Vec<(usize, Side)> = Vec::new();
        for stop in self.found.route.iter().flat_map(|route| &route.stops) {
            let bend = (stop.circle.owner, stop.side);
            if !bends.contains(&bend) {
                bends.push(bend);
            }
        }
        bends
    }
}

/// The best of several ways. When the budget ends, the best until then.
pub(crate) fn quickest(
    at: &AtClearance<'_>,
    ends: ClearEnds,
    level_count: usize,
    first: Way,
    stats: &mut Stats,
) -> Way {
    let mut search = Quickest { at, ends, best: first, left: WAYS };
    // The budget's end ends the search, and the best so far stands.
    let _ = search.run(level_count, stats);
    search.best
}

struct Quickest<'a, 'b> {
    at: &'a AtClearance<'b>,
    ends: ClearEnds,
    best: Way,
    /// How many ways may still be looked at.
    left: usize,
}

impl Quickest<'_, '_> {
    fn run(&mut self, level_count: usize, stats: &mut Stats) -> Result<(), Interrupt> {
        let level = self.best.level;
        let mut levels = vec![0, level.saturating_sub(1), level + 1, level_count - 1];
        levels.retain(|&other| other != level && other < level_count);
        levels.sort_unstable();
        levels.dedup();
        for level in levels {
            self.try_way(level, Vec::new(), stats)?;
        }
        loop {
            let before = self.best.cost;
            let (level, barred, bends) = (self.best.level, self.best.barred.clone(), self.best.bends());
            for bend in bends {
                let barred = barred.iter().copied().chain([bend]).collect();
                self.try_way(level, barred, stats)?;
            }
            if self.best.cost >= before || self.left == 0 {
                return Ok(());
            }
        }
    }

    /// Looks at the shortest way of a kind, and keeps it if it is the best.
    fn try_way(
        &mut self,
        level: usize,
        barred: Vec<(usize, Side)>,
        stats: &mut Stats,
    ) -> Result<(), Interrupt> {
        if self.left == 0 {
            return Ok(());
        }
        self.left -= 1;
        let measure = Barred { measure: Length, barred: &barred };
        let Some(found) = self.at.search_by(measure, level, self.ends, stats)? else { return Ok(()) };
        let Some(path) = self.at.driven(self.ends, level, &found)? else { return Ok(()) };
        let way = Way::new(self.at, level, barred, path, found);
        if way.cost < self.best.cost {
            self.best = way;
        }
        Ok(())
    }
}
