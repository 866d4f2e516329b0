//! From a route of the search to moves: the planned ones, which are tested, and the answered ones.

use crate::drive::SHORTEST_ARC_MM;
use crate::search::Route;
use traverse_geometry::{Path, Point};

/// The path that a route answers with. Costs the route's cost, but for rounding.
pub(crate) fn trace(route: &Route, start: Point, target: Point) -> Path {
    let mut path = Path::at(start);
    for stop in &route.stops {
        let feature = &stop.circle;
        if feature.price_radius == 0.0 {
            path.line_to(feature.center);
            continue;
        }
        let arrival = feature.center + stop.spoke_in * feature.price_radius;
        path.line_to(arrival);
        if stop.turned * feature.price_radius > SHORTEST_ARC_MM {
            let departure = feature.center + stop.spoke_out * feature.price_radius;
            path.arc_to(departure, feature.center, stop.turned * stop.side.sign());
        }
    }
    path.line_to(target);
    path
}
