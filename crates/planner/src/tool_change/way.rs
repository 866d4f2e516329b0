//! The way from a bend to a place: what it costs as a function of the place.
//!
//! Where the place moves, the way leaves its circle later or sooner: what the circle costs more its last tangent costs less. So
//! the cost grows as that of the last tangent does, from where it begins: by length along the way's last direction, which is
//! the gradient. Across it, it curves with the measure's own curvature over the length of the last tangent. So it is convex along
//! every straight line, by every norm.

use crate::measure::Measure;
use crate::search::{Bend, Tangent};
use crate::way_out::{crossings, crossings_with_ray};
use std::f64::consts::{PI, TAU};
use traverse_geometry::{Arc, Edge, Point, Vector, left_of, unit};

/// Ways that would turn back by less than this are looked at all the same, radians: what is planned and what is answered
/// differ by a contact tolerance. Whether a way exists is decided when it is tested.
const SLACK_RAD: f64 = 1e-3;

/// The way to a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    /// What it costs.
    pub(crate) cost: f64,
    /// The direction in which it gets there; zero for a way of no length.
    pub(crate) direction: Vector,
    /// How the cost grows with the place, per millimetre: by length the direction.
    pub(crate) gradient: Vector,
}

/// How far ways may turn back, radians.
fn slack(most: f64) -> f64 {
    SLACK_RAD.min((TAU - most) / 2.0).max(0.0)
}

/// The way from `bend` to `p`, whether or not it would have to turn back; none from inside the circle.
pub(crate) fn way(measure: impl Measure, bend: &Bend, p: Point) -> Option<Way> {
    // The turn on a circle of no radius costs nothing.
    let Some(turn) = bend.turn.as_ref().filter(|_| bend.radius > 0.0) else {
        let by = p - bend.center;
        let direction = by.try_normalize(0.0).unwrap_or_default();
        let cost = bend.cost + measure.along(by);
        return Some(Way { cost, direction, gradient: measure.gradient(direction) });
    };
    let tangent = Tangent::between(bend.center, bend.radius * turn.sign, p, 0.0)?;
    let turned = turned(bend, -tangent.normal * turn.sign)?;
    // What a turn back would cost is taken off, so that the cost goes on smoothly.
    let arc = measure.arc(bend.radius, turn.arrival, turned * turn.sign) * turned.signum();
    let direction = Vector::new(tangent.normal.y, -tangent.normal.x);
    Some(Way {
        cost: bend.cost + arc + measure.straight(tangent.normal, tangent.length),
        direction,
        gradient: measure.gradient(direction),
    })
}

/// How far a way turns on the circle that leaves it where `spoke` points, radians: beyond its range on either side by as
/// little as possible.
fn turned(bend: &Bend, spoke: Vector) -> Option<f64> {
    let turn = bend.turn.as_ref()?;
    let by = turn.sign * (spoke.y.atan2(spoke.x) - turn.arrival);
    let first = turn.most / 2.0 - PI;
    Some((by - first).rem_euclid(TAU) + first)
}

/// Whether a way of `bend` leads to `p` without turning back.
fn leads_to(bend: &Bend, p: Point) -> bool {
    let Some(turn) = &bend.turn else { return true };
    let Some(tangent) = Tangent::between(bend.center, bend.radius * turn.sign, p, 0.0) else {
        // The bend's own place.
        return bend.radius == 0.0;
    };
    let slack = slack(turn.most);
    turned(bend, -tangent.normal * turn.sign)
        .is_some_and(|turned| turned >= -slack && turned <= turn.most + slack)
}

/// Adds the parts of `edge`, from fraction to fraction, that ways of `bend` lead to.
pub(crate) fn reached_parts(bend: &Bend, edge: &Edge, parts: &mut Vec<(f64, f64)>) {
    let Some(turn) = &bend.turn else {
        parts.push((0.0, 1.0));
        return;
    };
    let mut cuts = vec![0.0, 1.0];
    let mut add = |p: Point| {
        let fraction = fraction_of(edge, p);
        if fraction > 0.0 && fraction < 1.0 {
            cuts.push(fraction);
        }
    };
    let slack = slack(turn.most);
    let mut ways = Vec::new();
    for by in [-slack, turn.most + slack] {
        let spoke = unit(turn.arrival + turn.sign * by);
        let (from, direction) = (bend.center + spoke * bend.radius, left_of(spoke) * turn.sign);
        ways.clear();
        crossings_with_ray(edge, from, direction, &mut ways);
        ways.iter().for_each(|way| add(from + direction * *way));
    }
    if bend.radius > 0.0 {
        let mut found = Vec::new();
        let circle = Edge::Arc(Arc::from_angles(bend.center, bend.radius, 0.0, TAU));
        crossings(edge, &circle, &mut found);
        found.into_iter().for_each(&mut add);
    }
    cuts.sort_by(f64::total_cmp);
    for pair in cuts.windows(2) {
        if pair[1] > pair[0] && leads_to(bend, edge.point_at(f64::midpoint(pair[0], pair[1]))) {
            match parts.last_mut() {
                Some(last) if last.1 == pair[0] => last.1 = pair[1],
                _ => parts.push((pair[0], pair[1])),
            }
        }
    }
}

