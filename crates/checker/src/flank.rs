//! A piece of a border as it is met by something that comes sideways: to each height of a range belongs one reach.
//!
//! Reaches are floors: what rounding may have added is taken off, so that a bound that adds reaches never says too much.
//! Heights are taken as the numbers that they are; of circular edges the highest and lowest points are known up to rounding.

use crate::curve::{Circular, Curve};
use traverse_geometry::Vector;

/// Roundings of the largest number involved that may be in the place of a circular edge.
const ARC_ROUNDINGS: f64 = 16.0;

/// A straight or circular piece that does not turn back in height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flank {
    /// Lowest and highest height.
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Reach at either end.
    at_low: f64,
    at_high: f64,
    round: Option<Round>,
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
    /// Adds the flanks of an edge, reaches being its x.
    pub(crate) fn add(curve: &Curve, flanks: &mut Vec<Self>) {
        match curve {
            Curve::Straight(straight) => {
                let (a, b) = (straight.a, straight.b);
                let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
                let (at_low, at_high) = match low.y < high.y {
                    true => (low.x, high.x),
                    false => (low.x.max(high.x), low.x.max(high.x)),
                };
                flanks.push(Self { low: low.y, high: high.y, at_low, at_high, round: None });
            }
            Curve::Circular(arc) => Self::add_arc(curve, arc, flanks),
        }
    }

    fn add_arc(curve: &Curve, arc: &Circular, flanks: &mut Vec<Self>) {
        let mut cuts = vec![0.0, 1.0];
        curve.cut_by_direction(Vector::y(), &mut cuts);
        cuts.sort_by(f64::total_cmp);
        let center = arc.center.coords;
        let slack = ARC_ROUNDINGS * f64::EPSILON * (center.x.abs() + center.y.abs() + arc.radius);
        for pair in cuts.windows(2) {
            let end = |fraction: f64| {
                let p = curve.point_at(fraction);
                // A vertex is what was sent; what was cut is known up to rounding.
                let own = fraction == 0.0 || fraction == 1.0;
                (p.y, if own { p.x } else { p.x - slack })
            };
            let (from, to) = (end(pair[0]), end(pair[1]));
            let (low, high) = if from.0 <= to.0 { (from, to) } else { (to, from) };
            let bulges = curve.point_at(f64::midpoint(pair[0], pair[1])).x >= center.x;
            let round = Some(Round { center, radius: arc.radius, bulges, slack });
            flanks.push(Self { low: low.0, high: high.0, at_low: low.1, at_high: high.1, round });
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
        let Some(Round { center, radius, bulges, slack }) = self.round else { return self.chord(y) };
        let off = (y - center.y).abs();
        let half = |off: f64| ((radius - off) * (radius + off)).max(0.0).sqrt();
        if bulges {
            // The flank bulges over its chord, which is known better where it is steep.
            (center.x + half(off + slack) - slack).max(self.chord(y) - slack)
        } else {
            center.x - half((off - slack).max(0.0)) - slack
        }
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
        match self.round {
            Some(round) if round.bulges => ends.max(self.reach(round.center.y.clamp(from, to))),
            _ => ends,
        }
    }

    /// The least that it reaches between two heights.
    pub(crate) fn least(&self, from: f64, to: f64) -> f64 {
        let ends = self.reach(from).min(self.reach(to));
        match self.round {
            Some(round) if !round.bulges => ends.min(self.reach(round.center.y.clamp(from, to))),
            _ => ends,
        }
    }

    /// Where it has which slope, its ends first.
    pub(crate) fn slopes(&self) -> [Slopes; 3] {
        let inner = match self.round {
            Some(Round { center, radius, bulges, .. }) => {
                Slopes::Round { center: center.y, radius: if bulges { radius } else { -radius } }
            }
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
