//! Distances in the plane among the barriers of one level: one search from each end of the shorter list.

use super::at_clearance::Clear;
use crate::Refusal;
use crate::prepared::{Fan, PreparedScene};
use crate::search::{End, Goal, Sighted};
use crate::standing::stand;
use std::collections::BTreeSet;
use traverse_geometry::Scene;
use traverse_solve::{Budget, Interrupt};

/// Links that are kept at most: 128 MB. One search from every end comes by nearly all there are.
const LINKS_KEPT: usize = 4_000_000;

/// Where ends stand and what they see; none for those that are not asked for, and for those that are shut in.
type Ends = Vec<Option<(End, Vec<Sighted>)>>;

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
        let near = seen_ends(&mut prepared, near, pairs.iter().map(|pair| pair.0), budget)?;
        let far = seen_ends(&mut prepared, far, pairs.iter().map(|pair| pair.1), budget)?;
        let mut fan = Fan::new(&mut prepared);
        for same_start in pairs.chunk_by(|a, b| a.0 == b.0) {
            let Some((start, sighted)) = &near[same_start[0].0] else { continue };
            let goals: Vec<(usize, Goal<'_>)> = (same_start.iter())
                .filter_map(|&(_, at)| {
                    let (end, sighted) = far[at].as_ref()?;
                    Some((at, Goal { end, sighted }))
                })
                .collect();
            let ends: Vec<Goal<'_>> = goals.iter().map(|&(_, goal)| goal).collect();
            let costs = fan.costs(start, sighted, &ends, budget, steps)?;
            for ((at, _), cost) in goals.into_iter().zip(costs) {
                let (row, column) = if by_columns { (at, same_start[0].0) } else { (same_start[0].0, at) };
                found(row, column, cost);
            }
        }
        Ok(())
    }
}

/// Of the ends that are `wanted` where they stand and what they see; none for others, and where an end is shut in.
fn seen_ends(
    prepared: &mut PreparedScene,
    ends: &[Result<Clear, Vec<Refusal>>],
    wanted: impl Iterator<Item = usize>,
    budget: &Budget,
) -> Result<Ends, Interrupt> {
    let wanted: BTreeSet<usize> = wanted.collect();
    let mut seen: Ends = vec![None; ends.len()];
    for at in wanted {
        let Ok(clear) = &ends[at] else { continue };
        let end = stand(&prepared.barriers(), &BTreeSet::new(), clear.point, budget)?;
        if !end.places.is_empty() {
            let sighted = Fan::new(prepared).sighted(&end, budget)?;
            seen[at] = Some((end, sighted));
        }
    }
    Ok(seen)
}
