//! Straight moves of a machine whose axes run at their own speeds: first both at full speed along a diagonal, until one has
//! arrived, then the other alone.
//!
//! A dog-leg takes exactly as long as its slower axis, and so do several that lead along the straight line: cutting a
//! move up costs nothing. Each piece bulges to one side of the line when it is run as one step, to the other when its
//! last part comes first, which takes two; the bulge shrinks with the piece. So a straight move that nothing blocks is cut
//! up until each piece has room on one side. It has no room where barriers leave a passage that is no wider than the path
//! and slanted: there the machine can't go, nor can it along any other way through the passage.

use super::pair::Pair;
use super::{Driver, ON_LINE_MM};
use crate::measure::{AxisTime, Measure};
use std::ops::ControlFlow;
use traverse_geometry::{AxisSpeeds, Path, PathStep, Point, RapidRules, Segment, Vector};
use traverse_solve::Interrupt;

/// Most pieces that a straight move is cut into.
const PIECE_LIMIT: usize = 1024;

/// Most steps of a plan in dog-legs: less than what a check takes.
const STEP_LIMIT: usize = 20_000;

/// Pieces shorter than this are not cut up, millimetres.
const SHORTEST_PIECE_MM: f64 = 1e-6;

impl Driver<'_> {
    /// Adds a straight move as dog-legs. Where they have no room: whose barriers leave none.
    pub(super) fn dog_legs(
        &self,
        path: &mut Path,
        speeds: &AxisSpeeds,
        from: Pair,
        to: Pair,
    ) -> Result<Option<Vec<usize>>, Interrupt> {
        let mut open = vec![(from, to)];
        let mut count = 0;
        while let Some((from, to)) = open.pop() {
            self.budget.check(0)?;
            let corner = corner(speeds, from.planned, to.planned);
            let other = from.planned + (to.planned - corner);
            if self.is_free(from.planned, corner) && self.is_free(corner, to.planned) {
                push(path, speeds, to.priced);
            } else if self.is_free(from.planned, other) && self.is_free(other, to.planned) {
                let corner = self::corner(speeds, from.priced, to.priced);
                push(path, speeds, from.priced + (to.priced - corner));
                push(path, speeds, to.priced);
            } else {
                count += 1;
                let is_long = count >= PIECE_LIMIT || path.steps.len() >= STEP_LIMIT;
                if is_long || (to.planned - from.planned).norm() < SHORTEST_PIECE_MM {
                    let ways = [
                        (from.planned, corner),
                        (corner, to.planned),
                        (from.planned, other),
                        (other, to.planned),
                    ];
                    return Ok(Some(self.in_the_way(&ways)));
                }
                let middle = from.middle(to);
                open.push((middle, to));
                open.push((from, middle));
            }
        }
        Ok(None)
    }

    /// Whose barriers block any of some straight moves.
    fn in_the_way(&self, moves: &[(Point, Point)]) -> Vec<usize> {
        let mut owners = Vec::new();
        for &(from, to) in moves.iter().filter(|(from, to)| from != to) {
            self.barriers.blocking(&Segment::new(from, to), |blocker| {
                if !self.left_out.contains(&blocker.owner) {
                    owners.push(blocker.owner);
                }
                ControlFlow::Continue(())
            });
        }
        owners.sort_unstable();
        owners.dedup();
        owners
    }
}

/// Where a dog-leg turns: at the start where it is a straight line along an axis, at the end where it is one along the
/// diagonal.
fn corner(speeds: &AxisSpeeds, from: Point, to: Point) -> Point {
    let by = to - from;
    let (x, y) = (by.x.abs() / speeds.x_mm_per_s, by.y.abs() / speeds.y_mm_per_s);
    if x < y {
        Point::new(to.x, from.y + speeds.y_mm_per_s * x * by.y.signum())
    } else {
        Point::new(from.x + speeds.x_mm_per_s * y * by.x.signum(), to.y)
    }
}

