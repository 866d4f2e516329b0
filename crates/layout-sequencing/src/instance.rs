//! A layout in the form that searches work on: kinds of sections with copies, items (a kind in a pose), and how far
//! apart the left edges of any two items must be.
//!
//! Sections that are equal bit for bit, and of which nothing is asked that tells them apart, are one kind: their
//! envelopes are computed once and their copies are interchangeable.

use crate::grid::Grid;
use crate::meeting::meeting;
use crate::offsets::Offsets;
use crate::profile::{Profile, Silhouette};
use rustc_hash::FxHashMap;
use std::ops::Range;
use traverse_geometry::{PlacedSection, Pose, Section, SectionLayout, SlideRule};
use traverse_solve::{Budget, Interrupt};

/// Copies that are interchangeable.
#[derive(Clone, Debug)]
pub(crate) struct Kind {
    /// The section that stands for all.
    pub(crate) section: usize,
    /// Which copies of which sections.
    pub(crate) copies: Vec<(usize, u32)>,
    /// Its items, one for each pose.
    pub(crate) items: Range<usize>,
}

/// A kind in a pose.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    pub(crate) kind: usize,
    pub(crate) pose: Pose,
    pub(crate) profile: Profile,
    /// Width rounded down, for bounds.
    pub(crate) width: i64,
    /// Nothing that stands this far left of another item's left edge can touch it: width and gap, rounded up.
    pub(crate) reach: i64,
}

/// A layout as searches see it.
#[derive(Clone, Debug)]
pub(crate) struct Instance {
    pub(crate) rule: SlideRule,
    pub(crate) grid: Grid,
    pub(crate) gap: f64,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) items: Vec<Item>,
    pub(crate) first: Option<usize>,
    pub(crate) last: Option<usize>,
    /// Pairs of kinds.
    pub(crate) precedences: Vec<(usize, usize)>,
    /// The same with all that follows from them.
    before: rustc_hash::FxHashSet<(usize, usize)>,
    forbidden: rustc_hash::FxHashSet<(usize, usize)>,
    /// The largest of all reaches.
    pub(crate) longest_reach: i64,
    /// How many copies there are in all.
    pub(crate) copies: usize,
    kind_of_section: Vec<usize>,
    offsets: Offsets,
}

/// What tells sections apart: their geometry, poses and, where it matters, their number.
#[derive(PartialEq, Eq, Hash)]
struct Likeness {
    numbers: Vec<u64>,
    poses: Vec<Pose>,
    alone: Option<usize>,
}

impl Likeness {
    fn of(layout: &SectionLayout, number: usize, poses: &[Pose]) -> Self {
        let section = &layout.sections[number];
        let mut numbers = vec![];
        for part in &section.parts {
            let shape = part.in_section();
            let outer = shape.outer();
            numbers.push(outer.len() as u64);
            numbers
                .extend(outer.vertices().iter().flat_map(|vertex| [vertex.x.to_bits(), vertex.y.to_bits()]));
            numbers.push(outer.bulges().len() as u64);
            numbers.extend(outer.bulges().iter().map(|bulge| bulge.to_bits()));
        }
        let named = |pairs: &[(usize, usize)]| pairs.iter().any(|&(a, b)| a == number || b == number);
        let alone = layout.first == Some(number)
            || layout.last == Some(number)
            || named(&layout.precedences)
            || named(&layout.forbidden_joins);
        Self { numbers, poses: poses.to_vec(), alone: alone.then_some(number) }
    }
}

impl Instance {
    /// The instance of a layout without findings, offsets at hand. Cost: O(n log n) for the envelopes; for the offsets linear in the
    /// vertices for each pair of items, when there are few enough to keep them all.
    #[cfg(test)]
    pub(crate) fn of(layout: &SectionLayout, threads: usize, budget: &Budget) -> Result<Self, Interrupt> {
        let mut instance = Self::of_envelopes(layout, budget)?;
        instance.work_out_offsets(threads, budget)?;
        Ok(instance)
    }

    /// The same whose offsets are computed when they are asked for.
    pub(crate) fn of_envelopes(layout: &SectionLayout, budget: &Budget) -> Result<Self, Interrupt> {
        Self::without_offsets(layout, &|section| layout.sections[section].poses.clone(), budget)
    }

    /// Works out all offsets when they are few enough to keep. Interrupted, they stay to be computed.
    pub(crate) fn work_out_offsets(&mut self, threads: usize, budget: &Budget) -> Result<(), Interrupt> {
        self.offsets = Offsets::of(&self.items, self.grid, threads, budget)?;
        Ok(())
    }

    /// The instance for placing one order: only the poses that stand in it, offsets when they are asked for.
    pub(crate) fn of_order(
        layout: &SectionLayout,
        order: &[PlacedSection],
        budget: &Budget,
    ) -> Result<Self, Interrupt> {
        let mut poses: Vec<Vec<Pose>> = vec![vec![]; layout.sections.len()];
        for placed in order {
            if !poses[placed.section].contains(&placed.pose) {
                poses[placed.section].push(placed.pose);
            }
        }
        Self::without_offsets(layout, &|section| poses[section].clone(), budget)
    }

