//! From a route of the search to moves: the planned ones, which are tested, and the answered ones.

use crate::drive::SHORTEST_ARC_MM;
use crate::search::Route;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Edge, Path, Point};

/// A straight move to an arc shorter than this is left out, millimetres: where two features share a circle, rounding alone lies
/// between their arcs, and its direction says nothing.
const SHORTEST_LINE_MM: f64 = 1e-9;

/// The path that a route answers with. Costs the route's cost, but for rounding.
pub(crate) fn trace(route: &Route, start: Point, target: Point) -> Path {
    let mut path = Path::at(start);
    for (i, stop) in route.stops.iter().enumerate() {
        let feature = &stop.circle;
        if feature.price_radius == 0.0 {
            path.line_to(feature.center);
            continue;
        }
        let [mut arrival, departure] =
            [stop.spoke_in, stop.spoke_out].map(|spoke| feature.center + spoke * feature.price_radius);
        if stop.turned == 0.0 {
            // It leaves where it arrives. From or to a point that nearly lies on the circle one direction is known badly, and
            // would lead there and back.
            let next = route.stops.get(i + 1);
            let next =
                next.map_or(target, |next| next.circle.center + next.spoke_in * next.circle.price_radius);
            let by = |place: Point| (place - path.end()).norm() + (next - place).norm();
            if by(departure) < by(arrival) {
                arrival = departure;
            }
        }
        if (arrival - path.end()).norm() > SHORTEST_LINE_MM {
            path.line_to(arrival);
        }
        if stop.turned * feature.price_radius > SHORTEST_ARC_MM {
            path.arc_to(departure, feature.center, stop.turned * stop.side.sign());
        }
    }
    path.line_to(target);
    path
}

/// Places along two paths at which they are compared.
const COMPARED_PLACES: usize = 64;

/// Whether two paths with the same ends run the same way, but for contact tolerances.
pub(crate) fn is_same_way(one: &Path, other: &Path) -> bool {
    let lengths = [one, other].map(Path::length);
    if (lengths[0] - lengths[1]).abs() > 2.0 * CONTACT_TOLERANCE_MM {
        return false;
    }
    let places = [one, other].map(places_along);
    places[0].iter().zip(&places[1]).all(|(a, b)| (a - b).norm() <= 4.0 * CONTACT_TOLERANCE_MM)
}

/// Places along a path, as far from each other as the next.
fn places_along(path: &Path) -> Vec<Point> {
    let step = path.length() / COMPARED_PLACES as f64;
    let mut places = Vec::with_capacity(COMPARED_PLACES);
    let mut passed = 0.0;
    for edge in path.edges() {
        let length = Edge::length(&edge);
        while places.len() < COMPARED_PLACES && (places.len() as f64 + 0.5) * step <= passed + length {
            let along = (places.len() as f64 + 0.5) * step - passed;
            places.push(edge.point_at(along / length));
        }
        passed += length;
    }
    places
}
