//! The shortest way to place what is left, by neighbours alone: a table over counts of what is left and the item placed
//! last, filled from nothing left upwards (Held and Karp 1962, over counts). It bounds every completion from below,
//! poses included, and its last entry bounds the layout: what stands further right is at least that far from what stands
//! anywhere left of it, so any chain of sections is no longer than the layout. For the same reason a table over *some*
//! kinds bounds the layout, too, and better where others leave heights uncovered. The table over all kinds has every such
//! chain in it: which part of what is left has the longest one is noted while it is filled.
//!
//! Memory is items · Π (quantity + 1) numbers of four bytes, and two more for each state, time that times the items. Entries count in a coarser unit
//! where the layout is longer than 2³⁰ units of the grid, rounded down: a bound then misses less than that unit for each
//! copy, a few hundred-millionths of the length.

use crate::instance::Instance;
use crate::longest_parts::LongestParts;
use traverse_solve::{Budget, Interrupt};

/// The largest table: 20 sections in four poses.
const MOST_BYTES: usize = 352 << 20;

/// No completion is allowed, or none as short as the layout known.
pub(crate) const NO_COMPLETION: i64 = i64::MAX / 4;

/// The same in the table: two of them can be added.
pub(crate) const NONE: i32 = i32::MAX / 2;

/// Least lengths of completions.
#[derive(Debug)]
pub(crate) struct Completion {
    pub(crate) counts: Counts,
    items: usize,
    /// Units of the grid in one of an entry.
    unit: i64,
    /// From the left edge of the item placed last to the furthest right end.
    least: Vec<i32>,
    /// By what is left: the part of it whose chain is longest. Empty where entries know of joins that are forbidden:
    /// between neighbours of a part others may stand.
    longest_part: Vec<u32>,
}

/// Counts of what is left, as one number.
#[derive(Clone, Debug)]
pub(crate) struct Counts {
    pub(crate) stride: Vec<usize>,
    quantity: Vec<usize>,
    /// Kinds that must be used up before a kind may come.
    before: Vec<Vec<usize>>,
    last: Option<usize>,
    /// Whether every kind is counted.
    whole: bool,
    /// Whether every kind has one copy: then what is left is a set of bits.
    single: bool,
    size: usize,
}

impl Counts {
    /// Of the kinds that are members. Nothing when there are too many to number.
    pub(crate) fn of(instance: &Instance, members: &[bool]) -> Option<Self> {
        let kinds = instance.kinds.len();
        let quantity: Vec<usize> =
            (0..kinds).map(|kind| if members[kind] { instance.quantity(kind) } else { 0 }).collect();
        let mut stride = vec![];
        let mut size = 1_usize;
        for &quantity in &quantity {
            stride.push(size);
            size = size.checked_mul(quantity + 1)?;
        }
        let mut before = vec![vec![]; kinds];
        for (early, late) in instance.all_precedences() {
            before[late].push(early);
        }
        let whole = members.iter().all(|&member| member);
        let single = quantity.iter().all(|&quantity| quantity == 1);
        Some(Self { stride, quantity, before, last: instance.last, whole, single, size })
    }

    /// All copies of all kinds are left.
    pub(crate) fn full(&self) -> usize {
        self.size - 1
    }

    /// How many copies of a kind are left.
    #[inline]
    pub(crate) fn left(&self, state: usize, kind: usize) -> usize {
        if self.single {
            return usize::from(state & self.stride[kind] != 0);
        }
        state / self.stride[kind] % (self.quantity[kind] + 1)
    }

    /// What is left of these kinds when of all kinds `state` of `all` is left.
    pub(crate) fn within(&self, all: &Self, state: usize) -> usize {
        if self.whole {
            return state;
        }
        let counted = (0..self.stride.len()).filter(|&kind| self.quantity[kind] > 0);
        counted.map(|kind| all.left(state, kind) * self.stride[kind]).sum()
    }

    /// What two states have in common: of each kind the fewer copies.
    pub(crate) fn common(&self, a: usize, b: usize) -> usize {
        if self.single {
            return a & b;
        }
        (0..self.stride.len())
            .map(|kind| self.left(a, kind).min(self.left(b, kind)) * self.stride[kind])
            .sum()
    }

    /// What is left after one more copy of the kind.
    pub(crate) fn without(&self, state: usize, kind: usize) -> usize {
        state - self.stride[kind]
    }

