//! Which kinds fit well behind a kind: what changes lean towards in layouts too large to try everything.

use crate::instance::Instance;
use crate::sequence::Sequence;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use traverse_solve::{Budget, Interrupt};

/// Layouts of fewer copies have no use for a leaning: everything is tried anyway.
const FEWEST_COPIES: usize = 40;
/// How many kinds are kept for each.
const WIDTH: usize = 10;

/// Which kinds fit well behind a kind.
#[derive(Debug, Default)]
pub(crate) struct Neighbours {
    lists: Vec<Vec<u32>>,
}

impl Neighbours {
    /// The lists of an instance whose offsets are at hand; none for small ones and for ones that are computed lazily.
    /// A join counts as good when it saves more than others of the same right section do on average. Cost: O(n²).
    pub(crate) fn of(instance: &Instance, budget: &Budget) -> Result<Self, Interrupt> {
        let count = instance.kinds.len();
        if instance.copies < FEWEST_COPIES || !instance.has_all_offsets() {
            return Ok(Self::default());
        }
        let mut least = vec![i64::MAX; count];
        for left in 0..count {
            budget.check(0)?;
            for (right, least) in least.iter_mut().enumerate() {
                *least = (*least).min(instance.kind_cost(left, right).unwrap_or(i64::MAX));
            }
        }
        let mut lists = vec![];
        for left in 0..count {
            budget.check(0)?;
            let mut fit: Vec<(i64, u32)> = (0..count)
                .filter_map(|right| {
                    Some((instance.kind_cost(left, right)?.saturating_sub(least[right]), right as u32))
                })
                .collect();
            let kept = WIDTH.min(fit.len());
            if kept < fit.len() {
                fit.select_nth_unstable(kept);
            }
            lists.push(fit[..kept].iter().map(|&(_, right)| right).collect());
        }
        Ok(Self { lists })
    }

    /// A position whose section fits behind the one at `place`; now and then none, and any will do.
    pub(crate) fn beside(
        &self,
        sequence: &Sequence<'_>,
        place: usize,
        chance: &mut Xoshiro256PlusPlus,
    ) -> Option<usize> {
        let list = self.lists.get(sequence.kind(place))?;
        if list.is_empty() || chance.random_ratio(1, 8) {
            return None;
        }
        let kind = list[chance.random_range(0..list.len())] as usize;
        Some(sequence.some_position(kind)).filter(|&at| at != place)
    }
}
