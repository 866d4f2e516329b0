//! Search on the true length, to proof: beginnings of layouts, the most promising first.
//!
//! A beginning is bounded by tables of completions, by heights where sections slide freely, and by how far right
//! everything that is left must stand at least. Of two beginnings with the same copies placed, the
//! second is dropped when the first leaves every item that is left at least as far left and is nowhere longer: what
//! matters of a skyline is where it lets the rest come. The least bound of all open beginnings bounds the layout.

use crate::completion::{Completion, Counts, NO_COMPLETION};
use crate::height_bound::{heights, least_thickness};
use crate::instance::{Instance, NOTHING_IN_THE_WAY};
use crate::progress::Progress;
use rustc_hash::FxHashMap;
use std::cell::Cell;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Interrupt};

/// What all beginnings together may take.
const MOST_BYTES: usize = 192 << 20;
/// Beginnings with the same copies placed that one is compared with.
const MOST_COMPARED: usize = 200;
/// Heights at which freely sliding sections are bounded.
const HEIGHTS: usize = 24;

/// How the search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Searched {
    /// No beginning is left that could lead to anything shorter.
    Everything,
    /// Memory ran out, or the layout is not for this search.
    Part,
}

/// The beginning of a layout.
#[derive(Debug)]
struct Beginning {
    before: u32,
    item: u32,
    /// What is left.
    state: usize,
    /// Of it, the part whose chain bounds best as far as is known.
    part: usize,
    /// Whether changes of the part have been tried.
    tightened: bool,
    /// Whether another is as good throughout.
    dropped: bool,
    end: i64,
    /// Where each item would stand next.
    next: Box<[i64]>,
    /// How far right everything placed reaches at some heights; with the free rule only.
    front: Box<[i64]>,
}

/// Thicknesses at some heights.
struct Thicknesses {
    /// By item: how far left and right it reaches.
    borders: Vec<Vec<Option<(i64, i64)>>>,
    /// By kind: the least in any pose, and a gap.
    least: Vec<Vec<i64>>,
    gap: i64,
}

struct Search<'a> {
    instance: &'a Instance,
    counts: Counts,
    tables: &'a [Completion],
    thicknesses: Option<Thicknesses>,
    beginnings: Vec<Beginning>,
    open: BinaryHeap<(Reverse<i64>, usize, u32)>,
    /// By what is left and, where joins are forbidden, what came last.
    like: FxHashMap<(usize, usize), Vec<u32>>,
    /// The kind that began the shortest chain the last time.
    likely: Cell<usize>,
}

