//! Distances at one clearance: ends led out of the barriers, then level by level.

use super::at_level::AtLevel;
use super::matrix::Matrix;
use super::{DistanceEnd, DistanceQuery, DistancesRefusal};
use crate::Refusal;
use crate::barriers::Barriers;
use crate::ends::clear_end;
use crate::level::Levels;
use crate::lowered::without;
use traverse_geometry::{EndRule, Point, Scene};
use traverse_solve::{Budget, Interrupt};

/// What is to be worked out at one clearance.
pub(super) struct AtClearance<'a> {
    /// With that clearance.
    pub(super) scene: &'a Scene,
    pub(super) query: &'a DistanceQuery,
    /// No smaller clearance is tried after this one.
    pub(super) is_last: bool,
    pub(super) budget: &'a Budget,
}

/// An end outside of all barriers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clear {
    /// Where it is clear: itself, or where its way out ends.
    pub(super) point: Point,
    /// How long its way out is, millimetres.
    pub(super) lead: f64,
}

impl AtClearance<'_> {
    /// Works out the open pairs of the matrix as far as there is a way at this clearance.
    ///
    /// # Errors
    /// The budget ended; at the last clearance every end of an open pair that lies inside a barrier.
    pub(super) fn fill(&self, matrix: &mut Matrix, steps: &mut u64) -> Result<(), DistancesRefusal> {
        let Self { scene, query, budget, .. } = *self;
        let barriers = Barriers::new(scene, budget)?;
        let heights = query.rules.heights;
        let [start_z, target_z] = heights.map_or([0.0; 2], |rule| [rule.start_z_mm, rule.target_z_mm]);
        let from = self.clear_ends(&barriers, "start", &query.from, start_z, &query.rules.leave)?;
        let to = self.clear_ends(&barriers, "target", query.targets(), target_z, &query.rules.enter)?;
        let mut open = matrix.open();
        if self.is_last {
            refuse_ends(&open, &from, &to, query.to.is_empty())?;
        }
        let ends = |row: usize, column: usize| Some((*from[row].as_ref().ok()?, *to[column].as_ref().ok()?));
        open.retain(|&(row, column)| ends(row, column).is_some());
        // A move to where the tool is already stays there.
        open.retain(|&(row, column)| {
            let stays = query.from[row] == query.targets()[column] && start_z == target_z;
            if stays {
                matrix.lower(row, column, 0.0);
            }
            !stays
        });
        let levels = Levels::of(&barriers, heights);
        for level in 0..levels.count() {
            let vertical = levels.vertical(level);
            let may_be_nearer = |&(row, column): &(usize, usize)| {
                ends(row, column).is_some_and(|(start, target)| {
                    let straight = (target.point - start.point).norm() + start.lead + target.lead;
                    vertical + straight < matrix.cost(row, column)
                })
            };
            open.retain(may_be_nearer);
            if open.is_empty() {
                break;
            }
            let left_out = levels.passed_over(&barriers, level);
            let at_level =
                AtLevel { scene: without(scene, &left_out), from: &from, to: &to, pairs: &open, budget };
            at_level.solve(steps, |row, column, plane| {
                let leads = ends(row, column).map_or(0.0, |(start, target)| start.lead + target.lead);
                matrix.lower(row, column, plane + leads + vertical);
            })?;
        }
        Ok(())
    }

    fn clear_ends(
        &self,
        barriers: &Barriers<'_>,
        field: &'static str,
        points: &[Point],
        z_mm: f64,
        rule: &EndRule,
    ) -> Result<Vec<Result<Clear, Vec<Refusal>>>, Interrupt> {
        let clear = |&point: &Point| {
            let found = clear_end(barriers, &self.query.rules, field, point, z_mm, rule, self.budget)?;
            Ok(found.map(|clear| Clear { point: clear, lead: (clear - point).norm() }))
        };
        points.iter().map(clear).collect()
    }
}

/// Refuses the ends of open pairs that are not clear. Of a point that is both start and target the start speaks.
fn refuse_ends(
    open: &[(usize, usize)],
    from: &[Result<Clear, Vec<Refusal>>],
    to: &[Result<Clear, Vec<Refusal>>],
    same_points: bool,
) -> Result<(), DistancesRefusal> {
    let mut is_wanted = (vec![false; from.len()], vec![false; to.len()]);
    for &(row, column) in open {
        is_wanted.0[row] = true;
        is_wanted.1[column] = true;
    }
    let mut refused = Vec::new();
    for (i, end) in from.iter().enumerate().filter(|&(i, _)| is_wanted.0[i]) {
        let refusals = end.as_ref().err().into_iter().flatten();
        refused.extend(refusals.map(|refusal| (DistanceEnd::From(i), refusal.clone())));
    }
    for (i, end) in to.iter().enumerate().filter(|&(i, _)| is_wanted.1[i]) {
        if same_points && refused.iter().any(|&(end, _)| end == DistanceEnd::From(i)) {
            continue;
        }
        let refusals = end.as_ref().err().into_iter().flatten();
        refused.extend(refusals.map(|refusal| (DistanceEnd::To(i), refusal.clone())));
    }
    if refused.is_empty() { Ok(()) } else { Err(DistancesRefusal::Ends(refused)) }
}
