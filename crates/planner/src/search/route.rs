//! The route that a label adds up to.

use super::Search;
use super::label::{Place, Route, Step, Stop};

/// The way from the start to the label `last`.
pub(super) fn route(search: &Search<'_>, last: usize) -> Route {
    let mut stops = Vec::new();
    let mut index = last;
    loop {
        let label = &search.labels[index];
        let left = match label.step {
            Step::Begin => break,
            Step::Tangent { left_at } | Step::Over { left_at } => left_at,
        };
        let parent = &search.labels[label.parent];
        if let (Place::Feature { feature, side, .. }, Some(departure)) =
            (parent.place, search.departure(parent))
        {
            stops.push(Stop {
                feature,
                side,
                spoke_in: parent.spoke,
                spoke_out: label.left_spoke,
                turned: departure.turned(left, label.left_spoke),
            });
        }
        index = label.parent;
    }
    stops.reverse();
    Route { cost: search.labels[last].cost, stops }
}
