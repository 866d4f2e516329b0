//! Distances in the plane among the barriers of one level: from each end of the shorter list one search to each end of the
//! other, or one in all directions, whichever takes less.

use super::at_clearance::Clear;
use super::single_searches::SingleSearches;
use crate::prepared::{Fan, FanRoom, PreparedScene};
use crate::search::{End, Goal, Sighted};
use crate::standing::stand;
use crate::{Refusal, Stats};
use std::collections::BTreeSet;
use traverse_geometry::Scene;
use traverse_solve::{Budget, Interrupt};

/// Links that are kept at most: 128 MB. One search from every end comes by nearly all there are.
const LINKS_KEPT: usize = 4_000_000;

/// Corners and arcs that ends see, kept at most in all: about 100 MB.
const SIGHTED_LIMIT: usize = 8_000_000;

/// Where an end stands, and what it sees once that is asked for.
struct Seen {
    end: End,
    sighted: Option<Vec<Sighted>>,
}

/// None for ends that are not asked for, and for those that are shut in.
type Ends = Vec<Option<Seen>>;

/// What is to be worked out at one level.
pub(super) struct AtLevel<'a> {
    /// What is in the way there.
    pub(super) scene: Scene,
    pub(super) from: &'a [Result<Clear, Vec<Refusal>>],
    pub(super) to: &'a [Result<Clear, Vec<Refusal>>],
    /// Row and column of every pair to work out, in order; both ends are clear.
    pub(super) pairs: &'a [(usize, usize)],
    pub(super) budget: &'a Budget,
}

impl AtLevel<'_> {
    /// Tells `found` of every way: row, column, length in millimetres.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn solve(
        self,
        steps: &mut u64,
        mut found: impl FnMut(usize, usize, f64),
    ) -> Result<(), Interrupt> {
        let Self { scene, from, to, pairs, budget } = self;
        let mut prepared = PreparedScene::keeping(scene, LINKS_KEPT, budget)?;
        // By the list whose ends are fewer.
        let by_columns = to.len() < from.len();
        let mut pairs: Vec<(usize, usize)> = if by_columns {
            pairs.iter().map(|&(row, column)| (column, row)).collect()
        } else {
            pairs.to_vec()
        };
        pairs.sort_unstable();
        let (near, far) = if by_columns { (to, from) } else { (from, to) };
        let mut near = ends_of(&mut prepared, near, pairs.iter().map(|pair| pair.0), budget)?;
        let mut far = ends_of(&mut prepared, far, pairs.iter().map(|pair| pair.1), budget)?;
        let (mut singles, mut room, mut sighted_count) = (SingleSearches::default(), FanRoom::default(), 0);
        for same_start in pairs.chunk_by(|a, b| a.0 == b.0) {
            let from = same_start[0].0;
            let Some(start) = &mut near[from] else { continue };
            let mut tell = |at: usize, cost: f64| {
                let (row, column) = if by_columns { (at, from) } else { (from, at) };
                found(row, column, cost);
            };
            let mut goals: Vec<usize> =
                same_start.iter().map(|&(_, at)| at).filter(|&at| far[at].is_some()).collect();
            while let Some(&at) = goals.last() {
                if singles.is_spread_worth_it(goals.len(), prepared.feature_count()) {
                    let mut fan = Fan::new(&mut prepared, &mut room);
                    sighted_count += start.look(&fan, budget)?;
                    for &at in &goals {
                        let Some(goal) = &mut far[at] else { continue };
                        sighted_count += goal.look(&fan, budget)?;
                        if sighted_count > SIGHTED_LIMIT {
                            return Err(Interrupt::Memory);
                        }
                    }
                    let ends: Vec<Goal<'_>> =
                        goals.iter().filter_map(|&at| far[at].as_ref()).map(Seen::goal).collect();
                    let Goal { end, sighted } = start.goal();
                    let costs = fan.costs(end, sighted, &ends, budget, steps)?;
                    goals.drain(..).zip(costs).for_each(|(at, cost)| tell(at, cost));
                    break;
                }
                goals.pop();
                let Some(target) = &far[at] else { continue };
                let mut stats = Stats { expanded_nodes: *steps, ..Stats::default() };
                let cost = prepared.cost_between([&start.end, &target.end], budget, &mut stats)?;
                singles.note(stats.expanded_nodes - *steps);
                *steps = stats.expanded_nodes;
                tell(at, cost);
            }
        }
        Ok(())
    }
}

impl Seen {
    /// Makes sure that what the end sees is known; answers how much was found out.
    ///
    /// # Errors
    /// The budget ended.
    fn look(&mut self, fan: &Fan<'_>, budget: &Budget) -> Result<usize, Interrupt> {
        if self.sighted.is_some() {
            return Ok(0);
        }
        let sighted = fan.sighted(&self.end, budget)?;
        let count = sighted.len();
        self.sighted = Some(sighted);
        Ok(count)
    }

    fn goal(&self) -> Goal<'_> {
        Goal { end: &self.end, sighted: self.sighted.as_deref().unwrap_or_default() }
    }
}

/// Where the ends stand that are `wanted`; none for others, and where an end is shut in.
fn ends_of(
    prepared: &mut PreparedScene,
    ends: &[Result<Clear, Vec<Refusal>>],
    wanted: impl Iterator<Item = usize>,
    budget: &Budget,
) -> Result<Ends, Interrupt> {
    let wanted: BTreeSet<usize> = wanted.collect();
    let mut seen: Ends = ends.iter().map(|_| None).collect();
    for at in wanted {
        let Ok(clear) = &ends[at] else { continue };
        let end = stand(&prepared.barriers(), &BTreeSet::new(), clear.point, budget)?;
        if !end.places.is_empty() {
            seen[at] = Some(Seen { end, sighted: None });
        }
    }
    Ok(seen)
}
