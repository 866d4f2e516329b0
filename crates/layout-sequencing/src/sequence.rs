//! A sequence of items with their places, and what its length becomes when it is cut into spans and put together in
//! another way.
//!
//! With kept order places depend on what stands less than the longest reach before: once a span has been placed over
//! that distance with one and the same shift against its old places, the rest of it shifts alike. A trial therefore
//! costs some sections for each span, whatever their number. With the free rule everything from the first change on is
//! placed again.

use crate::instance::Instance;
use crate::pace::Pace;
use crate::placing::Placing;
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Interrupt};

/// A piece of a new sequence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Span {
    /// What stands from the first position up to before the second.
    Old(usize, usize),
    /// One item that takes the place of another.
    New(usize),
}

/// A sequence of items with their places.
#[derive(Debug)]
pub(crate) struct Sequence<'a> {
    instance: &'a Instance,
    items: Vec<usize>,
    placing: Placing,
    /// The furthest right end from each position on.
    end_from: Vec<i64>,
    /// What stands within reach of the next place in a trial.
    tail: Vec<(usize, i64)>,
    /// A trial's items, with the free rule.
    tried: Vec<usize>,
    /// Where a copy of each kind stands.
    position: Vec<usize>,
}

impl<'a> Sequence<'a> {
    pub(crate) fn new(instance: &'a Instance, items: Vec<usize>, budget: &Budget) -> Result<Self, Interrupt> {
        let placing = Placing::of(instance, &items, budget)?;
        let mut sequence = Self {
            instance,
            items,
            placing,
            end_from: vec![],
            tail: vec![],
            tried: vec![],
            position: vec![0; instance.kinds.len()],
        };
        sequence.sum_up(0);
        Ok(sequence)
    }

    pub(crate) fn left_edges(&self) -> &[i64] {
        &self.placing.x
    }

    pub(crate) fn items(&self) -> &[usize] {
        &self.items
    }

    pub(crate) fn length(&self) -> i64 {
        self.placing.length()
    }

    /// How far a section stands from where its neighbour alone would stop it.
    pub(crate) fn held_off(&self, at: usize) -> i64 {
        match at.checked_sub(1) {
            None => 0,
            Some(before) => {
                let offset = self.instance.offset(self.items[before], self.items[at]);
                self.placing.x[at] - self.placing.x[before] - offset.max(0)
            }
        }
    }

    /// The kind of what stands at a position.
    pub(crate) fn kind(&self, at: usize) -> usize {
        self.instance.items[self.items[at]].kind
    }

    /// Where a copy of the kind stands.
    pub(crate) fn some_position(&self, kind: usize) -> usize {
        self.position[kind]
    }

    fn sum_up(&mut self, kept: usize) {
        for (at, &item) in self.items.iter().enumerate().skip(kept) {
            self.position[self.instance.items[item].kind] = at;
        }
        self.end_from.clear();
        let mut end = 0;
        for (&item, &x) in self.items.iter().zip(&self.placing.x).rev() {
            end = end.max(x + self.instance.items[item].width);
            self.end_from.push(end);
        }
        self.end_from.reverse();
    }

    /// The length that the spans together would have. They hold every position once.
    pub(crate) fn length_of(&mut self, spans: &[Span], pace: &mut Pace) -> Result<i64, Interrupt> {
        match self.instance.rule {
            SlideRule::KeepOrder => self.kept_order_length(spans, pace),
            SlideRule::Free => {
                let kept = self.materialise(spans);
                let mut placing = self.placing.beginning(kept);
                for at in kept..self.tried.len() {
                    placing.push(self.instance, &self.tried, at, pace)?;
                }
                Ok(placing.length())
            }
        }
    }

