//! A search tree that grows from one end in all directions, as far as it is asked to: shortest ways to places that are
//! not known beforehand.
//!
//! It grows best first by what a path costs at least that goes on to one of some boxes and from there to another end.
//! Barriers are met as in [`Search`], whose tree it is. Cost: as of a search that expands the same labels.

use super::label::{Label, Place};
use super::shortest::{LABEL_LIMIT, Search};
use super::stance::From;
use super::{End, Known, Way};
use crate::measure::{Length, Measure};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use traverse_geometry::{Bounds, Point, Vector};
use traverse_solve::{Budget, Interrupt};

/// Where the ways of a fan lead: through one of some boxes to a point.
#[derive(Clone, Debug)]
pub(crate) struct Aim {
    /// Each box, and what the way from it to the point costs at least.
    boxes: Vec<(Bounds, f64)>,
}

impl Aim {
    /// Through one of `boxes` to `beyond`.
    pub(crate) fn new(measure: impl Measure, boxes: impl IntoIterator<Item = Bounds>, beyond: Point) -> Self {
        let rest = |bounds| (bounds, measure.along(outside(&bounds, beyond)));
        Self { boxes: boxes.into_iter().map(rest).collect() }
    }

    /// No way from within `radius` of `p` through a box to the point costs less.
    fn rest(&self, measure: impl Measure, p: Point, radius: f64) -> f64 {
        let through = |(bounds, rest): &(Bounds, f64)| measure.near(outside(bounds, p), radius) + rest;
        self.boxes.iter().map(through).fold(f64::INFINITY, f64::min)
    }
}

/// How far `p` lies outside of a box along each axis.
pub(crate) fn outside(bounds: &Bounds, p: Point) -> Vector {
    (bounds.min - p).sup(&(p - bounds.max)).sup(&Vector::zeros())
}

/// Where the ways of a fan leave for places that see it: the end itself, or a circle that they bend round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend {
    /// Centre of the circle; the end itself, where there is none.
    pub(crate) center: Point,
    /// Radius of the answered path round it, millimetres; 0 for the end.
    pub(crate) radius: f64,
    /// What the way to the arrival costs.
    pub(crate) cost: f64,
    /// How ways turn on the circle; none at the end itself.
    pub(crate) turn: Option<Turn>,
}

/// How ways turn on a circle before they leave it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// +1 counter-clockwise, −1 clockwise.
    pub(crate) sign: f64,
    /// Outward direction of arrival, radians.
    pub(crate) arrival: f64,
    /// How far they may turn, radians.
    pub(crate) most: f64,
}

/// A fan under way.
pub(crate) struct Fan<'a, M = Length> {
    pub(super) search: Search<'a, M>,
    aim: Aim,
    labels: Vec<Label>,
    /// Open labels by what a path through them costs at least.
    open: BinaryHeap<(Reverse<u64>, u32)>,
}

impl<'a, M: Measure> Fan<'a, M> {
    /// A fan from `start`. `beyond` is where the ways lead in the end; it has no places.
    pub(crate) fn new(measure: M, known: Known<'a>, start: &'a End, beyond: &'a End, aim: Aim) -> Self {
        debug_assert!(beyond.places.is_empty(), "a fan has no target");
        let search = Search::by(measure, known, start, beyond);
        Self { search, aim, labels: Vec::new(), open: BinaryHeap::new() }
    }

    /// What a path through an open label costs at least; none when everything that can be reached was.
    pub(crate) fn lowest(&mut self) -> Option<f64> {
        loop {
            let best = self.open.peek().map(|(Reverse(bits), _)| f64::from_bits(*bits));
            match self.search.tree.lowest_estimate() {
                Some(estimate) if best.is_none_or(|best| estimate <= best) => {
                    let (estimate, label) = self.search.tree.pop()?;
                    let estimate = estimate.max(label.cost + self.rest(&label));
                    self.open.push((Reverse(estimate.to_bits()), self.labels.len() as u32));
                    self.labels.push(label);
                }
                _ => return best,
            }
        }
    }

    fn rest(&self, label: &Label) -> f64 {
        match label.place {
            Place::Feature(feature, _) => {
                let circle = &self.search.known.features[feature as usize];
                // A hair less, so that rounding takes none away.
                self.aim.rest(self.search.tree.measure, circle.center, circle.plan_radius) * (1.0 - 1e-12)
            }
            Place::Start(_) | Place::Target(_) => 0.0,
        }
    }