    fn without_offsets(
        layout: &SectionLayout,
        poses: &dyn Fn(usize) -> Vec<Pose>,
        budget: &Budget,
    ) -> Result<Self, Interrupt> {
        let mut instance = Self {
            rule: layout.slide_rule,
            grid: Grid::for_lengths_up_to(0.0),
            gap: layout.gap_mm,
            kinds: vec![],
            items: vec![],
            first: None,
            last: None,
            precedences: vec![],
            before: rustc_hash::FxHashSet::default(),
            forbidden: rustc_hash::FxHashSet::default(),
            longest_reach: 0,
            copies: 0,
            kind_of_section: vec![],
            offsets: Offsets::computed(),
        };
        instance.gather(layout, poses, budget)?;
        let kind_of = |section: usize| instance.kind_of_section[section];
        instance.first = layout.first.map(kind_of);
        instance.last = layout.last.map(kind_of);
        instance.precedences = layout.precedences.iter().map(|&(a, b)| (kind_of(a), kind_of(b))).collect();
        instance.forbidden = layout.forbidden_joins.iter().map(|&(a, b)| (kind_of(a), kind_of(b))).collect();
        instance.before = transitive(&instance.precedences, instance.kinds.len(), budget)?;
        let longest =
            instance.items.iter().map(|item| item.profile.width).fold(0.0, f64::max) + layout.gap_mm;
        instance.grid = Grid::for_lengths_up_to(longest);
        let grid = instance.grid;
        for item in &mut instance.items {
            item.width = grid.down(item.profile.width);
            item.reach = grid.up(item.profile.width + layout.gap_mm);
        }
        instance.longest_reach = instance.items.iter().map(|item| item.reach).max().unwrap_or(0);
        Ok(instance)
    }

    fn gather(
        &mut self,
        layout: &SectionLayout,
        poses: &dyn Fn(usize) -> Vec<Pose>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let mut kinds: FxHashMap<Likeness, usize> = FxHashMap::default();
        for (number, section) in layout.sections.iter().enumerate() {
            budget.check(0)?;
            let fresh = self.kinds.len();
            let poses = poses(number);
            let kind = *kinds.entry(Likeness::of(layout, number, &poses)).or_insert(fresh);
            if kind == fresh {
                let silhouette = Silhouette::of(section, layout.gap_mm);
                let begin = self.items.len();
                self.items.extend(poses.iter().map(|&pose| Item {
                    kind,
                    pose,
                    profile: silhouette.profile(pose),
                    width: 0,
                    reach: 0,
                }));
                self.kinds.push(Kind { section: number, copies: vec![], items: begin..self.items.len() });
            }
            self.kinds[kind].copies.extend((0..section.quantity).map(|copy| (number, copy)));
            self.kind_of_section.push(kind);
            self.copies += section.quantity as usize;
        }
        Ok(())
    }

    /// How far apart left edges must be at least, the second item standing to the right; far below 0 when nothing is in
    /// the way. With kept order not below 0.
    #[inline]
    pub(crate) fn offset(&self, left: usize, right: usize) -> i64 {
        let offset = self.offsets.between(&self.items, self.grid, left, right);
        match self.rule {
            SlideRule::KeepOrder => offset.max(0),
            SlideRule::Free => offset,
        }
    }

    /// What an offset costs, in steps of some nanoseconds.
    #[inline]
    pub(crate) fn offset_steps(&self, left: usize, right: usize) -> usize {
        if self.offsets.are_kept() {
            return 1;
        }
        let pieces = |envelope: &crate::envelope::Envelope| envelope.pieces.len();
        let (left, right) = (&self.items[left].profile, &self.items[right].profile);
        4 * (1 + pieces(&left.grown_right) + pieces(&right.left))
    }

    /// Whether all offsets are at hand.
    pub(crate) fn has_all_offsets(&self) -> bool {
        self.offsets.are_kept()
    }

    /// Whether copies of the kinds may be neighbours in this order.
    #[inline]
    pub(crate) fn may_join(&self, left: usize, right: usize) -> bool {
        self.forbidden.is_empty() || !self.forbidden.contains(&(left, right))
    }

    /// Whether any join is forbidden.
    pub(crate) fn forbids_joins(&self) -> bool {
        !self.forbidden.is_empty()
    }

    /// Whether all copies of one kind come before all of the other.
    pub(crate) fn comes_before(&self, before: usize, after: usize) -> bool {
        self.before.contains(&(before, after))
    }

    /// All pairs of kinds of which one comes before the other.
    pub(crate) fn all_precedences(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.before.iter().copied()
    }

    /// The least offset of one kind behind another in any poses, less the left one's width: what a chain of sections
    /// counts. Holds for both slide rules in every layout no longer than `longest`: there the left one ends, and the right
    /// one begins, within that length, also where nothing is in the way.
    pub(crate) fn chain_cost(&self, left: usize, right: usize, longest: i64) -> i64 {
        let width = self.items[self.kinds[left].items.start].width;
        let pairs =
            self.kinds[left].items.clone().flat_map(|i| self.kinds[right].items.clone().map(move |j| (i, j)));
        let least = pairs.map(|(i, j)| self.offset(i, j)).min().unwrap_or(0);
        (least - width).max(-longest)
    }