/// Searches until everything is decided, memory runs out or the budget ends.
pub(crate) fn search(
    instance: &Instance,
    tables: &[Completion],
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<Searched, Interrupt> {
    let free = instance.rule == SlideRule::Free;
    let everything = vec![true; instance.kinds.len()];
    let Some(counts) = Counts::of(instance, &everything).filter(|_| !tables.is_empty()) else {
        return Ok(Searched::Part);
    };
    let mut search = Search {
        instance,
        counts,
        tables,
        thicknesses: free.then(|| Thicknesses::of(instance)),
        beginnings: vec![],
        open: BinaryHeap::new(),
        like: FxHashMap::default(),
        likely: Cell::new(0),
    };
    search.run(progress, budget)
}

impl Thicknesses {
    fn of(instance: &Instance) -> Self {
        let heights = heights(instance, HEIGHTS);
        let borders = |item: usize| {
            let profile = &instance.items[item].profile;
            let border = |&y: &f64| {
                let (right, left) = (profile.right.x(y)?, profile.left.x(y)?);
                Some((-instance.grid.down(left), instance.grid.down(right)))
            };
            heights.iter().map(border).collect()
        };
        let least =
            |kind: usize| heights.iter().map(|&y| least_thickness(instance, kind, y).unwrap_or(0)).collect();
        Self {
            borders: (0..instance.items.len()).map(borders).collect(),
            least: (0..instance.kinds.len()).map(least).collect(),
            gap: instance.grid.down(instance.gap),
        }
    }
}

impl Search<'_> {
    fn run(&mut self, progress: &mut Progress<'_>, budget: &Budget) -> Result<Searched, Interrupt> {
        let items = self.instance.items.len();
        let front = self.thicknesses.as_ref().map_or(0, |_| HEIGHTS);
        let most = MOST_BYTES / (size_of::<Beginning>() + 32 + 8 * (items + front));
        let empty = Beginning {
            before: u32::MAX,
            item: u32::MAX,
            state: self.counts.full(),
            part: self.counts.full(),
            tightened: true,
            dropped: false,
            end: 0,
            next: vec![0; items].into_boxed_slice(),
            front: vec![i64::MIN; front].into_boxed_slice(),
        };
        self.beginnings.push(empty);
        self.open.push((Reverse(0), 0, 0));
        while let Some((Reverse(bound), placed, number)) = self.open.pop() {
            if progress.is_reached_by(bound) {
                // Everything else that is open is bounded no lower.
                break;
            }
            progress.raise_bound(bound);
            if progress.is_close_enough() || self.beginnings.len() > most {
                return Ok(Searched::Part);
            }
            budget.check(progress.iterations())?;
            progress.add_iterations(1);
            if self.beginnings[number as usize].dropped {
                continue;
            }
            let tighter = self.tightened(number);
            if tighter > bound {
                self.open.push((Reverse(tighter), placed, number));
            } else {
                self.grow((bound, placed, number), progress);
            }
        }
        if progress.best().is_some() {
            progress.raise_bound_to_what_is_reached();
        }
        Ok(Searched::Everything)
    }

    /// Every beginning that has one section more.
    fn grow(&mut self, (least, placed, number): (i64, usize, u32), progress: &mut Progress<'_>) {
        let (state, last) = (self.beginnings[number as usize].state, self.beginnings[number as usize].item);
        for kind in 0..self.instance.kinds.len() {
            let joins = match self.instance.items.get(last as usize) {
                Some(last) => self.instance.may_join(last.kind, kind),
                None => self.instance.first.is_none_or(|first| first == kind),
            };
            if !joins || !self.counts.may_come(state, kind) {
                continue;
            }
            for item in self.instance.kinds[kind].items.clone() {
                let beginning = self.with(number, item);
                if beginning.state == 0 {
                    if beginning.end < progress.upper() {
                        progress.offer(&self.items_of(&beginning), beginning.end);
                    }
                    continue;
                }
                // What the beginning's own beginning is bounded by bounds it, too.
                let bound = self.bound(&beginning, least);
                if !progress.is_reached_by(bound) && self.takes_its_place(&beginning) {
                    let fresh = self.beginnings.len() as u32;
                    let like = self.like.entry(self.likeness(&beginning)).or_default();
                    like.push(fresh);
                    self.open.push((Reverse(bound), placed + 1, fresh));
                    self.beginnings.push(beginning);
                }
            }
        }
    }

    /// One more item placed.
    fn with(&self, number: u32, item: usize) -> Beginning {
        let parent = &self.beginnings[number as usize];
        let instance = self.instance;
        let x = parent.next[item];
        let next = (0..instance.items.len()).map(|other| {
            // With kept order offsets are not below 0: nothing passes this left edge.
            let offset = instance.offset(item, other);
            if offset == NOTHING_IN_THE_WAY { parent.next[other] } else { parent.next[other].max(x + offset) }
        });
        let front = match &self.thicknesses {
            None => Box::default(),
            Some(thicknesses) => {
                let reached = thicknesses.borders[item].iter().zip(&parent.front);
                reached
                    .map(|(border, &front)| border.map_or(front, |(_, right)| front.max(x + right)))
                    .collect()
            }
        };
        let state = self.counts.without(parent.state, instance.items[item].kind);
        Beginning {
            before: number,
            item: item as u32,
            state,
            part: self.counts.common(parent.part, state),
            tightened: false,
            dropped: false,
            end: parent.end.max(x + instance.items[item].width),
            next: next.collect(),
            front,
        }
    }

    /// No layout that begins so is shorter; nor is any shorter than `least`.
    fn bound(&self, beginning: &Beginning, least: i64) -> i64 {
        let instance = self.instance;
        let mut bound = least.max(beginning.end).max(self.front_bound(beginning));
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

    /// A better bound by another part of what is left: all of it, that with the longest chain, and what the better of
    /// these becomes by changes of a copy at a time. Every part's chain bounds. Done once for each beginning and only
    /// when it is the most promising: most never are.
    fn tightened(&mut self, number: u32) -> i64 {
        let beginning = &self.beginnings[number as usize];
        let state = beginning.state;
        let Some((table, longest)) = self.parts(state).filter(|_| !beginning.tightened) else { return 0 };
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
        let beginning = &mut self.beginnings[number as usize];
        (beginning.part, beginning.tightened) = (best.1, true);
        best.0
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

    /// At every height what is left stands to the right of what is placed.
    fn front_bound(&self, beginning: &Beginning) -> i64 {
        let Some(thicknesses) = &self.thicknesses else { return 0 };
        let lengths = beginning.front.iter().enumerate().map(|(at, &front)| {
            let left =
                |kind: usize| self.counts.left(beginning.state, kind) as i64 * thicknesses.least[kind][at];
            let rest: i64 = (0..self.instance.kinds.len()).map(left).sum();
            // The first at a height needs no gap before it.
            if front == i64::MIN { rest - thicknesses.gap } else { front + rest }
        });
        lengths.max().unwrap_or(0)
    }

    fn likeness(&self, beginning: &Beginning) -> (usize, usize) {
        let last =
            if self.instance.forbids_joins() { self.instance.items[beginning.item as usize].kind } else { 0 };
        (beginning.state, last)
    }

    /// Whether no other beginning with the same copies is at least as good throughout. Those that it is as good as
    /// itself are dropped then: it is put in their place.
    fn takes_its_place(&mut self, beginning: &Beginning) -> bool {
        let likeness = self.likeness(beginning);
        let Some(like) = self.like.get_mut(&likeness) else { return true };
        let instance = self.instance;
        let left: Vec<usize> = (0..instance.items.len())
            .filter(|&item| self.counts.left(beginning.state, instance.items[item].kind) > 0)
            .collect();
        let is_as_good = |one: &Beginning, other: &Beginning| {
            one.end <= other.end && left.iter().all(|&item| one.next[item] <= other.next[item])
        };
        let compared = like.len().saturating_sub(MOST_COMPARED);
        let others = &like[compared..];
        if others.iter().rev().any(|&other| is_as_good(&self.beginnings[other as usize], beginning)) {
            return false;
        }
        let mut kept = compared;
        for at in compared..like.len() {
            let other = &mut self.beginnings[like[at] as usize];
            other.dropped = is_as_good(beginning, other);
            if !other.dropped {
                like[kept] = like[at];
                kept += 1;
            }
        }
        like.truncate(kept);
        true
    }

    fn items_of(&self, beginning: &Beginning) -> Vec<usize> {
        let mut items = vec![beginning.item as usize];
        let mut at = beginning.before;
        while let Some(earlier) = self.beginnings.get(at as usize).filter(|earlier| earlier.item != u32::MAX)
        {
            items.push(earlier.item as usize);
            at = earlier.before;
        }
        items.reverse();
        items
    }
}
