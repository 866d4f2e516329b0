//! The best layout and the best bound so far, told to the observer in millimetres.

use crate::instance::Instance;
use traverse_solve::Observer;

/// The best layout and the best bound so far.
pub(crate) struct Progress<'a> {
    instance: &'a Instance,
    observer: &'a mut dyn Observer,
    best: Option<(Vec<usize>, i64)>,
    bound: i64,
    /// A bound that misses the length by no more than this proves it.
    coarseness: i64,
    iterations: u64,
    gap_limit: Option<f64>,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(
        instance: &'a Instance,
        gap_limit: Option<f64>,
        observer: &'a mut dyn Observer,
    ) -> Self {
        Self { instance, observer, best: None, bound: 0, coarseness: 0, iterations: 0, gap_limit }
    }

    /// The best sequence of items with its length.
    pub(crate) fn best(&self) -> Option<(&[usize], i64)> {
        self.best.as_ref().map(|(items, length)| (items.as_slice(), *length))
    }

    /// Its length; [`i64::MAX`] while there is none.
    pub(crate) fn upper(&self) -> i64 {
        self.best.as_ref().map_or(i64::MAX, |best| best.1)
    }

    pub(crate) fn bound(&self) -> i64 {
        self.bound
    }

    /// Takes over a sequence that is allowed, if it is shorter.
    pub(crate) fn offer(&mut self, items: &[usize], length: i64) {
        if length < self.upper() {
            self.best = Some((items.to_vec(), length));
            self.observer.better_cost(self.instance.grid.mm(length));
        }
    }

    /// No layout is shorter than this. That there is none is an ending and no bound.
    pub(crate) fn raise_bound(&mut self, bound: i64) {
        let bound = bound.min(self.upper());
        if bound > self.bound && bound < i64::MAX {
            self.bound = bound;
            self.observer.better_bound(self.instance.grid.mm(bound));
        }
    }

    /// Nothing shorter is left that a bound, up to what it may miss, does not exclude.
    pub(crate) fn raise_bound_to_what_is_reached(&mut self) {
        self.raise_bound(self.upper().saturating_sub(self.coarseness));
    }

    /// Bounds from here on may miss so many units because they count in a coarser one.
    pub(crate) fn count_coarsely(&mut self, coarseness: i64) {
        self.coarseness = coarseness;
    }

    /// Whether a bound, up to what it may miss, is as high as the best length.
    pub(crate) fn is_reached_by(&self, bound: i64) -> bool {
        bound.saturating_add(self.coarseness) >= self.upper()
    }

    /// Whether length and bound have met.
    pub(crate) fn is_proven(&self) -> bool {
        self.best.is_some() && self.is_reached_by(self.bound)
    }

    /// Whether length and bound have met, or come as near as was asked for.
    pub(crate) fn is_close_enough(&self) -> bool {
        let upper = self.upper();
        upper != i64::MAX
            && (self.is_proven()
                || self.gap_limit.is_some_and(|limit| (upper - self.bound) as f64 <= limit * upper as f64))
    }

    pub(crate) fn iterations(&self) -> u64 {
        self.iterations
    }

    pub(crate) fn add_iterations(&mut self, more: u64) {
        self.iterations = self.iterations.saturating_add(more);
    }
}

/// Hears bounds in units and tells them on as bounds of the layout; tours found on the way are no layouts yet.
pub(crate) struct BoundsOnly<'a, 'b> {
    pub(crate) progress: &'a mut Progress<'b>,
    /// Added to what is heard.
    pub(crate) plus: i64,
}

impl Observer for BoundsOnly<'_, '_> {
    fn better_cost(&mut self, _cost: f64) {}

    fn better_bound(&mut self, lower_bound: f64) {
        // Whole numbers of tours are exact as such.
        self.progress.raise_bound((lower_bound as i64).saturating_add(self.plus));
    }
}
