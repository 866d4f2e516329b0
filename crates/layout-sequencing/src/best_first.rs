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
            self.grow(number, placed, progress);
        }
        if progress.best().is_some() {
            progress.raise_bound_to_what_is_reached();
        }
        Ok(Searched::Everything)
    }

    /// Every beginning that has one section more.
    fn grow(&mut self, number: u32, placed: usize, progress: &mut Progress<'_>) {
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
                let bound = self.bound(&beginning);
                if !progress.is_reached_by(bound) && self.is_new(&beginning) {
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
        Beginning {
            before: number,
            item: item as u32,
            state: self.counts.without(parent.state, instance.items[item].kind),
            end: parent.end.max(x + instance.items[item].width),
            next: next.collect(),
            front,
        }
    }

    /// No layout that begins so is shorter.
    fn bound(&self, beginning: &Beginning) -> i64 {
        let instance = self.instance;
        let mut bound = beginning.end.max(self.front_bound(beginning));
        for kind in 0..instance.kinds.len() {
            if self.counts.left(beginning.state, kind) > 0 {
                let items = instance.kinds[kind].items.clone();
                let nearest = items.map(|item| beginning.next[item] + instance.items[item].width).min();
                bound = bound.max(nearest.unwrap_or(0));
            }
        }
        for (number, table) in self.tables.iter().enumerate() {
            let state = table.counts.within(&self.counts, beginning.state);
            if state > 0 {
                bound = bound.max(self.table_bound(beginning, table, state, number == 0));
            }
        }
        bound
    }

    /// By the chain of what is left of a table's kinds.
    fn table_bound(&self, beginning: &Beginning, table: &Completion, state: usize, neighbours: bool) -> i64 {
        let instance = self.instance;
        let last = instance.items[beginning.item as usize].kind;
        let mut shortest = NO_COMPLETION;
        for kind in 0..instance.kinds.len() {
            if !table.counts.may_come(state, kind) || (neighbours && !instance.may_join(last, kind)) {
                continue;
            }
            let rest = table.counts.without(state, kind);
            for item in instance.kinds[kind].items.clone() {
                shortest = shortest.min(beginning.next[item].saturating_add(table.length(rest, item)));
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

    /// Whether no other beginning with the same copies is at least as good throughout.
    fn is_new(&self, beginning: &Beginning) -> bool {
        let Some(like) = self.like.get(&self.likeness(beginning)) else { return true };
        let instance = self.instance;
        let left: Vec<usize> = (0..instance.items.len())
            .filter(|&item| self.counts.left(beginning.state, instance.items[item].kind) > 0)
            .collect();
        !like.iter().rev().take(MOST_COMPARED).any(|&other| {
            let other = &self.beginnings[other as usize];
            other.end <= beginning.end && left.iter().all(|&item| other.next[item] <= beginning.next[item])
        })
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
