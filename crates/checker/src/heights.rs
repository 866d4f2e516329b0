//! Heights along a path: which are wrong, and how far a step lies below what lets it pass over an obstacle.

use crate::message::millimetres;
use crate::{Violation, ViolationReason};
use traverse_geometry::{HeightRule, Path, Scene};

/// A path's heights, held against the rule for them.
pub(crate) struct Heights {
    rule: Option<HeightRule>,
    tolerance: f64,
    /// Height where the path begins, and where each step ends.
    at: Vec<Option<f64>>,
    /// Which steps move in the plane, by more than the tolerance.
    moves: Vec<bool>,
}

impl Heights {
    pub(crate) fn new(rule: Option<HeightRule>, path: &Path, tolerance: f64) -> Self {
        let at = std::iter::once(path.start_z_mm).chain(path.steps.iter().map(|step| step.z_mm)).collect();
        let mut from = path.start;
        let moves = path.steps.iter().map(|step| {
            let start = std::mem::replace(&mut from, step.end);
            step.arc.is_some() || (step.end - start).norm() > tolerance
        });
        Self { rule, tolerance, at, moves: moves.collect() }
    }

    /// The lowest height of a step, as far as it has one: that of the start for a path without steps.
    fn lowest(&self, step: usize) -> Option<f64> {
        let from = self.at.get(step).copied().flatten()?;
        match self.at.get(step + 1) {
            Some(to) => to.map(|to| from.min(to)),
            None => Some(from),
        }
    }

    /// How far a step lies below the height from which on the obstacle is passed over; negative: above it. None: there
    /// is no such height.
    pub(crate) fn lack(&self, scene: &Scene, obstacle: Option<usize>, step: usize) -> Option<f64> {
        let rule = self.rule?;
        let top = scene.obstacles.get(obstacle?)?.top_z_mm?;
        Some(top + rule.clearance_z_mm - self.lowest(step)?)
    }

    /// Whether a step stays at its height.
    pub(crate) fn is_level(&self, step: usize) -> bool {
        match (self.at.get(step).copied().flatten(), self.at.get(step + 1).copied().flatten()) {
            (Some(from), Some(to)) => (to - from).abs() <= self.tolerance,
            _ => true,
        }
    }

    /// Everything that is wrong with heights, along the path.
    pub(crate) fn violations(&self, mut report: impl FnMut(Violation)) {
        let count = self.moves.len();
        let field = |place: usize| match place {
            0 => "path.start_z_mm".to_owned(),
            step => format!("path.steps[{}].z_mm", step - 1),
        };
        let mut add = |place: usize, reason, amount: f64, message: String| {
            report(Violation { field: field(place), reason, message, amount, at: None, obstacle: None });
        };
        for (place, z) in self.at.iter().enumerate() {
            let what = if place == 0 { "the start".to_owned() } else { format!("step {}", place - 1) };
            match (self.rule, *z) {
                (Some(_), None) => {
                    let message = format!("{what} has no height, and heights are asked for");
                    add(place, ViolationReason::HeightMismatch, 0.0, message);
                }
                (None, Some(z)) => {
                    let message =
                        format!("{what} has height {} mm, and no heights are asked for", millimetres(z));
                    add(place, ViolationReason::HeightMismatch, 0.0, message);
                }
                (None, None) => {}
                (Some(rule), Some(z)) => {
                    let above = z - rule.highest_z_mm;
                    if above > self.tolerance {
                        let message =
                            format!("{what} is {} mm higher than the tool may go", millimetres(above));
                        add(place, ViolationReason::TooHigh, above, message);
                    }
                    for (ends, wanted, verb, reason) in [
                        (place == 0, rule.start_z_mm, "begins", ViolationReason::WrongStart),
                        (place == count, rule.target_z_mm, "ends", ViolationReason::WrongEnd),
                    ] {
                        let off = (z - wanted).abs();
                        if ends && off > self.tolerance {
                            let message = format!(
                                "the path {verb} {} mm from the height that was asked for",
                                millimetres(off)
                            );
                            add(place, reason, off, message);
                        }
                    }
                }
            }
        }
        for step in (0..count).filter(|&step| self.moves[step] && !self.is_level(step)) {
            let (from, to) = (self.at[step].unwrap_or(0.0), self.at[step + 1].unwrap_or(0.0));
            let amount = (to - from).abs();
            let message =
                format!("step {step} moves in the plane and by {} mm in height at once", millimetres(amount));
            add(step + 1, ViolationReason::SlantedStep, amount, message);
        }
    }
}
