//! How the machine runs a route: arcs as they are or as chords outside of them, straight moves as a line or as a dog-leg.
//!
//! A route is planned at its plan radii and answered at its price radii (docs/decisions/0001): what is tested runs at the
//! former, what is answered at the latter, point by point ([`Pair`]).

mod chords;
mod dog_leg;
mod pair;

pub(crate) use dog_leg::DogLegTime;
pub use dog_leg::as_run;
use pair::Pair;

use crate::barriers::Barriers;
use crate::measure::AxisTime;
use crate::search::{Route, Stop};
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use traverse_geometry::{ArcOutput, AxisSpeeds, Path, Point, Segment};
use traverse_solve::{Budget, Interrupt};

/// An arc shorter than this is left out of the answer, millimetres.
pub(crate) const SHORTEST_ARC_MM: f64 = 1e-9;

/// A machine among barriers.
#[derive(Clone, Copy)]
pub(crate) struct Driver<'a> {
    pub(crate) barriers: &'a Barriers<'a>,
    /// Owners of barriers that are taken for not there.
    pub(crate) left_out: &'a BTreeSet<usize>,
    pub(crate) arcs: ArcOutput,
    /// Where straight moves run as dog-legs.
    pub(crate) dog_leg: Option<AxisSpeeds>,
    /// Where costs of arcs have kinks.
    pub(crate) axes: Option<AxisTime>,
    pub(crate) budget: &'a Budget,
}

impl Driver<'_> {
    /// Whether a route is run as it is.
    pub(crate) fn is_plain(&self) -> bool {
        self.arcs == ArcOutput::Arcs && self.dog_leg.is_none()
    }

    /// The path that the machine runs; none where a straight move has no room for dog-legs.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn drive(
        &self,
        route: &Route,
        start: Point,
        target: Point,
    ) -> Result<Option<Path>, Interrupt> {
        let [first, last] = route.places;
        let mut path = Path::at(start);
        let mut at = Pair { planned: first, priced: start };
        for stop in &route.stops {
            let arrival = Pair::arrival(stop);
            if !self.straight(&mut path, at, arrival)? {
                return Ok(None);
            }
            at = arrival;
            if stop.circle.price_radius == 0.0 {
                at = Pair::departure(stop);
            } else if stop.turned * stop.circle.price_radius > SHORTEST_ARC_MM {
                at = Pair::departure(stop);
                if self.arcs == ArcOutput::Arcs || !self.chords(&mut path, stop, arrival, at)? {
                    path.arc_to(at.priced, stop.circle.center, sweep(stop));
                }
            }
        }
        let end = Pair { planned: last, priced: target };
        Ok(self.straight(&mut path, at, end)?.then_some(path))
    }

    /// Adds a straight move; false where there is no room for it.
    fn straight(&self, path: &mut Path, from: Pair, to: Pair) -> Result<bool, Interrupt> {
        match &self.dog_leg {
            Some(speeds) => Ok(self.dog_legs(path, speeds, from, to)?.is_none()),
            None => {
                extend(path, to.priced);
                Ok(true)
            }
        }
    }

    /// Whether nothing is in the way of a straight move as it is planned.
    fn is_free(&self, from: Point, to: Point) -> bool {
        if from == to {
            return true;
        }
        let mut free = true;
        self.barriers.blocking(&Segment::new(from, to), |blocker| {
            if self.left_out.contains(&blocker.owner) {
                return ControlFlow::Continue(());
            }
            free = false;
            ControlFlow::Break(())
        });
        free
    }
}

/// The angle that the answered path turns at a stop, positive counter-clockwise.
fn sweep(stop: &Stop) -> f64 {
    stop.turned * stop.side.sign()
}

/// Points nearer to a line than this lie on it, millimetres: rounding.
const ON_LINE_MM: f64 = 1e-9;

/// Adds a straight move; one straight on from the last becomes part of it.
fn extend(path: &mut Path, to: Point) {
    let joint = path.end();
    let before = path.steps.len().checked_sub(2).map_or(path.start, |step| path.steps[step].end);
    match path.steps.last_mut() {
        Some(last) if last.arc.is_none() && lies_between(before, joint, to) => last.end = to,
        _ => path.line_to(to),
    }
}

/// Whether `middle` lies on the way from `from` to `to`.
fn lies_between(from: Point, middle: Point, to: Point) -> bool {
    Segment::new(from, to).distance_to_point(middle) <= ON_LINE_MM
}
