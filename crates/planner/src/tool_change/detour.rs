//! The place on an edge at which the ways from a bend before it and to a bend after it are shortest together.
//!
//! Along a straight edge their sum is convex: where its slope changes sign is the place. Points on either side of the
//! edge meet in the straight crossing, points on the same side in the mirror point; with circles both have no closed form.
//! Along an arc of radius R each of the two curves down by at most 1 / R: parts of it are halved until the sum is known to
//! be convex there, to have no place at which its slope is 0, or to be as low as the bound that the curvature gives.
//! By axis speeds the sum is known in closed form ([`super::kinked`]).
//!
//! Cost: some 60 evaluations on a straight edge; an arc is halved as its turn comes.

use super::way::{Way, way};
use crate::measure::Measure;
use crate::search::{Bend, outside};
use traverse_geometry::{Arc, Edge, Point};

/// The sum is known to be lowest at a place when no other can be lower by more than this share of it.
pub(crate) const PLACE_RATIO: f64 = 1e-9;

/// Parts of arcs are not halved below this length, millimetres.
const SHORTEST_PART_MM: f64 = 1e-9;

/// Halvings of a straight edge: to the last bit.
const HALVINGS: usize = 64;

/// Both ways that meet in a place on an edge.
pub(crate) struct Detour<'a, M> {
    pub(crate) measure: M,
    pub(crate) before: &'a Bend,
    pub(crate) after: &'a Bend,
    pub(crate) edge: &'a Edge,
}

/// What is known of a part of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part {
    /// The sum is lowest in this place, or no other near it is lower, and costs this.
    Lowest(Point, f64),
    /// As far as it matters: this place, and no other costs less than this.
    Near(Point, f64),
    /// To be halved: nothing costs less than this.
    Open(f64),
}

/// The sum at a place: what it costs, and by how much it grows per millimetre.
struct Sum {
    cost: f64,
    slope: f64,
}

impl<M: Measure> Detour<'_, M> {
    pub(super) fn ways(&self, fraction: f64) -> Option<[Way; 2]> {
        let p = self.edge.point_at(fraction);
        Some([way(self.measure, self.before, p)?, way(self.measure, self.after, p)?])
    }

    fn sum(&self, fraction: f64) -> Option<Sum> {
        let [before, after] = self.ways(fraction)?;
        let slope = (before.gradient + after.gradient).dot(&self.edge.direction_at(fraction));
        Some(Sum { cost: before.cost + after.cost, slope })
    }

    /// No place on the edge costs less; cheap.
    pub(crate) fn bound(&self) -> f64 {
        let (a, b) = (self.before, self.after);
        let least = match self.edge {
            Edge::Segment(segment) if self.measure.kinks().is_none() => {
                // Mirrored onto the other side, the way is straight.
                let along = segment.vector();
                let side = |p: Point| traverse_geometry::cross(along, p - segment.start) / along.norm();
                let (one, other) = (side(a.center).abs(), side(b.center).abs());
                let along = (b.center - a.center).dot(&along) / along.norm();
                along.hypot(one + other)
            }
            _ => (b.center - a.center).norm(),
        };
        let radii = a.radius + b.radius;
        let by_length = self.measure.fastest((least - radii).max(0.0));
        let straight = self.measure.near(b.center - a.center, radii);
        let nearest = to_edge(self.measure, a, self.edge) + to_edge(self.measure, b, self.edge);
        a.cost + b.cost + by_length.max(straight).max(nearest)
    }

    /// What is known of the part between two fractions, on which both ways exist; nothing where no place inside can be the
    /// best.
    pub(crate) fn part(&self, from: f64, to: f64) -> Vec<Part> {
        // Away from where a way begins to exist.
        let inset = (to - from) * 1e-12;
        let (from, to) = (from + inset, to - inset);
        if self.measure.kinks().is_some() {
            return self.lowest_between_kinks(from, to);
        }
        self.smooth(from, to).into_iter().collect()
    }

    fn smooth(&self, from: f64, to: f64) -> Option<Part> {
        match self.edge {
            Edge::Segment(_) => self.lowest(from, to),
            Edge::Arc(arc) => {
                let middle = f64::midpoint(from, to);
                let half = (to - from) / 2.0 * arc.length();
                let sum = self.sum(middle)?;
                let curvature = self.curvature(middle, half, arc);
                if curvature.least > 0.0 {
                    return self.lowest(from, to);
                }
                if sum.slope.abs() > curvature.most * half {
                    // No slope of 0 inside; what is best at an end is found elsewhere.
                    return None;
                }
                let bound = sum.cost - sum.slope.abs() * half + curvature.least.min(0.0) * half * half / 2.0;
                if sum.cost - bound <= PLACE_RATIO * sum.cost || half < SHORTEST_PART_MM {
                    Some(Part::Near(self.edge.point_at(middle), bound))
                } else {
                    Some(Part::Open(bound))
                }
            }
        }
    }

    /// The lowest place of a part on which the sum is convex.
    fn lowest(&self, from: f64, to: f64) -> Option<Part> {
        let (mut low, mut high) = (from, to);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                break;
            }
            let sum = self.sum(middle)?;
            if sum.slope < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let cost = |fraction: f64| self.sum(fraction).map(|sum| (fraction, sum.cost));
        let ends = [low, high].into_iter().filter_map(cost).min_by(|a, b| a.1.total_cmp(&b.1));
        ends.map(|(at, cost)| Part::Lowest(self.edge.point_at(at), cost))
    }

    /// Bounds of the sum's second derivative within `half` millimetres of a place on an arc, by length.
    fn curvature(&self, middle: f64, half: f64, arc: &Arc) -> Curvature {
        let each = |bend: &Bend| self.curvature_of(bend, middle, half, arc);
        let (one, other) = (each(self.before), each(self.after));
        Curvature { least: one.least + other.least, most: one.most + other.most }
    }

    /// Those of one way's length: sin² over the length of the last tangent, less what the arc turns away.
    fn curvature_of(&self, bend: &Bend, middle: f64, half: f64, arc: &Arc) -> Curvature {
        let bent = 1.0 / arc.radius;
        let (p, along) = (self.edge.point_at(middle), self.edge.direction_at(middle));
        let outward = (p - arc.center) * bent;
        let unknown = Curvature { least: -bent, most: f64::INFINITY };
        let distance = (p - bend.center).norm();
        let root = |distance: f64| ((distance - bend.radius) * (distance + bend.radius)).max(0.0).sqrt();
        let (shortest, longest) = (root((distance - half).max(bend.radius)), root(distance + half));
        let Some(way) = way(self.measure, bend, p) else { return unknown };
        if shortest <= half {
            return unknown;
        }
        let turned = half / shortest + half * bent;
        let sine = (traverse_geometry::cross(along, way.direction).abs() - turned).max(0.0);
        let away = way.direction.dot(&outward) + turned;
        Curvature { least: (sine * sine / longest - away * bent).max(-bent), most: 1.0 / shortest + bent }
    }
}