/// Adds where ways of `bend` cross `edge`, as fractions, that leave where its turn begins or ends, or in a direction at which
/// the cost of ways has a kink.
pub(crate) fn kinks_on(measure: impl Measure, bend: &Bend, edge: &Edge, cuts: &mut Vec<f64>) {
    let mut ways = Vec::new();
    let mut add = |spoke: Vector, sign: f64| {
        let (from, direction) = (bend.center + spoke * bend.radius, left_of(spoke) * sign);
        ways.clear();
        crossings_with_ray(edge, from, direction, &mut ways);
        cuts.extend(ways.iter().map(|way| fraction_of(edge, from + direction * *way)));
    };
    let sign = bend.turn.as_ref().map_or(1.0, |turn| turn.sign);
    measure.kinks().into_iter().flatten().for_each(|outward| add(unit(outward), sign));
    if let Some(turn) = &bend.turn {
        [0.0, turn.most].into_iter().for_each(|by| add(unit(turn.arrival + turn.sign * by), sign));
    }
}

/// The fraction of an edge, or of the line or circle that it lies on, at which `p` is.
pub(crate) fn fraction_of(edge: &Edge, p: Point) -> f64 {
    match edge {
        Edge::Segment(segment) => {
            let along = segment.vector();
            (p - segment.start).dot(&along) / along.norm_squared()
        }
        Edge::Arc(arc) => {
            let spoke = p - arc.center;
            let by = (spoke.y.atan2(spoke.x) - arc.start_angle) * arc.sweep.signum();
            by.rem_euclid(TAU) / arc.sweep.abs()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{AxisTime, Length};
    use crate::search::Turn;
    use traverse_geometry::{AxisSpeeds, Segment};

    fn bend(sign: f64, most: f64) -> Bend {
        let turn = Some(Turn { sign, arrival: 0.0, most });
        Bend { center: Point::new(0.0, 0.0), radius: 2.0, cost: 5.0, turn }
    }

    #[test]
    fn a_way_turns_and_goes_straight() {
        // Round the left of the circle by a quarter, then up to the left.
        let found = way(Length, &bend(1.0, PI), Point::new(-7.0, 2.0)).unwrap();
        assert!((found.cost - (5.0 + PI + 7.0)).abs() < 1e-12, "{found:?}");
        assert!((found.direction - Vector::new(-1.0, 0.0)).norm() < 1e-12);
        assert!(way(Length, &bend(1.0, PI), Point::new(1.0, 0.0)).is_none());
    }

    /// The cost grows as its gradient says, and only where ways lead.
    #[test]
    fn costs_follow_their_gradients_on_what_is_reached() {
        costs_follow_their_gradients(Length);
        for (x_mm_per_s, y_mm_per_s) in [(1.0, 1.0), (3.0, 0.7)] {
            costs_follow_their_gradients(AxisTime::new(&AxisSpeeds {
                x_mm_per_s,
                y_mm_per_s,
                z_mm_per_s: 0.0,
            }));
        }
    }

    fn costs_follow_their_gradients(measure: impl Measure) {
        for sign in [1.0, -1.0] {
            for most in [0.5, 2.0, 4.0, TAU] {
                let bend = bend(sign, most);
                for edge in [
                    Edge::Segment(Segment::new(Point::new(-9.0, -7.0), Point::new(4.0, 9.0))),
                    Edge::Segment(Segment::new(Point::new(-9.0, 1.0), Point::new(9.0, 1.5))),
                    Edge::Arc(Arc::from_angles(Point::new(1.0, 0.5), 5.0, 0.3, -5.0)),
                ] {
                    let mut parts = Vec::new();
                    reached_parts(&bend, &edge, &mut parts);
                    let mut kinks = Vec::new();
                    kinks_on(measure, &bend, &edge, &mut kinks);
                    for step in 1..200 {
                        let at = f64::from(step) / 200.0;
                        let is_in = parts.iter().any(|part| part.0 <= at && at <= part.1);
                        assert_eq!(is_in, leads_to(&bend, edge.point_at(at)), "{sign} {most} {at}");
                        if !parts.iter().any(|part| part.0 + 1e-5 <= at && at <= part.1 - 1e-5) {
                            continue;
                        }
                        if kinks.iter().any(|kink| (kink - at).abs() < 1e-5) {
                            continue;
                        }
                        let h = 1e-6;
                        let cost = |at: f64| way(measure, &bend, edge.point_at(at)).unwrap().cost;
                        let slope = (cost(at + h) - cost(at - h)) / (2.0 * h * edge.length());
                        let gradient = way(measure, &bend, edge.point_at(at)).unwrap().gradient;
                        let said = gradient.dot(&edge.direction_at(at));
                        assert!((slope - said).abs() < 1e-4, "{sign} {most} {at}: {slope} {said}");
                    }
                }
            }
        }
    }
}
