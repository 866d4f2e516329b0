//! Where sections come to stand: each as far left as those before it let it.
//!
//! x_k is the largest of x_m + offset(m, k) over all earlier m, not only the neighbour: where the one between leaves a
//! height uncovered, the one before it may be in the way. With kept order no section passes the left edge of the one
//! before it. Sections that end further left than the place found are not held against it: behind one long section every
//! later one passes all before it, at a comparison each.

use crate::instance::Instance;
use crate::pace::Pace;
use traverse_geometry::SlideRule;
use traverse_solve::{Budget, Interrupt};

/// Sections in their places.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Placing {
    /// Left edges.
    pub(crate) x: Vec<i64>,
    /// The furthest that this item can touch.
    own_reach: Vec<i64>,
    /// The furthest that this item or any before it can touch.
    reach: Vec<i64>,
    /// The furthest right end so far, widths rounded down.
    pub(crate) end: Vec<i64>,
}

impl Placing {
    /// Every item of a sequence in its place.
    ///
    /// # Errors
    /// When the time of the budget ends first: at worst every pair is looked at.
    pub(crate) fn of(instance: &Instance, sequence: &[usize], budget: &Budget) -> Result<Self, Interrupt> {
        let mut placing = Self::default();
        let mut pace = Pace::of(budget);
        for at in 0..sequence.len() {
            placing.push(instance, sequence, at, &mut pace)?;
        }
        Ok(placing)
    }

    /// The first items of another placing.
    pub(crate) fn beginning(&self, count: usize) -> Self {
        Self {
            x: self.x[..count].to_vec(),
            own_reach: self.own_reach[..count].to_vec(),
            reach: self.reach[..count].to_vec(),
            end: self.end[..count].to_vec(),
        }
    }

    /// The item at `at` in its place, all before it being in theirs.
    #[inline]
    pub(crate) fn push(
        &mut self,
        instance: &Instance,
        sequence: &[usize],
        at: usize,
        pace: &mut Pace,
    ) -> Result<(), Interrupt> {
        let item = sequence[at];
        let mut x = match instance.rule {
            SlideRule::KeepOrder => self.x.last().copied().unwrap_or(0),
            SlideRule::Free => 0,
        };
        let mut passed = 0;
        for earlier in (0..at).rev() {
            if self.reach[earlier] <= x {
                break;
            }
            passed += 1;
            if self.own_reach[earlier] > x {
                pace.spend(instance.offset_steps(sequence[earlier], item))?;
                x = x.max(self.x[earlier] + instance.offset(sequence[earlier], item));
            }
        }
        pace.spend(passed)?;
        self.push_at(instance, item, x);
        Ok(())
    }

    /// The item at a place that is known.
    #[inline]
    pub(crate) fn push_at(&mut self, instance: &Instance, item: usize, x: i64) {
        let item = &instance.items[item];
        let reach = x + item.reach;
        self.own_reach.push(reach);
        self.reach.push(self.reach.last().copied().unwrap_or(0).max(reach));
        self.end.push(self.end.last().copied().unwrap_or(0).max(x + item.width));
        self.x.push(x);
    }

    /// The places before `at` only.
    pub(crate) fn truncate(&mut self, at: usize) {
        self.x.truncate(at);
        self.own_reach.truncate(at);
        self.reach.truncate(at);
        self.end.truncate(at);
    }

    /// The furthest right end.
    pub(crate) fn length(&self) -> i64 {
        self.end.last().copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section, SectionLayout};

    /// A long low section, and behind it short ones at other heights, each second one below the one before.
    fn behind_a_long_one(count: usize, slide_rule: SlideRule) -> SectionLayout {
        let block = |number: usize, width: f64, low: f64, high: f64| {
            let ring = Ring::from_xy(&[0.0, low, width, low, width - 1.0, high, 0.0, high], &[]);
            let part = Part {
                id: "p".into(),
                shape: Polygon::from_ring(ring.expect("valid")),
                pole: Point::origin(),
                rotation_rad: 0.0,
                mirrored: false,
            };
            Section { id: number.to_string(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
        };
        let short = |number: usize| {
            let low = 10.0 * (number % 2) as f64;
            block(number, 5.0 + (number % 7) as f64, low, low + 9.0 + (number % 3) as f64)
        };
        let long = block(0, 100.0 * count as f64, -9.0, -1.0);
        SectionLayout {
            sections: std::iter::once(long).chain((1..count).map(short)).collect(),
            gap_mm: 0.5,
            strip_height_mm: None,
            first: None,
            last: None,
            precedences: vec![],
            forbidden_joins: vec![],
            slide_rule,
        }
    }

    #[test]
    fn what_ends_further_left_is_in_nobodys_way() {
        for rule in [SlideRule::KeepOrder, SlideRule::Free] {
            let layout = behind_a_long_one(60, rule);
            let budget = Budget::unlimited();
            let instance = Instance::of(&layout, 1, &budget).expect("no limit");
            let sequence: Vec<usize> = (0..60).map(|section| instance.item_of(section, Pose::AsIs)).collect();
            let placing = Placing::of(&instance, &sequence, &budget).expect("no limit");
            let mut x: Vec<i64> = vec![];
            for item in 0..60 {
                let least = if rule == SlideRule::KeepOrder { x.last().copied().unwrap_or(0) } else { 0 };
                let held = (0..item).map(|at| x[at] + instance.offset(sequence[at], sequence[item]));
                x.push(held.fold(least, i64::max));
            }
            assert_eq!(placing.x, x, "{rule:?}");
        }
    }

    #[test]
    fn a_cancel_ends_placing() {
        let layout = behind_a_long_one(4, SlideRule::Free);
        let budget = Budget::unlimited();
        let instance = Instance::of_envelopes(&layout, &budget).expect("no limit");
        budget.cancel.cancel();
        assert_eq!(Placing::of(&instance, &[0, 1, 2, 3], &budget), Err(Interrupt::Cancelled));
    }
}
