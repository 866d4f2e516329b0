//! The shortest route in a scene that is new: by a search that meets barriers as it goes, and where its labels outgrow their
//! memory along links, as in a prepared scene.
//!
//! Round thousands of corners of one outline that see each other the first search opens a label for every pair of them; links
//! are only those tangents that nothing blocks, and each corner keeps its cheapest way alone. Preparing is slower where
//! few corners matter, so it comes last.

use super::PreparedScene;
use super::sights::LINKS_KEPT;
use crate::Stats;
use crate::barriers::{Barriers, WORK_AREA};
use crate::lowered::without;
use crate::search::{End, Route};
use crate::shortest_route::{MeetingBarriers, ShortestRoute};
use std::collections::BTreeSet;
use traverse_solve::{Budget, Interrupt, Observer};

/// The same route, its obstacles numbered as before others were left out.
fn with_owners(mut route: Route, there: &[usize]) -> Route {
    for stop in &mut route.stops {
        if stop.circle.owner != WORK_AREA {
            stop.circle.owner = there[stop.circle.owner];
        }
    }
    route
}

/// By a search that meets barriers as it goes, at last along links.
pub(crate) struct LinksAtLast;

impl ShortestRoute for LinksAtLast {
    fn shortest(
        &mut self,
        barriers: &Barriers<'_>,
        left_out: &BTreeSet<usize>,
        ends: [&End; 2],
        stats: &mut Stats,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> (Result<Option<Route>, Interrupt>, f64) {
        let (found, bound) = MeetingBarriers.shortest(barriers, left_out, ends, stats, budget, observer);
        if !matches!(found, Err(Interrupt::Memory)) {
            return (found, bound);
        }
        match PreparedScene::keeping(without(barriers.scene, left_out), LINKS_KEPT, budget) {
            Ok(mut prepared) => {
                let (found, further) = prepared.route_between(ends, budget, stats, observer);
                let there: Vec<usize> = barriers.owners().filter(|owner| !left_out.contains(owner)).collect();
                (found.map(|route| route.map(|route| with_owners(route, &there))), bound.max(further))
            }
            Err(interrupt) => (Err(interrupt), bound),
        }
    }
}