/// Bounds of a second derivative, per millimetre: of its value and of its amount.
struct Curvature {
    least: f64,
    most: f64,
}

/// The way by `bend` to an edge costs at least this, beside what the way to the bend costs.
pub(super) fn to_edge(measure: impl Measure, bend: &Bend, edge: &Edge) -> f64 {
    let by_length = measure.fastest((edge.distance_to_point(bend.center) - bend.radius).max(0.0));
    by_length.max(measure.near(outside(&edge.bounds(), bend.center), bend.radius))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{AxisTime, Length};
    use crate::search::Turn;
    use rand::RngExt;
    use traverse_geometry::{AxisSpeeds, Segment};
    use traverse_solve::Seed;

    fn point_bend(x: f64, y: f64) -> Bend {
        Bend { center: Point::new(x, y), radius: 0.0, cost: 0.0, turn: None }
    }

    /// The best place of an edge, and the bound that is known of it.
    fn best(detour: &Detour<'_, impl Measure>) -> (f64, f64) {
        let mut open = vec![(0.0, 1.0)];
        let (mut cost, mut bound) = (f64::INFINITY, f64::INFINITY);
        while let Some((from, to)) = open.pop() {
            for part in detour.part(from, to) {
                match part {
                    Part::Lowest(p, least) | Part::Near(p, least) => {
                        let cost_by = |bend| way(detour.measure, bend, p).unwrap().cost;
                        let found = cost_by(detour.before) + cost_by(detour.after);
                        (cost, bound) = (cost.min(found), bound.min(least));
                    }
                    Part::Open(least) if least < cost * (1.0 - PLACE_RATIO) => {
                        let middle = f64::midpoint(from, to);
                        open.extend([(from, middle), (middle, to)]);
                    }
                    Part::Open(least) => bound = bound.min(least),
                }
            }
        }
        (cost, bound)
    }

    fn lowest_by_length(before: &Bend, after: &Bend, edge: &Edge) -> (Point, f64) {
        match (Detour { measure: Length, before, after, edge }).part(0.0, 1.0)[..] {
            [Part::Lowest(place, cost)] => (place, cost),
            ref other => panic!("{other:?}"),
        }
    }

    #[test]
    fn points_meet_in_the_mirror_point_or_cross_straight() {
        let edge = Edge::Segment(Segment::new(Point::new(-50.0, 0.0), Point::new(50.0, 0.0)));
        let (a, b) = (point_bend(0.0, 3.0), point_bend(8.0, 3.0));
        let (place, cost) = lowest_by_length(&a, &b, &edge);
        assert!(
            (place - Point::new(4.0, 0.0)).norm() < 1e-7 && (cost - 10.0).abs() < 1e-12,
            "{place} {cost}"
        );
        let c = point_bend(8.0, -3.0);
        let (_, cost) = lowest_by_length(&a, &c, &edge);
        assert!((cost - 10.0).abs() < 1e-12);
    }

    fn at(random: &mut impl RngExt) -> Point {
        Point::new(random.random_range(-15.0..15.0), random.random_range(-15.0..15.0))
    }

    /// Random bends and edges: nothing sampled is below the bound, and the bound is reached.
    #[test]
    fn nothing_sampled_is_below_the_bound() {
        compare_with_samples(|_| Length);
        compare_with_samples(|seed| {
            let y_mm_per_s = [1.0, 0.2, 3.0, 40.0][seed as usize % 4];
            AxisTime::new(&AxisSpeeds { x_mm_per_s: 1.0, y_mm_per_s, z_mm_per_s: 0.0 })
        });
    }

    fn compare_with_samples<M: Measure>(measure: impl Fn(u64) -> M) {
        let mut found = 0;
        for seed in 0..400 {
            let mut random = Seed(seed).stream();
            let mut bend = || {
                let center = Point::new(random.random_range(-20.0..20.0), random.random_range(-20.0..20.0));
                let radius = if random.random_range(0..3) == 0 { 0.0 } else { random.random_range(0.1..4.0) };
                let turn = (random.random_range(0..4) > 0).then(|| Turn {
                    sign: if random.random_range(0..2) == 0 { 1.0 } else { -1.0 },
                    arrival: random.random_range(-3.0..3.0),
                    most: random.random_range(0.5..5.0),
                });
                Bend { center, radius: if turn.is_some() { radius } else { 0.0 }, cost: 1.0, turn }
            };
            let (before, after) = (bend(), bend());
            let edge = if seed % 2 == 0 {
                Edge::Segment(Segment::new(at(&mut random), at(&mut random)))
            } else {
                let (start, sweep) = (random.random_range(-3.0..3.0), random.random_range(0.2..6.2));
                Edge::Arc(Arc::from_angles(at(&mut random), random.random_range(0.5..12.0), start, sweep))
            };
            let detour = Detour { measure: measure(seed), before: &before, after: &after, edge: &edge };
            let mut parts = [Vec::new(), Vec::new()];
            super::super::way::reached_parts(&before, &edge, &mut parts[0]);
            super::super::way::reached_parts(&after, &edge, &mut parts[1]);
            if parts != [vec![(0.0, 1.0)], vec![(0.0, 1.0)]] {
                continue;
            }
            let Some(lowest) = (0..=20_000)
                .map(|i| detour.sum(f64::from(i) / 20_000.0).map(|sum| sum.cost))
                .collect::<Option<Vec<f64>>>()
                .and_then(|all| all.into_iter().min_by(f64::total_cmp))
            else {
                continue;
            };
            assert!(detour.bound() <= lowest + 1e-9, "seed {seed}");
            let ends = [0.0, 1.0].map(|end| detour.sum(end).unwrap().cost);
            let (cost, bound) = best(&detour);
            let cost = cost.min(ends[0]).min(ends[1]);
            assert!(cost <= lowest + 1e-9 && cost > lowest - 1e-3, "seed {seed}: {cost} {lowest}");
            assert!(bound.min(cost) >= cost * (1.0 - 2.0 * PLACE_RATIO), "seed {seed}: {bound} {cost}");
            found += 1;
        }
        assert!(found > 60, "{found}");
    }

    #[test]
    fn a_circle_round_both_ends_costs_the_same_all_round() {
        let edge = Edge::Arc(Arc::from_angles(Point::new(1.0, 2.0), 5.0, 0.0, std::f64::consts::TAU));
        let (a, b) = (point_bend(1.0, 2.0), point_bend(1.0, 2.0));
        let (cost, bound) = best(&Detour { measure: Length, before: &a, after: &b, edge: &edge });
        assert!((cost - 10.0).abs() < 1e-9 && bound >= 10.0 * (1.0 - 2.0 * PLACE_RATIO), "{cost} {bound}");
    }
}