    /// The least cost of one kind behind another in any poses, as a path of kinds counts it: what the offset leaves of
    /// the left one's width, 0 or less where joining saves something. Nothing where the join is forbidden. With the free
    /// rule as if order were kept: no bound then.
    pub(crate) fn kind_cost(&self, left: usize, right: usize) -> Option<i64> {
        if !self.may_join(left, right) {
            return None;
        }
        let width = self.items[self.kinds[left].items.start].width;
        let offset = |(i, j)| self.offset(i, j).max(0);
        let pairs =
            self.kinds[left].items.clone().flat_map(|i| self.kinds[right].items.clone().map(move |j| (i, j)));
        pairs.map(offset).min().map(|offset| offset - width)
    }

    /// No layout is longer than all reaches together.
    pub(crate) fn sum_of_reaches(&self) -> i64 {
        let boxes = |kind: &Kind| self.items[kind.items.start].reach * kind.copies.len() as i64;
        self.kinds.iter().map(boxes).sum()
    }

    /// How many copies a kind has.
    pub(crate) fn quantity(&self, kind: usize) -> usize {
        self.kinds[kind].copies.len()
    }

    /// Whether any kind has a pose to choose.
    pub(crate) fn has_choice_of_pose(&self) -> bool {
        self.items.len() > self.kinds.len()
    }

    /// How many sections the layout has.
    pub(crate) fn sections(&self) -> usize {
        self.kind_of_section.len()
    }

    /// The kind of a section.
    pub(crate) fn kind_of(&self, section: usize) -> usize {
        self.kind_of_section[section]
    }

    /// The item of a section in a pose; the kind's first when the pose is not allowed.
    pub(crate) fn item_of(&self, section: usize, pose: Pose) -> usize {
        let items = self.kinds[self.kind_of_section[section]].items.clone();
        let begin = items.start;
        items.into_iter().find(|&item| self.items[item].pose == pose).unwrap_or(begin)
    }

    /// Names copies: those of an item's kind in turn, from left to right.
    pub(crate) fn named(&self, sequence: &[usize], left_edges: &[i64]) -> Vec<PlacedSection> {
        let mut used = vec![0; self.kinds.len()];
        let name = |(&item, &x): (&usize, &i64)| {
            let Item { kind, pose, .. } = self.items[item];
            let (section, copy) = self.kinds[kind].copies[used[kind]];
            used[kind] += 1;
            PlacedSection { section, copy, pose, x_mm: self.grid.mm(x) }
        };
        sequence.iter().zip(left_edges).map(name).collect()
    }

    /// Whether the order of kinds is allowed.
    pub(crate) fn is_allowed(&self, kinds: &[usize]) -> bool {
        let ends = self.first.is_none_or(|first| kinds.first() == Some(&first))
            && self.last.is_none_or(|last| kinds.last() == Some(&last));
        let joins = kinds.windows(2).all(|pair| self.may_join(pair[0], pair[1]));
        ends && joins && self.keeps_precedence(kinds)
    }

    fn keeps_precedence(&self, kinds: &[usize]) -> bool {
        if self.precedences.is_empty() {
            return true;
        }
        let mut begin = vec![usize::MAX; self.kinds.len()];
        let mut end = vec![0; self.kinds.len()];
        for (at, &kind) in kinds.iter().enumerate() {
            begin[kind] = begin[kind].min(at);
            end[kind] = at;
        }
        self.precedences.iter().all(|&(before, after)| end[before] < begin[after])
    }
}

/// The offset of two profiles on the grid; far below 0 when nothing is in the way.
#[inline]
pub(crate) fn grid_offset(left: &Profile, right: &Profile, grid: Grid) -> i64 {
    meeting(&left.grown_right, &right.left).map_or(NOTHING_IN_THE_WAY, |meeting| grid.up(meeting.offset))
}

/// The offset of items that share no height: no sum with a left edge comes near 0.
pub(crate) const NOTHING_IN_THE_WAY: i64 = i64::MIN / 4;

/// A section's items when it stands alone, for calls that look at single joins.
pub(crate) fn profile_of(section: &Section, pose: Pose, gap: f64) -> Profile {
    Silhouette::of(section, gap).profile(pose)
}

/// Pairs, and all that follows from them. Cost: kinds that are named, times pairs.
fn transitive(
    pairs: &[(usize, usize)],
    kinds: usize,
    budget: &Budget,
) -> Result<rustc_hash::FxHashSet<(usize, usize)>, Interrupt> {
    let mut after = vec![vec![]; kinds];
    for &(before, later) in pairs {
        after[before].push(later);
    }
    let mut all = rustc_hash::FxHashSet::default();
    for kind in (0..kinds).filter(|&kind| !after[kind].is_empty()) {
        budget.check(0)?;
        let mut open = after[kind].clone();
        while let Some(later) = open.pop() {
            if all.insert((kind, later)) {
                open.extend(&after[later]);
            }
        }
    }
    Ok(all)
}
