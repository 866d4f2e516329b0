//! Search on the true length, to proof: beginnings of layouts, the most promising first.
//!
//! Of two beginnings with the same copies placed, the
//! second is dropped when the first leaves every item that is left at least as far left and is nowhere longer: what
//! matters of a skyline is where it lets the rest come. The least bound of all open beginnings bounds the layout.

use crate::beginning::Beginning;
use crate::beginning_bound::BeginningBound;
use crate::completion::Completion;
use crate::instance::{Instance, NOTHING_IN_THE_WAY};
use crate::progress::Progress;
use crate::thicknesses::HEIGHTS;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_solve::{Budget, Interrupt};

/// What all beginnings together, and tables beyond the first, may take.
const MOST_BYTES: usize = 544 << 20;
/// Beginnings with the same copies placed that one is compared with.
const MOST_COMPARED: usize = 200;

/// How the search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Searched {
    /// No beginning is left that could lead to anything shorter.
    Everything,
    /// Memory ran out, or the layout is not for this search.
    Part,
}

struct Search<'a> {
    instance: &'a Instance,
    bounds: BeginningBound<'a>,
    /// What beginnings may take.
    most_bytes: usize,
    beginnings: Vec<Beginning>,
    /// How many of them are dropped.
    dropped: usize,
    open: BinaryHeap<(Reverse<i64>, usize, u32)>,
    /// By what is left and, where joins are forbidden, what came last.
    like: FxHashMap<(usize, usize), Vec<u32>>,
}

/// Searches until everything is decided, memory runs out or the budget ends.
pub(crate) fn search(
    instance: &Instance,
    tables: &[Completion],
    progress: &mut Progress<'_>,
    budget: &Budget,
) -> Result<Searched, Interrupt> {
    let Some(bounds) = BeginningBound::new(instance, tables) else { return Ok(Searched::Part) };
    let more_tables: usize = tables.iter().skip(1).map(Completion::bytes).sum();
    let most_bytes = MOST_BYTES.saturating_sub(more_tables);
    let mut search = Search {
        instance,
        most_bytes,
        dropped: 0,
        bounds,
        beginnings: vec![],
        open: BinaryHeap::new(),
        like: FxHashMap::default(),
    };
    search.run(progress, budget)
}

impl Search<'_> {
    fn run(&mut self, progress: &mut Progress<'_>, budget: &Budget) -> Result<Searched, Interrupt> {
        let items = self.instance.items.len();
        let front = self.bounds.thicknesses.as_ref().map_or(0, |_| HEIGHTS);
        // A beginning waits, is listed among those like it, and says where each item would stand.
        let (bytes, bytes_held) = (size_of::<Beginning>() + 32, 8 * (items + front));
        let empty = Beginning {
            before: u32::MAX,
            item: u32::MAX,
            state: self.bounds.counts.full(),
            part: self.bounds.counts.full(),
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
            let held = self.beginnings.len() - self.dropped;
            if progress.is_close_enough()
                || self.beginnings.len() * bytes + held * bytes_held > self.most_bytes
            {
                return Ok(Searched::Part);
            }
            budget.check(progress.iterations())?;
            progress.add_iterations(1);
            if self.beginnings[number as usize].dropped {
                continue;
            }
            let tighter = self.tighten(number);
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

    /// A better bound by another part of what is left, sought once for each beginning and only when it is the most
    /// promising: most never are. 0 when it has been.
    fn tighten(&mut self, number: u32) -> i64 {
        let beginning = &mut self.beginnings[number as usize];
        if std::mem::replace(&mut beginning.tightened, true) {
            return 0;
        }
        let Some((bound, part)) = self.bounds.tightened(beginning) else { return 0 };
        beginning.part = part;
        bound
    }

    /// Every beginning that has one section more.
    fn grow(&mut self, (least, placed, number): (i64, usize, u32), progress: &mut Progress<'_>) {
        let (state, last) = (self.beginnings[number as usize].state, self.beginnings[number as usize].item);
        for kind in 0..self.instance.kinds.len() {
            let joins = match self.instance.items.get(last as usize) {
                Some(last) => self.instance.may_join(last.kind, kind),
                None => self.instance.first.is_none_or(|first| first == kind),
            };
            if !joins || !self.bounds.counts.may_come(state, kind) {
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
                let bound = self.bounds.bound(&beginning, least);
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
        let front = match &self.bounds.thicknesses {
            None => Box::default(),
            Some(thicknesses) => {
                let reached = thicknesses.borders[item].iter().zip(&parent.front);
                reached
                    .map(|(border, &front)| border.map_or(front, |(_, right)| front.max(x + right)))
                    .collect()
            }
        };
        let state = self.bounds.counts.without(parent.state, instance.items[item].kind);
        Beginning {
            before: number,
            item: item as u32,
            state,
            part: self.bounds.counts.common(parent.part, state),
            tightened: false,
            dropped: false,
            end: parent.end.max(x + instance.items[item].width),
            next: next.collect(),
            front,
        }
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
            .filter(|&item| self.bounds.counts.left(beginning.state, instance.items[item].kind) > 0)
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
            if is_as_good(beginning, other) {
                // It is never looked at again.
                (other.dropped, other.next, other.front) = (true, Box::default(), Box::default());
                self.dropped += 1;
            } else {
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
