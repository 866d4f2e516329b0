//! The strip: everything within the tolerance of a path, unrolled along it, with a left and a right wall.
//!
//! Steps shorter than a hundredth of the tolerance are left out: their direction is rounding. Where a path folds
//! straight back the strip is cut in two.

use crate::curve::{Curve, cross};
use traverse_geometry::Point;

/// A step of the strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StripStep {
    /// Index of the path's step.
    pub(crate) index: usize,
    pub(crate) curve: Curve,
    /// Millimetres along the strip where it begins and ends.
    from: f64,
    to: f64,
    /// Which uncut piece of strip it belongs to.
    piece: usize,
}

/// A wall of the strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wall {
    Left,
    Right,
}

/// A path and what lies within reach of it.
#[derive(Clone, Debug)]
pub(crate) struct Strip {
    pub(crate) steps: Vec<StripStep>,
    /// Where each piece ends, millimetres along the strip.
    ends: Vec<f64>,
    pub(crate) reach: f64,
}

/// Places within this many reaches of an end of the strip belong to the end.
const END_REACHES: f64 = 2.0;

/// Steps within this many reaches along the strip are neighbours.
const NEIGHBOUR_REACHES: f64 = 4.0;

/// Sine below which a turn back is a reversal.
const REVERSAL_SINE: f64 = 1e-6;

impl Strip {
    /// The strip along the steps; one without a curve cuts it.
    pub(crate) fn along(curves: &[Option<Curve>], reach: f64) -> Self {
        let mut strip = Self { steps: Vec::new(), ends: Vec::new(), reach };
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
            let last = strip.steps.last();
            cut |= last.is_some_and(|last| reverses(&last.curve, &curve));
            // Pieces are numbered along one scale, each from 0.
            let from = if cut { 0.0 } else { last.map_or(0.0, |last| last.to) };
            if cut {
                strip.ends.push(0.0);
            }
            let piece = strip.ends.len() - 1;
            strip.ends[piece] = from + length;
            strip.steps.push(StripStep { index, curve, from, to: from + length, piece });
            cut = false;
        }
        strip
    }

    /// Whether the place of step `at` nearest to `p` belongs to an end of its piece.
    pub(crate) fn is_near_end(&self, at: usize, p: Point) -> bool {
        let step = &self.steps[at];
        let way = step.from + step.curve.nearest_fraction(p) * (step.to - step.from);
        way <= END_REACHES * self.reach || way >= self.ends[step.piece] - END_REACHES * self.reach
    }

    /// Neighbours of step `at` before `way`, nearest first, and after it.
    fn neighbours(&self, at: usize, way: f64) -> impl Iterator<Item = &StripStep> {
        let piece = self.steps[at].piece;
        let window = NEIGHBOUR_REACHES * self.reach;
        let before = self.steps[..at].iter().rev();
        let after = self.steps[at + 1..].iter();
        before
            .take_while(move |step| step.piece == piece && way - step.to <= window)
            .chain(after.take_while(move |step| step.piece == piece && step.from - way <= window))
    }

    /// Indices of the steps just after `at`, up to the one that is no neighbour of its end.
    pub(crate) fn following(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        let StripStep { piece, to, .. } = self.steps[at];
        let window = NEIGHBOUR_REACHES * self.reach;
        (at + 1..self.steps.len())
            .take_while(move |&next| self.steps[next].piece == piece && self.steps[next].from - to <= window)
    }

    /// The wall through which something leaves the strip at `p`, which lies at the reach of step `at`. None: `p`
    /// is within reach of a neighbouring step, or belongs to an end.
    pub(crate) fn wall_at(&self, at: usize, p: Point) -> Option<Wall> {
        if self.is_near_end(at, p) {
            return None;
        }
        let step = &self.steps[at];
        let fraction = step.curve.nearest_fraction(p);
        let way = step.from + fraction * (step.to - step.from);
        if self.neighbours(at, way).any(|other| other.curve.distance_to_point(p) < 0.99 * self.reach) {
            return None;
        }
        let mut direction = step.curve.direction_at(fraction);
        // Beyond an end of the step: outside of the turn into its neighbour.
        if fraction <= 0.0 && at > 0 {
            direction += self.steps[at - 1].curve.direction_at(1.0);
        } else if fraction >= 1.0 && at + 1 < self.steps.len() {
            direction += self.steps[at + 1].curve.direction_at(0.0);
        }
        let side = cross(direction, p - step.curve.point_at(fraction));
        Some(if side > 0.0 { Wall::Left } else { Wall::Right })
    }
}

fn reverses(arriving: &Curve, leaving: &Curve) -> bool {
    let (from, to) = (arriving.direction_at(1.0), leaving.direction_at(0.0));
    from.dot(&to) < 0.0 && cross(from, to).abs() < REVERSAL_SINE
}
