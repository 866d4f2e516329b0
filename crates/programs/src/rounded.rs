//! A path on the grid of a program's numbers, and the path that a controller makes of it.

use crate::codes::Distance;
use crate::grid::{Counts, Grid};
use crate::reason::Reason;
use std::f64::consts::{PI, TAU};
use traverse_drawing::{ArcMotion, GcodeDialect, SMALLEST_CHORD_TOLERANCE_MM, chords_outside};
use traverse_geometry::{Arc, Path, PathArc, Point, cross};

/// Longer arcs are split in two: near a full turn rounding decides between all and nothing.
const LONGEST_SWEEP: f64 = 1.5 * PI;

/// Arcs of smaller radius, in last places, are too coarse to stay round.
const SMALLEST_RADIUS_STEPS: f64 = 20.0;

/// How far the end of a rounded arc may turn out beyond or short of the true one, in last places.
const TURN_STEPS: f64 = 4.0;

/// How much of the controller's tolerance for radii is used.
const SHARE_OF_TOLERANCE: f64 = 0.5;

/// A move as it will be written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Move {
    pub(crate) from: Counts,
    pub(crate) end: Counts,
    pub(crate) arc: Option<Turn>,
}

/// The circle of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    /// I and J, as they are to be written.
    pub(crate) center: Counts,
    pub(crate) clockwise: bool,
}

/// How a path is put on the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    pub(crate) grid: Grid,
    pub(crate) dialect: GcodeDialect,
    pub(crate) arcs: ArcMotion,
    /// What I and J count from.
    pub(crate) centers: Distance,
    /// Where absolute centres count from, in the drawing.
    pub(crate) zero: Point,
    /// Whether the block that stands in the program already runs the last straight move.
    pub(crate) leaves_last: bool,
}

/// A path on the grid.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rounded {
    pub(crate) moves: Vec<Move>,
    /// What the controller makes of them, up to the exact target.
    pub(crate) path: Path,
    /// By how much it may run beside that: centre and ends of a rounded arc do not agree exactly.
    pub(crate) off_mm: f64,
    /// How much of it is fed, millimetres.
    pub(crate) fed_mm: f64,
}

impl Rounding {
    /// Puts `path` on the grid.
    pub(crate) fn round(self, path: &Path) -> Result<Rounded, Reason> {
        let straightened = match self.arcs {
            ArcMotion::Fed { .. } => None,
            ArcMotion::Chords { tolerance_mm } => {
                let chords = chords_outside(path, tolerance_mm);
                Some(chords.map_err(|error| Reason::Refused(error.to_string()))?)
            }
        };
        let path = straightened.as_ref().unwrap_or(path);
        let start = self.counts(path.start)?;
        let mut writer = Writer {
            rounding: self,
            at: start,
            rounded: Rounded { moves: Vec::new(), path: Path::at(path.start), off_mm: 0.0, fed_mm: 0.0 },
        };
        let last = path.steps.len().saturating_sub(1);
        let mut from = path.start;
        for (index, step) in path.steps.iter().enumerate() {
            match step.arc {
                None if index == last && self.leaves_last => {}
                None => writer.line(step.end)?,
                Some(circle) => writer.arc(&Arc::from_center(from, step.end, circle.center, circle.sweep))?,
            }
            from = step.end;
        }
        writer.rounded.path.line_to(path.end());
        Ok(writer.rounded)
    }

    fn counts(&self, p: Point) -> Result<Counts, Reason> {
        self.grid.counts(p - self.grid.origin).ok_or(Reason::NumberTooLarge)
    }
}

struct Writer {
    rounding: Rounding,
    at: Counts,
    rounded: Rounded,
}

impl Writer {
    fn line(&mut self, end: Point) -> Result<(), Reason> {
        let end = self.rounding.counts(end)?;
        if end != self.at || self.is_off_grid() {
            self.push(end, None);
            self.rounded.path.line_to(self.rounding.grid.point(end));
        }
        Ok(())
    }

