//! The corridor: everything within the tolerance of a path, unrolled along it, with a left and a right wall.
//!
//! Where steps meet at an angle their parts of the corridor overlap on the inner side of the turn. What lies there is
//! the nearer one's, and none of it is at a wall.
//!
//! Steps shorter than a hundredth of the tolerance are left out: their direction is rounding. Where a path turns
//! back on itself, so that both legs stay within a few tolerances of each other, the corridor is cut in two.

use crate::curve::{Curve, cross};
use traverse_geometry::Point;

/// A step of the corridor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CorridorStep {
    /// Index of the path's step.
    pub(crate) index: usize,
    pub(crate) curve: Curve,
    /// Millimetres along the corridor where it begins and ends.
    from: f64,
    to: f64,
    /// Which uncut piece of corridor it belongs to.
    piece: usize,
}

/// A wall of the corridor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wall {
    Left,
    Right,
}

/// A path and what lies within reach of it.
#[derive(Clone, Debug)]
pub(crate) struct Corridor {
    pub(crate) steps: Vec<CorridorStep>,
    /// Where each piece ends, millimetres along the corridor.
    ends: Vec<f64>,
    pub(crate) reach: f64,
}

/// Places within this many reaches of an end of the corridor belong to the end.
const END_REACHES: f64 = 2.0;

/// Steps within this many reaches along the corridor are neighbours.
const NEIGHBOUR_REACHES: f64 = 4.0;

/// How many reaches from the ends it is asked what covers the corridor there.
const CUT_REACHES: f64 = 3.0;

/// A hairpin whose legs end nearer than this many reaches to each other cuts the corridor.
const HAIRPIN_REACHES: f64 = 4.0;

impl Corridor {
    /// The corridor along the steps; one without a curve cuts it.
    pub(crate) fn along(curves: &[Option<Curve>], reach: f64) -> Self {
        let mut corridor = Self { steps: Vec::new(), ends: Vec::new(), reach };
        let mut cut = true;
        for (index, curve) in curves.iter().enumerate() {
            let Some(curve) = *curve else {
                cut = true;
                continue;
            };
            let length = curve.length();
            if length <= reach / 100.0 {
                continue;
            }
            let last = corridor.steps.last();
            cut |= last.is_some_and(|last| turns_back(&last.curve, &curve, reach));
            // Pieces are numbered along one scale, each from 0.
            let from = if cut { 0.0 } else { last.map_or(0.0, |last| last.to) };
            if cut {
                corridor.ends.push(0.0);
            }
            let piece = corridor.ends.len() - 1;
            corridor.ends[piece] = from + length;
            corridor.steps.push(CorridorStep { index, curve, from, to: from + length, piece });
            cut = false;
        }
        corridor
    }

    /// Whether the place of step `at` nearest to `p` belongs to an end of its piece.
    pub(crate) fn is_near_end(&self, at: usize, p: Point) -> bool {
        let step = &self.steps[at];
        let way = step.from + step.curve.nearest_fraction(p) * (step.to - step.from);
        way <= END_REACHES * self.reach || way >= self.ends[step.piece] - END_REACHES * self.reach
    }

    /// Indices of the steps of the same piece up to a window before `from` and after `to`, millimetres along the
    /// corridor, without `at`, nearest first.
    fn neighbours(&self, at: usize, from: f64, to: f64) -> impl Iterator<Item = usize> {
        let piece = self.steps[at].piece;
        let window = NEIGHBOUR_REACHES * self.reach;
        let before = (0..at).rev().take_while(move |&other| {
            self.steps[other].piece == piece && from - self.steps[other].to <= window
        });
        let after = (at + 1..self.steps.len()).take_while(move |&other| {
            self.steps[other].piece == piece && self.steps[other].from - to <= window
        });
        before.chain(after)
    }

    /// Indices of the steps just after `at`, up to the one that is no neighbour of its end.
    pub(crate) fn following(&self, at: usize) -> impl Iterator<Item = usize> {
        let step = &self.steps[at];
        self.neighbours(at, f64::INFINITY, step.to)
    }

    /// The wall through which something leaves the corridor at `p`, which lies at the reach of step `at`. None: it
    /// belongs to an end, or goes on within reach of a neighbour.
    ///
    /// `crosses`: it leaves step `at` on both sides, and so crosses it, whatever neighbours do farther along.
    pub(crate) fn wall_at(&self, at: usize, p: Point, crosses: bool) -> Option<Wall> {
        let step = &self.steps[at];
        if self.is_near_end(at, p) {
            return None;
        }
        let fraction = step.curve.nearest_fraction(p);
        let beside = fraction > 0.0 && fraction < 1.0;
        // What is nearer to the next step across a sharp turn lies beyond the bisector: it is the other one's.
        let (from, to) = if beside && !crosses {
            (step.from, step.to)
        } else {
            let way = step.from + fraction * (step.to - step.from);
            (way, way)
        };
        let rounding = 1e-6 * self.reach + 16.0 * f64::EPSILON * p.x.abs().max(p.y.abs());
        let nearer = |other: usize| self.steps[other].curve.distance_to_point(p) < self.reach - rounding;
        if self.neighbours(at, from, to).any(nearer) {
            return None;
        }
        Some(self.side_of(at, fraction, p))
    }

    /// On which side of the place at `fraction` of step `at` a point lies.
    pub(crate) fn side_of(&self, at: usize, fraction: f64, p: Point) -> Wall {
        let step = &self.steps[at];
        let mut direction = step.curve.direction_at(fraction);
        // Beyond an end of the step: outside of the turn into its neighbour.
        if fraction <= 0.0 && at > 0 {
            direction += self.steps[at - 1].curve.direction_at(1.0);
        } else if fraction >= 1.0 && at + 1 < self.steps.len() {
            direction += self.steps[at + 1].curve.direction_at(0.0);
        }
        let side = cross(direction, p - step.curve.point_at(fraction));
        if side > 0.0 { Wall::Left } else { Wall::Right }
    }

    /// The places just past the ends of every piece: step and fraction of its way.
    pub(crate) fn end_cuts(&self) -> Vec<(usize, f64)> {
        let inset = CUT_REACHES * self.reach;
        let mut cuts = Vec::new();
        for (at, step) in self.steps.iter().enumerate() {
            let end = self.ends[step.piece];
            let length = step.to - step.from;
            if end < 2.0 * inset {
                continue;
            }
            for way in [inset, end - inset] {
                if step.from <= way && way < step.to {
                    cuts.push((at, (way - step.from) / length));
                }
            }
        }
        cuts
    }
}

/// Whether the path turns back so sharply that both steps are hardly out of each other's reach where they end.
fn turns_back(arriving: &Curve, leaving: &Curve, reach: f64) -> bool {
    let (from, to) = (arriving.direction_at(1.0), leaving.direction_at(0.0));
    let apart = arriving.length().min(leaving.length()) * cross(from, to).abs();
    from.dot(&to) < 0.0 && apart < HAIRPIN_REACHES * reach
}