/// The path with every dog-leg as the two straight steps that the machine makes of it; the same where G0 runs straight.
#[must_use]
pub fn as_run(path: &Path, rules: &RapidRules) -> Path {
    let Some(speeds) = rules.dog_leg() else { return path.clone() };
    let mut run = Path { steps: Vec::new(), ..path.clone() };
    for step in &path.steps {
        let from = run.end();
        let turn = corner(&speeds, from, step.end);
        if step.arc.is_none() && turn != from && turn != step.end {
            run.steps.push(PathStep { end: turn, ..*step });
        }
        run.steps.push(*step);
    }
    run
}

/// Adds a step, as part of the last one if the machine runs both as one.
fn push(path: &mut Path, speeds: &AxisSpeeds, to: Point) {
    let joint = path.end();
    let before = path.steps.len().checked_sub(2).map_or(path.start, |step| path.steps[step].end);
    match path.steps.last_mut() {
        Some(last) if last.arc.is_none() && run_as_one(speeds, before, joint, to) => last.end = to,
        _ => path.line_to(to),
    }
}

/// Whether the machine runs the same way without a stop in `joint`.
fn run_as_one(speeds: &AxisSpeeds, from: Point, joint: Point, to: Point) -> bool {
    let turn = corner(speeds, from, to);
    let legs = [Segment::new(from, turn), Segment::new(turn, to)];
    let passes = |p: Point| legs.iter().any(|leg| leg.distance_to_point(p) <= ON_LINE_MM);
    [corner(speeds, from, joint), joint, corner(speeds, joint, to)].into_iter().all(passes)
}

/// Seconds of the slower axis, along moves that have room for dog-legs.
#[derive(Clone, Copy)]
pub(crate) struct DogLegTime<'a> {
    pub(crate) time: AxisTime,
    pub(crate) speeds: &'a AxisSpeeds,
    pub(crate) driver: &'a Driver<'a>,
}

impl Measure for DogLegTime<'_> {
    fn straight(self, normal: Vector, length: f64) -> f64 {
        self.time.straight(normal, length)
    }

    fn along(self, by: Vector) -> f64 {
        self.time.along(by)
    }

    fn near(self, by: Vector, radius: f64) -> f64 {
        self.time.near(by, radius)
    }

    fn fastest(self, length: f64) -> f64 {
        self.time.fastest(length)
    }

    fn gradient(self, direction: Vector) -> Vector {
        self.time.gradient(direction)
    }

    fn kinks(self) -> Option<[f64; 4]> {
        self.time.kinks()
    }

    fn arc(self, radius: f64, from: f64, sweep: f64) -> f64 {
        self.time.arc(radius, from, sweep)
    }

    /// By nobody where the budget ends; the search sees that by itself.
    fn cramped_by(self, from: Point, to: Point) -> Option<Vec<usize>> {
        let pair = |p| Pair { planned: p, priced: p };
        let mut path = Path::at(from);
        self.driver.dog_legs(&mut path, self.speeds, pair(from), pair(to)).ok().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_lie_on_the_diagonal_and_steps_run_as_one_where_they_can() {
        let speeds = AxisSpeeds { x_mm_per_s: 20.0, y_mm_per_s: 10.0, z_mm_per_s: 0.0 };
        let p = Point::new;
        assert_eq!(corner(&speeds, p(0.0, 0.0), p(10.0, 2.0)), p(4.0, 2.0));
        assert_eq!(corner(&speeds, p(0.0, 0.0), p(-2.0, 10.0)), p(-2.0, 1.0));
        assert_eq!(corner(&speeds, p(0.0, 0.0), p(7.0, 0.0)), p(0.0, 0.0));
        assert_eq!(corner(&speeds, p(1.0, 1.0), p(5.0, -1.0)), p(5.0, -1.0));
        assert!(run_as_one(&speeds, p(0.0, 0.0), p(4.0, 2.0), p(10.0, 2.0)));
        assert!(run_as_one(&speeds, p(0.0, 0.0), p(2.0, 1.0), p(10.0, 2.0)));
        assert!(run_as_one(&speeds, p(0.0, 0.0), p(6.0, 2.0), p(10.0, 2.0)));
        assert!(!run_as_one(&speeds, p(0.0, 0.0), p(6.0, 0.0), p(10.0, 2.0)));
        assert!(!run_as_one(&speeds, p(0.0, 0.0), p(5.0, 1.0), p(10.0, 2.0)));
    }
}
