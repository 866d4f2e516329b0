//! The route that a label adds up to.

use super::Ground;
use super::label::{Label, Place, Route, Step, Stop};
use super::stance::From;
use super::tree::Tree;

/// The way from the start to the label `last`.
pub(super) fn route(tree: &Tree<'_>, ground: &impl Ground, last: &Label) -> Route {
    let mut stops = Vec::new();
    let mut label = *last;
    while label.step != Step::Begin {
        let parent = &tree.stances[label.parent as usize];
        if let (Place::Feature(feature, side), From::Feature(departure)) = (parent.label.place, &parent.from)
        {
            let spoke_out = tree.leg(ground, &label).map_or_else(
                || departure.circle.direction_at(label.left_at),
                |leg| parent.from.spoke_along(&leg),
            );
            stops.push(Stop {
                circle: *ground.feature(feature),
                side,
                spoke_in: departure.spoke,
                spoke_out,
                turned: departure.turned(label.left_at, spoke_out),
            });
        }
        label = parent.label;
    }
    stops.reverse();
    Route { cost: last.cost, stops }
}
