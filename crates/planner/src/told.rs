//! What a search's bounds mean for the whole move.

use crate::price::of_search;
use traverse_geometry::TravelCost;
use traverse_solve::Observer;

/// Hears a search's bounds and passes them on as the whole move's.
pub(crate) struct Told<'a> {
    pub(crate) observer: &'a mut dyn Observer,
    pub(crate) cost: TravelCost,
    /// What the whole costs beside the search's part.
    pub(crate) by: f64,
    /// The best bound so far.
    pub(crate) most: f64,
}

impl Observer for Told<'_> {
    fn better_cost(&mut self, _cost: f64) {}

    fn better_bound(&mut self, lower_bound: f64) {
        let bound = of_search(lower_bound, &self.cost) + self.by;
        if bound > self.most {
            self.most = bound;
            self.observer.better_bound(bound);
        }
    }
}
