//! The shortest way to place what is left, by neighbours alone: a table over counts of what is left and the item placed
//! last, filled from nothing left upwards (Held and Karp 1962, over counts). With kept order it bounds every completion
//! from below, poses included; its last entry bounds the layout.
//!
//! Memory is items · Π (quantity + 1) numbers, time that times the items.

use crate::instance::Instance;
use traverse_solve::{Budget, Interrupt};

/// The largest table.
const MOST_BYTES: usize = 256 << 20;

/// No completion is allowed.
pub(crate) const NO_COMPLETION: i64 = i64::MAX / 4;

/// Least lengths of completions.
#[derive(Debug)]
pub(crate) struct Completion {
    pub(crate) counts: Counts,
    items: usize,
    /// From the left edge of the item placed last to the furthest right end.
    least: Vec<i64>,
}

/// Counts of what is left, as one number.
#[derive(Clone, Debug)]
pub(crate) struct Counts {
    stride: Vec<usize>,
    quantity: Vec<usize>,
    /// Kinds that must be used up before a kind may come.
    before: Vec<Vec<usize>>,
    last: Option<usize>,
    size: usize,
}

impl Counts {
    /// Nothing when there are too many to number.
    pub(crate) fn of(instance: &Instance) -> Option<Self> {
        let kinds = instance.kinds.len();
        let quantity: Vec<usize> = (0..kinds).map(|kind| instance.quantity(kind)).collect();
        let mut stride = vec![];
        let mut size = 1_usize;
        for &quantity in &quantity {
            stride.push(size);
            size = size.checked_mul(quantity + 1)?;
        }
        let mut before = vec![vec![]; kinds];
        for &(early, late) in &instance.precedences {
            before[late].push(early);
        }
        Some(Self { stride, quantity, before, last: instance.last, size })
    }

    /// All copies of all kinds are left.
    pub(crate) fn full(&self) -> usize {
        self.size - 1
    }

    /// How many copies of a kind are left.
    pub(crate) fn left(&self, state: usize, kind: usize) -> usize {
        state / self.stride[kind] % (self.quantity[kind] + 1)
    }

    /// What is left after one more copy of the kind.
    pub(crate) fn without(&self, state: usize, kind: usize) -> usize {
        state - self.stride[kind]
    }

    /// Whether a copy of the kind may come next.
    pub(crate) fn may_come(&self, state: usize, kind: usize) -> bool {
        let left = self.left(state, kind);
        left > 0
            && self.before[kind].iter().all(|&before| self.left(state, before) == 0)
            && (self.last != Some(kind) || left > 1 || state == self.stride[kind])
    }
}

impl Completion {
    /// Whether the table is small enough to be filled.
    pub(crate) fn fits(instance: &Instance) -> bool {
        Counts::of(instance).is_some_and(|counts| {
            counts.size.saturating_mul(instance.items.len()).saturating_mul(8) <= MOST_BYTES
        })
    }

    /// The table. Nothing when it is too large.
    pub(crate) fn of(instance: &Instance, budget: &Budget) -> Result<Option<Self>, Interrupt> {
        let Some(counts) = Counts::of(instance).filter(|_| Self::fits(instance)) else { return Ok(None) };
        let items = instance.items.len();
        let mut least = vec![NO_COMPLETION; counts.size * items];
        for (least, item) in least.iter_mut().zip(&instance.items) {
            *least = item.width;
        }
        let offsets: Vec<i64> =
            (0..items * items).map(|at| instance.offset(at / items, at % items)).collect();
        // What comes next, and the length from there on.
        let mut next: Vec<(usize, i64)> = vec![];
        for state in 1..counts.size {
            if state % 256 == 1 {
                budget.check(0)?;
            }
            next.clear();
            for kind in (0..instance.kinds.len()).filter(|&kind| counts.may_come(state, kind)) {
                let rest = counts.without(state, kind) * items;
                let allowed = instance.kinds[kind].items.clone().map(|item| (item, least[rest + item]));
                next.extend(allowed.filter(|next| next.1 < NO_COMPLETION));
            }
            for before in 0..items {
                let row = &offsets[before * items..][..items];
                let kind = instance.items[before].kind;
                let mut shortest = NO_COMPLETION;
                for &(item, rest) in &next {
                    let length = row[item] + rest;
                    if length < shortest && instance.may_join(kind, instance.items[item].kind) {
                        shortest = length;
                    }
                }
                least[state * items + before] = shortest.max(instance.items[before].width);
            }
        }
        Ok(Some(Self { counts, items, least }))
    }

    /// From the left edge of `item`, placed last, to the furthest right end when the rest is placed as well as
    /// neighbours permit; [`NO_COMPLETION`] when nothing is allowed.
    #[inline]
    pub(crate) fn length(&self, state: usize, item: usize) -> i64 {
        self.least[state * self.items + item]
    }

    /// No layout is shorter; [`NO_COMPLETION`] when none is allowed.
    pub(crate) fn bound(&self, instance: &Instance) -> i64 {
        let full = self.counts.full();
        let starts = |kind: usize| {
            let first = instance.first.is_none_or(|first| first == kind);
            first && self.counts.may_come(full, kind)
        };
        let begins = (0..instance.kinds.len()).filter(|&kind| starts(kind)).flat_map(|kind| {
            let rest = self.counts.without(full, kind);
            instance.kinds[kind].items.clone().map(move |item| self.length(rest, item))
        });
        begins.min().unwrap_or(NO_COMPLETION)
    }
}
