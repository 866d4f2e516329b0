//! Changes of a sequence: two neighbouring blocks change places, or one section takes another pose.

use crate::instance::Instance;
use crate::sequence::Span;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;

/// The longest block that is moved.
const LONGEST_BLOCK: usize = 3;
/// One move in so many exchanges blocks of any length.
const WIDE_EVERY: u32 = 8;
/// One move in so many changes a pose, where there is a choice.
const POSE_EVERY: u32 = 3;

/// A change of a sequence: the spans of the new one.
#[derive(Debug, Default)]
pub(crate) struct Change {
    pub(crate) spans: Vec<Span>,
}

impl Change {
    /// The blocks [i, j) and [j, k) change places; each may come in another pose when it is one section.
    fn exchange(&mut self, count: usize, i: usize, j: usize, k: usize) {
        self.spans.clear();
        self.spans.extend([Span::Old(0, i), Span::Old(j, k), Span::Old(i, j), Span::Old(k, count)]);
    }

    /// The section at `at` becomes another item.
    fn replace(&mut self, count: usize, at: usize, item: usize) {
        self.spans.clear();
        self.spans.extend([Span::Old(0, at), Span::New(item), Span::Old(at + 1, count)]);
    }

    /// Draws a change of `items`; false when what was drawn is none, or not allowed. `place` is where to begin,
    /// `beside` a position that might well come next to it.
    pub(crate) fn draw(
        &mut self,
        instance: &Instance,
        items: &[usize],
        place: usize,
        beside: Option<usize>,
        chance: &mut Xoshiro256PlusPlus,
    ) -> bool {
        let count = items.len();
        if instance.has_choice_of_pose() && chance.random_ratio(1, POSE_EVERY) {
            let kind = &instance.kinds[instance.items[items[place]].kind];
            let item = chance.random_range(kind.items.clone());
            self.replace(count, place, item);
            return item != items[place];
        }
        if count < 2 {
            return false;
        }
        let other = beside.unwrap_or_else(|| chance.random_range(0..count));
        let length = chance.random_range(1..=LONGEST_BLOCK);
        // What stands at `other` comes right behind what stands at `place`.
        let (i, j, k) = if other > place {
            let k = if chance.random_ratio(1, WIDE_EVERY) {
                chance.random_range(other + 1..=count)
            } else {
                (other + length).min(count)
            };
            (place + 1, other, k)
        } else {
            let j = if chance.random_ratio(1, WIDE_EVERY) {
                chance.random_range(other..=place)
            } else {
                (other + length).min(place)
            };
            (other, j, place + 1)
        };
        // To the front or the end comes what a neighbour can't ask for.
        let (i, j, k) = match chance.random_range(0..4 * count as u64) {
            0 => (0, place, (place + length).min(count)),
            1 => (place.saturating_sub(length), place, count),
            _ => (i, j, k),
        };
        if i >= j || j >= k {
            return false;
        }
        self.exchange(count, i, j, k);
        self.flip_some(instance, items, (i, j, k), chance);
        is_allowed(instance, items, i, j, k)
    }

    /// A moved section may turn on the way.
    fn flip_some(
        &mut self,
        instance: &Instance,
        items: &[usize],
        (i, j, k): (usize, usize, usize),
        chance: &mut Xoshiro256PlusPlus,
    ) {
        if !instance.has_choice_of_pose() {
            return;
        }
        for (span, from, to) in [(1, j, k), (2, i, j)] {
            if to - from == 1 && chance.random_bool(0.5) {
                let kind = &instance.kinds[instance.items[items[from]].kind];
                self.spans[span] = Span::New(chance.random_range(kind.items.clone()));
            }
        }
    }
}

/// Whether ends, forbidden joins and precedence permit that [i, j) and [j, k) change places.
fn is_allowed(instance: &Instance, items: &[usize], i: usize, j: usize, k: usize) -> bool {
    let kind = |at: usize| instance.items[items[at]].kind;
    if i == 0 && instance.first.is_some_and(|first| kind(j) != first) {
        return false;
    }
    if k == items.len() && instance.last.is_some_and(|last| kind(j - 1) != last) {
        return false;
    }
    if instance.forbids_joins() {
        let joins = [
            (i.checked_sub(1), Some(j)),
            (Some(k - 1), Some(i)),
            (Some(j - 1), (k < items.len()).then_some(k)),
        ];
        let kept = joins.iter().all(|&(left, right)| match (left, right) {
            (Some(left), Some(right)) => instance.may_join(kind(left), kind(right)),
            _ => true,
        });
        if !kept {
            return false;
        }
    }
    instance.precedences.is_empty()
        || (i..j).all(|early| (j..k).all(|late| !instance.comes_before(kind(early), kind(late))))
}
