//! How short a layout that begins in some way can be at best: by where what is left can stand next, by heights where
//! sections slide freely, and by chains of what is left.
//!
//! What is left stands no further left than what is placed lets it, and each two of it at least their own offset apart,
//! whatever stands between. So the shortest way to line up *any part* of what is left, begun where its first may stand,
//! bounds the layout. The table of completions over all kinds has the rest of each such chain.

use crate::beginning::Beginning;
use crate::completion::{Completion, Counts, NO_COMPLETION};
use crate::instance::Instance;
use crate::thicknesses::Thicknesses;
use std::cell::Cell;
use traverse_geometry::SlideRule;

/// What bounds beginnings.
pub(crate) struct BeginningBound<'a> {
    instance: &'a Instance,
    pub(crate) counts: Counts,
    /// That over all kinds first.
    tables: &'a [Completion],
    /// Where sections slide freely.
    pub(crate) thicknesses: Option<Thicknesses>,
    /// The kind that began the shortest chain the last time.
    likely: Cell<usize>,
}

impl<'a> BeginningBound<'a> {
    /// Nothing without a table of completions.
    pub(crate) fn new(instance: &'a Instance, tables: &'a [Completion]) -> Option<Self> {
        let everything = vec![true; instance.kinds.len()];
        let counts = Counts::of(instance, &everything).filter(|_| !tables.is_empty())?;
        let free = instance.rule == SlideRule::Free;
        let thicknesses = free.then(|| Thicknesses::of(instance));
        Some(Self { instance, counts, tables, thicknesses, likely: Cell::new(0) })
    }

    /// No layout that begins so is shorter; nor is any shorter than `least`.
    pub(crate) fn bound(&self, beginning: &Beginning, least: i64) -> i64 {
        let instance = self.instance;
        let front = self.thicknesses.as_ref().map_or(0, |front| front.bound(beginning, &self.counts));
        let mut bound = least.max(beginning.end).max(front);
        for kind in 0..instance.kinds.len() {
            if self.counts.left(beginning.state, kind) > 0 {
                let items = instance.kinds[kind].items.clone();
                let nearest = items.map(|item| beginning.next[item] + instance.items[item].width).min();
                bound = bound.max(nearest.unwrap_or(0));
            }
        }
        if let Some((table, _)) = self.parts(beginning.state) {
            return bound.max(self.part_bound(beginning, table, beginning.part, bound));
        }
        for (number, table) in self.tables.iter().enumerate() {
            let state = table.counts.within(&self.counts, beginning.state);
            if state > 0 {
                bound = bound.max(self.table_bound(beginning, table, state, number == 0, bound));
            }
        }
        bound
    }

    /// The table in which every part of what is left has its chain, and the part with the longest.
    fn parts(&self, state: usize) -> Option<(&Completion, usize)> {
        self.tables.first().and_then(|table| Some((table, table.longest_part(state)?)))
    }

    /// A better bound by another part of what is left, and that part: all of it, the part with the longest chain, and
    /// what the better of these becomes by changes of a copy at a time. Every part's chain bounds.
    pub(crate) fn tightened(&self, beginning: &Beginning) -> Option<(i64, usize)> {
        let state = beginning.state;
        let (table, longest) = self.parts(state)?;
        let mut best = (0, state);
        let try_part = |part: usize, best: &mut (i64, usize)| {
            let bound = self.part_bound(beginning, table, part, best.0);
            let better = bound > best.0;
            if better {
                *best = (bound, part);
            }
            better
        };
        for part in [beginning.part, longest, state] {
            try_part(part, &mut best);
        }
        let mut better = true;
        while better {
            better = false;
            for kind in 0..self.instance.kinds.len() {
                let (in_part, left) = (self.counts.left(best.1, kind), self.counts.left(state, kind));
                let more = (in_part < left).then(|| self.counts.with(best.1, kind));
                let fewer = (in_part > 0).then(|| self.counts.without(best.1, kind));
                for part in [more, fewer].into_iter().flatten() {
                    better |= try_part(part, &mut best);
                }
            }
        }
        Some(best)
    }

    /// By the chain of a part of what is left; `floor` as in [`Self::table_bound`].
    fn part_bound(&self, beginning: &Beginning, table: &Completion, part: usize, floor: i64) -> i64 {
        // Of nothing there is no chain.
        if part == 0 { floor } else { self.table_bound(beginning, table, part, false, floor) }
    }

