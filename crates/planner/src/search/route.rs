//! The route that a label adds up to.

use super::Ground;
use super::label::{Label, Place, Route, Step, Stop};
use super::stance::From;
use super::tree::Tree;
use crate::measure::Measure;

/// The way from the start to the label `last`.
pub(super) fn route(tree: &Tree<'_, impl Measure>, ground: &impl Ground, last: &Label) -> Route {
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
    let start = match label.place {
        Place::Start(place) => tree.start.places[place as usize],
        _ => tree.start.point,
    };
    let target = match last.place {
        Place::Target(place) => tree.target.places[place as usize],
        _ => tree.target.point,
    };
    Route { cost: last.cost, stops, places: [start, target] }
}