    fn kept_order_length(&mut self, spans: &[Span], pace: &mut Pace) -> Result<i64, Interrupt> {
        let longest = self.instance.longest_reach;
        let mut tail = std::mem::take(&mut self.tail);
        tail.clear();
        let (mut x, mut end) = (0, 0);
        for (number, &span) in spans.iter().enumerate() {
            match span {
                Span::New(item) => {
                    x = self.next_place(&tail, item, x, pace)?;
                    end = end.max(x + self.instance.items[item].width);
                    tail.push((item, x));
                }
                Span::Old(from, to) => {
                    if from == to {
                        continue;
                    }
                    // The shift of the last sections, and where the first of them stood.
                    let mut steady = (number == 0 && from == 0).then_some((0, i64::MIN / 2));
                    let mut at = from;
                    while at < to {
                        if let Some((shift, since)) = steady
                            && (at == from || self.placing.x[at - 1] - since >= longest)
                        {
                            self.skip(&mut tail, to, shift);
                            x = self.placing.x[to - 1] + shift;
                            // What lies further back than the tail ends before the last left edge.
                            end = tail
                                .iter()
                                .fold(end, |end, &(item, x)| end.max(x + self.instance.items[item].width));
                            if to == self.items.len() {
                                end = end.max(self.end_from[at] + shift);
                            }
                            break;
                        }
                        let item = self.items[at];
                        x = self.next_place(&tail, item, x, pace)?;
                        end = end.max(x + self.instance.items[item].width);
                        tail.push((item, x));
                        let shift = x - self.placing.x[at];
                        if steady.is_none_or(|(before, _)| before != shift) {
                            steady = Some((shift, self.placing.x[at]));
                        }
                        at += 1;
                    }
                }
            }
        }
        self.tail = tail;
        Ok(end)
    }

    /// The tail after the position `to`, everything before it shifted alike.
    fn skip(&self, tail: &mut Vec<(usize, i64)>, to: usize, shift: i64) {
        tail.clear();
        let last = self.placing.x[to - 1];
        for at in (0..to).rev() {
            if self.placing.x[at] + self.instance.longest_reach <= last {
                break;
            }
            tail.push((self.items[at], self.placing.x[at] + shift));
        }
        tail.reverse();
    }

    fn next_place(
        &self,
        tail: &[(usize, i64)],
        item: usize,
        before: i64,
        pace: &mut Pace,
    ) -> Result<i64, Interrupt> {
        let mut x = before;
        let mut passed = 0;
        for &(earlier, place) in tail.iter().rev() {
            if place + self.instance.longest_reach <= x {
                break;
            }
            passed += 1;
            if place + self.instance.items[earlier].reach > x {
                pace.spend(self.instance.offset_steps(earlier, item))?;
                x = x.max(place + self.instance.offset(earlier, item));
            }
        }
        pace.spend(passed)?;
        Ok(x)
    }

    /// Puts the spans together for good. Interrupted, the sequence is of no more use.
    pub(crate) fn apply(&mut self, spans: &[Span], pace: &mut Pace) -> Result<(), Interrupt> {
        let kept = self.materialise(spans);
        std::mem::swap(&mut self.items, &mut self.tried);
        if self.instance.rule == SlideRule::Free {
            self.placing.truncate(kept);
            for at in kept..self.items.len() {
                self.placing.push(self.instance, &self.items, at, pace)?;
            }
        } else {
            let before = self.placing.x.clone();
            self.placing.truncate(kept);
            for &span in spans {
                match span {
                    Span::New(_) => {
                        self.placing.push(self.instance, &self.items, self.placing.x.len(), pace)?;
                    }
                    // What stands as it was at the beginning is placed.
                    Span::Old(0, to) if to == kept => {}
                    Span::Old(from, to) => self.place_span(&before, from, to, pace)?,
                }
            }
        }
        self.sum_up(kept);
        Ok(())
    }

    /// Places a span of the sequence before: what shifts alike is not held against its neighbours again.
    fn place_span(
        &mut self,
        before: &[i64],
        from: usize,
        to: usize,
        pace: &mut Pace,
    ) -> Result<(), Interrupt> {
        let mut steady: Option<(i64, i64)> = None;
        for at in from..to {
            let number = self.placing.x.len();
            if let Some((shift, since)) = steady
                && before[at - 1] - since >= self.instance.longest_reach
            {
                self.placing.push_at(self.instance, self.items[number], before[at] + shift);
                continue;
            }
            self.placing.push(self.instance, &self.items, number, pace)?;
            let shift = self.placing.x[number] - before[at];
            if steady.is_none_or(|(known, _)| known != shift) {
                steady = Some((shift, before[at]));
            }
        }
        Ok(())
    }

    /// Writes the new sequence into `tried`; how many items at its beginning are as they were.
    fn materialise(&mut self, spans: &[Span]) -> usize {
        self.tried.clear();
        for &span in spans {
            match span {
                Span::Old(from, to) => self.tried.extend_from_slice(&self.items[from..to]),
                Span::New(item) => self.tried.push(item),
            }
        }
        match spans.first() {
            Some(&Span::Old(0, to)) => to,
            _ => 0,
        }
    }
}