    /// By the chain of what is left of a table's kinds. `floor` where that bounds
    /// no better: how much worse doesn't matter.
    fn table_bound(
        &self,
        beginning: &Beginning,
        table: &Completion,
        state: usize,
        neighbours: bool,
        floor: i64,
    ) -> i64 {
        let instance = self.instance;
        let last = instance.items[beginning.item as usize].kind;
        let mut shortest = NO_COMPLETION;
        let kinds = instance.kinds.len();
        // What began the shortest chain the last time often does again.
        let likely = self.likely.get();
        for kind in (likely..kinds).chain(0..likely) {
            if !table.counts.may_come(state, kind) || (neighbours && !instance.may_join(last, kind)) {
                continue;
            }
            let rest = table.counts.without(state, kind);
            for item in instance.kinds[kind].items.clone() {
                let through = beginning.next[item].saturating_add(table.length(rest, item));
                if through < shortest {
                    shortest = through;
                    self.likely.set(kind);
                    if shortest <= floor {
                        return floor;
                    }
                }
            }
        }
        shortest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placing::Placing;
    use rand::RngExt;
    use rand_xoshiro::Xoshiro256PlusPlus;
    use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section, SectionLayout};
    use traverse_solve::{Budget, Seed};

    /// Sections that reach some heights of 0 to 6, leaning; five copies in all.
    fn layout(slide_rule: SlideRule, chance: &mut Xoshiro256PlusPlus) -> SectionLayout {
        let mut section = |id: usize| {
            let low = f64::from(chance.random_range(0..5));
            let high = f64::from(chance.random_range(low as i32 + 1..=6));
            let (width, lean) = (chance.random_range(1.0..5.0), chance.random_range(0.0..4.0));
            let xy = [0.0, low, width, low, width + lean, high, lean, high];
            let shape = Polygon::from_ring(Ring::from_xy(&xy, &[]).expect("a parallelogram"));
            let part =
                Part { id: "part".into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false };
            let poses = Pose::ALL[..chance.random_range(1..=2)].to_vec();
            Section { id: id.to_string(), parts: vec![part], quantity: 1 + u32::from(id == 1), poses }
        };
        let sections = (0..4).map(&mut section).collect();
        let precedences = if chance.random_bool(0.3) { vec![(1, 2)] } else { vec![] };
        let last = chance.random_bool(0.3).then_some(1);
        SectionLayout {
            sections,
            gap_mm: 0.0,
            strip_height_mm: None,
            first: None,
            last,
            precedences,
            forbidden_joins: vec![],
            slide_rule,
        }
    }

    /// The length of every layout that begins so is told.
    fn all(instance: &Instance, items: &mut Vec<usize>, tell: &mut dyn FnMut(&[usize], i64)) {
        if items.len() == instance.copies {
            let kinds: Vec<usize> = items.iter().map(|&item| instance.items[item].kind).collect();
            if instance.is_allowed(&kinds) {
                let placing = Placing::of(instance, items, &Budget::unlimited()).expect("no limit");
                tell(items, placing.length());
            }
            return;
        }
        for item in 0..instance.items.len() {
            let kind = instance.items[item].kind;
            let placed = items.iter().filter(|&&other| instance.items[other].kind == kind).count();
            if placed < instance.quantity(kind) {
                items.push(item);
                all(instance, items, tell);
                items.pop();
            }
        }
    }

    #[test]
    fn no_layout_that_begins_so_is_shorter_whatever_part_is_chosen() {
        let mut chance = Seed(5).stream();
        let (mut checked, mut raised) = (0, 0);
        for case in 0..60 {
            let rule = [SlideRule::KeepOrder, SlideRule::Free][case % 2];
            let budget = Budget::unlimited();
            let instance = Instance::of(&layout(rule, &mut chance), 1, &budget).expect("no limit");
            let everything = vec![true; instance.kinds.len()];
            let longest = instance.sum_of_reaches();
            let table = Completion::of(&instance, &everything, longest, &budget).expect("no limit");
            let tables = [table.expect("a small table")];
            let bounds = BeginningBound::new(&instance, &tables).expect("a table");
            let mut shortest = i64::MAX;
            all(&instance, &mut vec![], &mut |_, length| shortest = shortest.min(length));
            let parts = tables[0].longest_bound(&instance).expect("nothing is forbidden");
            assert!(parts <= shortest && tables[0].bound(&instance) <= shortest, "{case}");
            raised += usize::from(parts > tables[0].bound(&instance));
            for item in 0..instance.items.len() {
                let mut shortest = i64::MAX;
                all(&instance, &mut vec![item], &mut |_, length| shortest = shortest.min(length));
                let kind = instance.items[item].kind;
                if shortest == i64::MAX {
                    continue;
                }
                let state = bounds.counts.without(bounds.counts.full(), kind);
                let next = (0..instance.items.len()).map(|other| instance.offset(item, other).max(0));
                let mut beginning = Beginning {
                    before: 0,
                    item: item as u32,
                    state,
                    part: state,
                    tightened: false,
                    dropped: false,
                    end: instance.items[item].width,
                    next: next.collect(),
                    front: Box::default(),
                };
                for part in 0..=state {
                    beginning.part = bounds.counts.common(part, state);
                    assert!(bounds.bound(&beginning, 0) <= shortest, "{case}: {part}");
                    checked += 1;
                }
                let tightened = bounds.tightened(&beginning).expect("nothing is forbidden").0;
                assert!(tightened <= shortest, "{case}");
            }
        }
        assert!(checked > 1_000 && raised > 10, "{checked} {raised}");
    }
}
