//! How the shortest route between two ends is found: a plan asks, one search or another answers.

use crate::Stats;
use crate::barriers::Barriers;
use crate::search::{End, Known, Route, Search};
use std::collections::BTreeSet;
use traverse_solve::{Budget, Interrupt, Observer};

/// How the shortest route between two ends is found.
pub(crate) trait ShortestRoute {
    /// The shortest route where the barriers of `left_out` are not there, if there is any, and a cost that no route is
    /// below.
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        left_out: &BTreeSet<usize>,
        ends: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64);
}

/// By a search that meets barriers as it goes, and no further where its labels outgrow their memory.
pub(crate) struct MeetingBarriers;

impl ShortestRoute for MeetingBarriers {
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        left_out: &BTreeSet<usize>,
        [start, target]: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64) {
        let mut search = Search::new(Known::new(barriers, left_out), start, target);
        let found = search.run(budget, &mut stats.expanded_nodes, observer);
        stats.barrier_vertices = stats.barrier_vertices.max(search.known.features.len() as u64);
        (found, search.lower_bound)
    }
}