    /// Whether the program's own start lies between counts, and nothing has moved since.
    fn is_off_grid(&self) -> bool {
        let away = self.rounded.path.end() - self.rounding.grid.point(self.at);
        away.norm() > 1e-3 * self.rounding.grid.step_mm()
    }

    fn push(&mut self, end: Counts, arc: Option<Turn>) {
        self.rounded.moves.push(Move { from: self.at, end, arc });
        self.at = end;
    }

    fn arc(&mut self, arc: &Arc) -> Result<(), Reason> {
        if arc.sweep.abs() > LONGEST_SWEEP {
            let (middle, half) = (arc.point_at(0.5), arc.sweep / 2.0);
            self.piece(&Arc::from_center(arc.start, middle, arc.center, half))?;
            return self.piece(&Arc::from_center(middle, arc.end, arc.center, half));
        }
        self.piece(arc)
    }

    /// An arc of at most three quarters of a turn: round if the controller reads it so, otherwise chords outside it.
    fn piece(&mut self, arc: &Arc) -> Result<(), Reason> {
        let grid = self.rounding.grid;
        let end = self.rounding.counts(arc.end)?;
        if let Some((turn, circle, off_mm)) = self.spoken(arc, end) {
            self.push(end, Some(turn));
            let radius = (self.rounded.path.end() - circle.center).norm();
            self.rounded.fed_mm += radius * circle.sweep.abs();
            self.rounded.off_mm = self.rounded.off_mm.max(off_mm);
            self.rounded.path.arc_to(grid.point(end), circle.center, circle.sweep);
            return Ok(());
        }
        let mut path = Path::at(arc.start);
        path.arc_to(arc.end, arc.center, arc.sweep);
        let tolerance = grid.step_mm().max(SMALLEST_CHORD_TOLERANCE_MM);
        let chords = chords_outside(&path, tolerance).map_err(|error| Reason::Refused(error.to_string()))?;
        for step in &chords.steps {
            self.line(step.end)?;
        }
        Ok(())
    }

    /// The arc in words, as a circle through both rounded ends, and how far from it the controller may run.
    fn spoken(&self, arc: &Arc, end: Counts) -> Option<(Turn, PathArc, f64)> {
        let grid = self.rounding.grid;
        let from = self.rounded.path.end();
        let to = grid.point(end);
        let base = match self.rounding.centers {
            Distance::Incremental => from,
            Distance::Absolute => self.rounding.zero,
        };
        let words = grid.counts(arc.center - base)?;
        let center = base + grid.vector(words);
        let (one, other) = ((from - center).norm(), (to - center).norm());
        let chord = to - from;
        if one < SMALLEST_RADIUS_STEPS * grid.step_mm() || chord.norm() < grid.step_mm() {
            return None;
        }
        let mismatch = (one - other).abs();
        if mismatch > SHARE_OF_TOLERANCE * self.rounding.dialect.radius_tolerance_mm(grid.unit, one) {
            return None;
        }
        let across = traverse_geometry::left_of(chord) / chord.norm();
        let middle = from + chord / 2.0;
        let shared = middle + across * across.dot(&(center - middle));
        let sweep = turned(from, to, shared, arc.sweep > 0.0);
        if (sweep.abs() - arc.sweep.abs()).abs() * one > TURN_STEPS * grid.step_mm() {
            return None;
        }
        let off_mm = mismatch + (center - shared).norm() * (1.0 - (sweep / 2.0).cos());
        let turn = Turn { center: words, clockwise: arc.sweep < 0.0 };
        Some((turn, PathArc { center: shared, sweep }, off_mm))
    }
}

/// The angle that a controller turns over, its sign included.
fn turned(from: Point, to: Point, center: Point, counter_clockwise: bool) -> f64 {
    let (from, to) = (from - center, to - center);
    let turned = cross(from, to).atan2(from.dot(&to));
    match (counter_clockwise, turned > 0.0) {
        (true, true) | (false, false) => turned,
        (true, false) => turned + TAU,
        (false, true) => turned - TAU,
    }
}