    /// Looks into the open label of the lowest estimate; answers the stance that came of it, if any.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn grow(&mut self, budget: &Budget, steps: &mut u64) -> Result<Option<u32>, Interrupt> {
        if self.lowest().is_none() {
            return Ok(None);
        }
        let Some((_, index)) = self.open.pop() else { return Ok(None) };
        let label = self.labels[index as usize];
        budget.check(*steps)?;
        if self.labels.len() > LABEL_LIMIT {
            return Err(Interrupt::Memory);
        }
        let search = &mut self.search;
        if search.tree.is_served(&search.known, &label) || !search.is_free(&label, budget)? {
            return Ok(None);
        }
        if let Place::Feature(feature, _) = label.place {
            search.meet_beside(feature, budget)?;
            if search.tree.is_served(&search.known, &label) {
                return Ok(None);
            }
        }
        let Some(stance) = search.tree.stand(&search.known, &label) else { return Ok(None) };
        *steps += 1;
        let (features, bundles) = (0..search.known.features.len(), 0..search.known.bundles.len());
        search.connect(stance, &features, bundles, budget)?;
        Ok(Some(stance))
    }

    /// Where the ways of a stance leave.
    pub(crate) fn bend(&self, stance: u32) -> Bend {
        match &self.search.tree.stances[stance as usize].from {
            From::Start(_) => {
                Bend { center: self.search.tree.start.point, radius: 0.0, cost: 0.0, turn: None }
            }
            From::Feature(departure) => {
                let sign = departure.lane.side.sign();
                let (from, to) = departure.free;
                let most = if sign > 0.0 { to - departure.offset } else { departure.offset - from };
                let arrival = departure.spoke.y.atan2(departure.spoke.x);
                Bend {
                    center: departure.circle.center,
                    radius: departure.circle.price_radius,
                    cost: departure.cost,
                    turn: Some(Turn { sign, arrival, most: most.max(0.0) }),
                }
            }
        }
    }

    /// What the way by a stance straight on to `end` costs, if nothing blocks it. Meets what does.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn reaches(
        &mut self,
        stance: u32,
        end: &End,
        budget: &Budget,
    ) -> Result<Option<f64>, Interrupt> {
        let search = &mut self.search;
        let from = search.tree.stances[stance as usize].from;
        let mut best: Option<f64> = None;
        for &place in &end.places {
            let Some(leg) = from.leg_to_end(place, end.point, search.tree.start.point) else { continue };
            let left_at = match &from {
                From::Start(_) => 0.0,
                From::Feature(departure) => match departure.leaves_at(&leg.planned) {
                    Some(left_at) => left_at,
                    None => continue,
                },
            };
            let cost = search.tree.cost_along(&from, left_at, &leg);
            match search.known.way(leg.planned.from, leg.planned.to) {
                Way::Free => best = Some(best.map_or(cost, |best| best.min(cost))),
                Way::Blocked => {}
                Way::Meets(owner) => search.meet(owner, budget)?,
            }
        }
        Ok(best)
    }

    /// Corners and arcs that were met.
    pub(crate) fn feature_count(&self) -> usize {
        self.search.known.features.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::AxisTime;
    use traverse_geometry::AxisSpeeds;

    #[test]
    fn an_aim_bounds_the_way_through_the_nearest_box() {
        let box_at = |x: f64| Bounds::of([Point::new(x, 0.0), Point::new(x + 1.0, 1.0)]);
        let aim = Aim::new(Length, [box_at(10.0), box_at(-30.0)], Point::new(20.0, 0.5));
        assert_eq!(aim.rest(Length, Point::new(0.0, 0.5), 0.0), 10.0 + 9.0);
        assert_eq!(aim.rest(Length, Point::new(10.5, 4.0), 2.0), 1.0 + 9.0);
        assert_eq!(Aim::new(Length, [], Point::origin()).rest(Length, Point::origin(), 0.0), f64::INFINITY);
        let speeds = AxisSpeeds { x_mm_per_s: 2.0, y_mm_per_s: 0.5, z_mm_per_s: 0.0 };
        let time = AxisTime::new(&speeds);
        let aim = Aim::new(time, [box_at(10.0)], Point::new(20.0, 4.0));
        // Up 3 takes longer than along 9; then the slower of 10 − 2 along and 4 − 2 down.
        assert_eq!(aim.rest(time, Point::new(0.0, 5.0), 2.0), 6.0 + 4.0);
    }
}