    /// What is left when one more copy of the kind is.
    pub(crate) fn with(&self, state: usize, kind: usize) -> usize {
        state + self.stride[kind]
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
    /// The table over the kinds that are members, for completions up to `longest`, the length of a layout that is
    /// known. Forbidden joins count only where all kinds are members: others may stand between. Nothing when the table
    /// would be too large.
    pub(crate) fn of(
        instance: &Instance,
        members: &[bool],
        longest: i64,
        budget: &Budget,
    ) -> Result<Option<Self>, Interrupt> {
        let items = instance.items.len();
        // Each entry, and for each state which part has the longest chain, and how long.
        let bytes = |counts: &Counts| counts.size.saturating_mul(items + 2).saturating_mul(size_of::<i32>());
        let Some(counts) = Counts::of(instance, members).filter(|counts| bytes(counts) <= MOST_BYTES) else {
            return Ok(None);
        };
        let unit = longest / i64::from(NONE - 1) + 1;
        let limit = i64::from(NONE);
        let entry = |length: i64| length.div_euclid(unit).clamp(-limit, limit) as i32;
        let widths: Vec<i32> = instance.items.iter().map(|item| entry(item.width)).collect();
        let joined = |at: usize| {
            let (left, right) = (at / items, at % items);
            let allowed =
                !counts.whole || instance.may_join(instance.items[left].kind, instance.items[right].kind);
            if allowed { entry(instance.offset(left, right)) } else { NONE }
        };
        let offsets: Vec<i32> = (0..items * items).map(joined).collect();
        let mut least = vec![NONE; counts.size * items];
        least[..items].copy_from_slice(&widths);
        let mut parts = (!instance.forbids_joins()).then(|| LongestParts::new(counts.size));
        // The length from an item on that may come next.
        let mut next = vec![NONE; items];
        for state in 1..counts.size {
            if state % 64 == 1 {
                budget.check(0)?;
            }
            next.fill(NONE);
            for kind in (0..instance.kinds.len()).filter(|&kind| counts.may_come(state, kind)) {
                let own = instance.kinds[kind].items.clone();
                let rest = counts.without(state, kind) * items;
                next[own.clone()].copy_from_slice(&least[rest + own.start..rest + own.end]);
            }
            if let Some(parts) = &mut parts {
                parts.note(&counts, state, next.iter().copied().fold(NONE, i32::min));
            }
            for kind in 0..instance.kinds.len() {
                // What was placed last is not left; what is no member may be placed any time.
                if counts.quantity[kind] > 0 && counts.left(state, kind) == counts.quantity[kind] {
                    continue;
                }
                for before in instance.kinds[kind].items.clone() {
                    let row = &offsets[before * items..][..items];
                    // Offsets may be below 0: what is not allowed stays so.
                    let through = row
                        .iter()
                        .zip(&next)
                        .map(|(&offset, &next)| if next == NONE { NONE } else { offset + next });
                    let shortest = through.fold(NONE, i32::min);
                    least[state * items + before] = shortest.max(widths[before]).min(NONE);
                }
            }
        }
        let longest_part = parts.map_or(vec![], |parts| parts.part);
        Ok(Some(Self { counts, items, unit, least, longest_part }))
    }

    /// The part of what is left whose chain is longest. Nothing where only all of it makes a chain.
    pub(crate) fn longest_part(&self, state: usize) -> Option<usize> {
        self.longest_part.get(state).map(|&part| part as usize)
    }

    /// No layout is shorter than the longest chain that leaves out what it may.
    pub(crate) fn longest_bound(&self, instance: &Instance) -> Option<i64> {
        let part = self.longest_part(self.counts.full())?;
        let kinds = (0..instance.kinds.len()).filter(|&kind| self.counts.may_come(part, kind));
        let begins = kinds.flat_map(|kind| {
            let rest = self.counts.without(part, kind);
            instance.kinds[kind].items.clone().map(move |item| self.length(rest, item))
        });
        begins.min()
    }

    /// From the left edge of `item`, placed last, to the furthest right end when the rest is placed as well as
    /// neighbours permit; [`NO_COMPLETION`] when nothing is allowed that is as short as the layout known.
    #[inline]
    pub(crate) fn length(&self, state: usize, item: usize) -> i64 {
        match self.least[state * self.items + item] {
            NONE => NO_COMPLETION,
            entry => i64::from(entry) * self.unit,
        }
    }

    /// What the table takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.least[..]) + size_of_val(&self.longest_part[..])
    }

    /// What a length may miss, units of the grid.
    pub(crate) fn coarseness(&self, instance: &Instance) -> i64 {
        (self.unit - 1) * (instance.copies as i64 + 1)
    }

    /// No layout is shorter; [`NO_COMPLETION`] when none is allowed that is as short as the layout known.
    pub(crate) fn bound(&self, instance: &Instance) -> i64 {
        let full = self.counts.full();
        let starts = |kind: usize| {
            let first = instance.first.filter(|&first| self.counts.quantity[first] > 0);
            first.is_none_or(|first| first == kind) && self.counts.may_come(full, kind)
        };
        let begins = (0..instance.kinds.len()).filter(|&kind| starts(kind)).flat_map(|kind| {
            let rest = self.counts.without(full, kind);
            instance.kinds[kind].items.clone().map(move |item| self.length(rest, item))
        });
        begins.min().unwrap_or(NO_COMPLETION)
    }
}
