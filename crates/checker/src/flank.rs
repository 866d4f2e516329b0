//! A piece of a border as it is met by something that comes sideways: to each height of a range belongs one reach.
//!
//! Reaches are floors at exact heights: what rounding may have added is taken off, so that a bound that adds reaches never
//! says too much. Likewise a flank begins and ends where its border certainly is: at tops of arcs, whose height is known up to
//! rounding, it is shorter by that.

use crate::curve::{Circular, Curve, Straight};
use std::f64::consts::FRAC_PI_2;
use traverse_geometry::{Point, Vector};

/// Roundings of the largest number involved that may be in the place of a circular edge. Arcs of more than half a turn have as many more as they are wider than their chord.
const ARC_ROUNDINGS: f64 = 16.0;

/// A straight or circular piece that does not turn back in height.
#[derive(Clone, Debug)]
pub(crate) struct Flank {
    /// Lowest and highest height.
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Reach at either end.
    at_low: f64,
    at_high: f64,
    /// Boxed: most edges are straight, and many flanks are kept.
    round: Option<Box<Round>>,
}

/// The circle of a round flank.
#[derive(Clone, Copy, Debug)]
struct Round {
    center: Vector,
    radius: f64,
    /// Whether the flank lies on the half of the circle that reaches further; otherwise it is hollow.
    bulges: bool,
    /// What rounding may have moved it by, millimetres.
    slack: f64,
}

/// Where the reach of a flank has which slope: the slope of reach over height is s / √(1 − s²).
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slopes {
    /// One height with any slope (radius 0), or a circle: at height `center` − `radius` · s. The radius of hollow
    /// flanks is negative.
    Round { center: f64, radius: f64 },
    /// The same s at every height.
    Straight { s: f64 },
}

impl Flank {
    /// Shows the flanks of an edge, reaches being its x.
    pub(crate) fn each(curve: &Curve, mut show: impl FnMut(Self)) {
        match curve {
            Curve::Straight(straight) => show(Self::of_straight(straight)),
            Curve::Circular(arc) => Self::each_of_arc(curve, arc, show),
        }
    }

    fn of_straight(straight: &Straight) -> Self {
        let Straight { a, b, .. } = *straight;
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (at_low, at_high) =
            if low.y == high.y { (low.x.max(high.x), low.x.max(high.x)) } else { (low.x, high.x) };
        Self { low: low.y, high: high.y, at_low, at_high, round: None }
    }

    fn each_of_arc(curve: &Curve, arc: &Circular, mut show: impl FnMut(Self)) {
        let mut cuts = vec![0.0, 1.0];
        curve.cut_by_direction(Vector::y(), &mut cuts);
        cuts.sort_by(f64::total_cmp);
        let center = arc.center.coords;
        let chord = (arc.b - arc.a).norm();
        let wider = if arc.half > FRAC_PI_2 { 2.0 * arc.radius / chord } else { 1.0 };
        let slack = ARC_ROUNDINGS * f64::EPSILON * (center.x.abs() + center.y.abs() + arc.radius) * wider;
        for pair in cuts.windows(2) {
            let bulges = curve.point_at(f64::midpoint(pair[0], pair[1])).x >= center.x;
            let round = Round { center, radius: arc.radius, bulges, slack };
            // A vertex is what was sent; what was cut is known up to rounding.
            let end = |fraction: f64| (curve.point_at(fraction), fraction == 0.0 || fraction == 1.0);
            let (from, to) = (end(pair[0]), end(pair[1]));
            let (low, high) = if from.0.y <= to.0.y { (from, to) } else { (to, from) };
            let moved =
                |(p, is_sent): (Point, bool), y: f64| if is_sent { (p.y, p.x) } else { (y, round.reach(y)) };
            let (low, at_low) = moved(low, above(low.0.y, slack));
            let (high, at_high) = moved(high, below(high.0.y, slack));
            show_sound(Self { low, high, at_low, at_high, round: Some(Box::new(round)) }, &mut show);
        }
    }

    /// How far it reaches at a height of its range, not more than it does.
    pub(crate) fn reach(&self, y: f64) -> f64 {
        if y <= self.low {
            return self.at_low;
        }
        if y >= self.high {
            return self.at_high;
        }
        match &self.round {
            // The flank bulges over its chord, which is known better where it is steep.
            Some(round) if round.bulges => round.reach(y).max(self.chord(y) - round.slack),
            Some(round) => round.reach(y),
            None => self.chord(y),
        }
    }

    /// Whether the straight line between any two of its points reaches as far as it, or farther.
    pub(crate) fn is_within_chord(&self) -> bool {
        self.round.as_ref().is_none_or(|round| !round.bulges)
    }

    /// Whether it reaches as far as the straight line between any two of its points, or farther.
    pub(crate) fn is_beyond_chord(&self) -> bool {
        self.round.as_ref().is_none_or(|round| round.bulges)
    }

    /// The straight line between its ends.
    fn chord(&self, y: f64) -> f64 {
        let rise = self.at_high - self.at_low;
        // From the nearer end: half the rounding.
        if y - self.low <= self.high - y {
            self.at_low + rise * ((y - self.low) / (self.high - self.low))
        } else {
            self.at_high - rise * ((self.high - y) / (self.high - self.low))
        }
    }

    /// The furthest that it reaches between two heights.
    pub(crate) fn furthest(&self, from: f64, to: f64) -> f64 {
        let ends = self.reach(from).max(self.reach(to));
        match &self.round {
            Some(round) if round.bulges => ends.max(self.reach(round.center.y.clamp(from, to))),
            _ => ends,
        }
    }

    /// The least that it reaches between two heights.
    pub(crate) fn least(&self, from: f64, to: f64) -> f64 {
        let ends = self.reach(from).min(self.reach(to));
        match &self.round {
            Some(round) if !round.bulges => ends.min(self.reach(round.center.y.clamp(from, to))),
            _ => ends,
        }
    }

    /// Where it has which slope, its ends first.
    pub(crate) fn slopes(&self) -> [Slopes; 3] {
        let inner = match &self.round {
            Some(round) => Slopes::Round {
                center: round.center.y,
                radius: if round.bulges { round.radius } else { -round.radius },
            },
            None => {
                let (rise, height) = (self.at_high - self.at_low, self.high - self.low);
                let length = rise.hypot(height);
                Slopes::Straight { s: if length > 0.0 { rise / length } else { 0.0 } }
            }
        };
        let end = |y: f64| Slopes::Round { center: y, radius: 0.0 };
        [end(self.low), end(self.high), inner]
    }
}

impl Round {
    /// How far the circle reaches at a height, not more than it does.
    fn reach(&self, y: f64) -> f64 {
        let Self { center, radius, bulges, slack } = *self;
        let off = (y - center.y).abs();
        let half = |off: f64| ((radius - off) * (radius + off)).max(0.0).sqrt();
        if bulges {
            center.x + half(off + slack) - slack
        } else {
            center.x - half((off - slack).max(0.0)) - slack
        }
    }
}

/// Shows a flank, unless nothing of it is left that certainly is there.
fn show_sound(flank: Flank, show: &mut impl FnMut(Flank)) {
    if flank.low <= flank.high {
        show(flank);
    }
}

/// Not lower than `slack` above a height; without slack the height itself.
fn above(y: f64, slack: f64) -> f64 {
    if slack > 0.0 { (y + slack).next_up() } else { y }
}

/// Not higher than `slack` below a height; without slack the height itself.
fn below(y: f64, slack: f64) -> f64 {
    -above(-y, slack)
}
