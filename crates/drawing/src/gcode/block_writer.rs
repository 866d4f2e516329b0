//! Moves as blocks, one after another, with the modal state that they leave behind.

use super::arc_block::{ArcBlock, arc_block};
use super::axes::{Axes, Words};
use super::chords::corners_outside;
use super::error::GcodeError;
use super::grid::Grid;
use super::moves::{GcodeMoves, ModalState};
use super::settings::{ArcMotion, GcodeSettings, StraightMotion};
use traverse_geometry::{Arc, Point};

/// Longer arcs are split in two: near a full turn rounding decides between all and nothing.
const LONGEST_SWEEP: f64 = 1.5 * std::f64::consts::PI;

/// A rounded point is at most this many last places away.
const ROUNDING_STEPS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A height that is rounded down by no more, in last places, is the same: rounding of doubles.
const SAME_HEIGHT_STEPS: f64 = 1e-6;

pub(crate) struct BlockWriter<'a> {
    settings: &'a GcodeSettings,
    grid: Grid,
    axes: Axes,
    /// Where the controller stands.
    at: Words,
    /// Its height, in last places; none: the path has no heights.
    at_z: Option<i64>,
    /// The last G word that was written.
    motion: Option<u8>,
    feed_written: bool,
    moves: GcodeMoves,
}

impl<'a> BlockWriter<'a> {
    pub(crate) fn new(settings: &'a GcodeSettings, decimals: u8, start: Point) -> Result<Self, GcodeError> {
        let grid = Grid { unit: settings.unit, decimals, dialect: settings.dialect };
        let axes = Axes::from(settings.plane);
        let at = axes.position(grid, start).map_err(|too_large| number_too_large(grid, 0, too_large))?;
        let moves = GcodeMoves { lines: Vec::new(), decimals, fed_arc_count: 0, straightened_arc_count: 0 };
        Ok(Self { settings, grid, axes, at, at_z: None, motion: None, feed_written: false, moves })
    }

    /// Where the controller stands, as words.
    pub(crate) fn position_text(&self) -> String {
        self.axes.position_text(self.grid, self.at)
    }

    /// Its height, as a word; nothing where there are no heights.
    pub(crate) fn height_text(&self) -> String {
        self.at_z.map_or_else(String::new, |z| format!(" Z{}", self.grid.text(z)))
    }

    pub(crate) fn stand_at_height(&mut self, z_mm: f64) -> Result<(), GcodeError> {
        self.at_z = Some(self.height_count(z_mm, 0)?);
        Ok(())
    }

    /// Rises or sinks to a height, unless it stands there.
    pub(crate) fn height(&mut self, z_mm: f64, step: usize) -> Result<(), GcodeError> {
        let z = self.height_count(z_mm, step)?;
        if self.at_z.replace(z) != Some(z) {
            self.block(0, &self.height_text(), None);
        }
        Ok(())
    }

    /// The count of a height, rounded up: what is passed over may need all of it.
    fn height_count(&self, z_mm: f64, step: usize) -> Result<i64, GcodeError> {
        let too_large = || number_too_large(self.grid, step, ('Z', z_mm));
        let count = self.grid.count(z_mm).ok_or_else(too_large)?;
        let is_short = z_mm - self.grid.mm(count) > SAME_HEIGHT_STEPS * self.grid.step_mm();
        Ok(if is_short { count + 1 } else { count })
    }

    fn words(&self, p: Point, step: usize) -> Result<Words, GcodeError> {
        self.axes.position(self.grid, p).map_err(|too_large| number_too_large(self.grid, step, too_large))
    }

    pub(crate) fn straight(&mut self, end: Point, step: usize) -> Result<(), GcodeError> {
        let end = self.words(end, step)?;
        if end == self.at {
            return Ok(());
        }
        let position = self.axes.position_text(self.grid, end);
        match self.settings.straight {
            StraightMotion::Rapid => self.block(0, &position, None),
            StraightMotion::Fed { feed_mm_per_min } => self.block(1, &position, Some(feed_mm_per_min)),
        }
        self.at = end;
        Ok(())
    }

    pub(crate) fn arc(&mut self, arc: &Arc, step: usize) -> Result<(), GcodeError> {
        let feed_mm_per_min = match self.settings.arcs {
            ArcMotion::Fed { feed_mm_per_min } => feed_mm_per_min,
            ArcMotion::Chords { tolerance_mm } => return self.chords(arc, tolerance_mm, step),
        };
        if arc.sweep.abs() > LONGEST_SWEEP {
            let middle = arc.point_at(0.5);
            let half = arc.sweep / 2.0;
            self.piece(&Arc::from_center(arc.start, middle, arc.center, half), feed_mm_per_min, step)?;
            return self.piece(&Arc::from_center(middle, arc.end, arc.center, half), feed_mm_per_min, step);
        }
        self.piece(arc, feed_mm_per_min, step)
    }

    fn piece(&mut self, arc: &Arc, feed_mm_per_min: f64, step: usize) -> Result<(), GcodeError> {
        let end = self.words(arc.end, step)?;
        match arc_block(self.grid, self.axes, self.at, end, arc) {
            ArcBlock::Straight => self.straight(arc.end, step),
            ArcBlock::Unspeakable => self.chords(arc, self.grid.step_mm(), step),
            ArcBlock::RadiiDiffer { mismatch_mm, tolerance_mm } => Err(GcodeError::RadiiDiffer {
                step,
                mismatch_mm,
                tolerance_mm,
                dialect: self.grid.dialect.name(),
                decimals: self.grid.decimals,
            }),
            ArcBlock::Round { end, offset } => {
                let (position, center) =
                    (self.axes.position_text(self.grid, end), self.axes.offset_text(self.grid, offset));
                let direction = if arc.sweep > 0.0 { 3 } else { 2 };
                self.block(direction, &format!("{position}{center}"), Some(feed_mm_per_min));
                self.at = end;
                self.moves.fed_arc_count += 1;
                Ok(())
            }
        }
    }

    fn chords(&mut self, arc: &Arc, tolerance_mm: f64, step: usize) -> Result<(), GcodeError> {
        let rounding_mm = ROUNDING_STEPS * self.grid.step_mm();
        for corner in corners_outside(arc, tolerance_mm, rounding_mm, step)? {
            self.straight(corner, step)?;
        }
        self.moves.straightened_arc_count += 1;
        self.straight(arc.end, step)
    }

    fn block(&mut self, motion: u8, words: &str, feed_mm_per_min: Option<f64>) {
        let feed = feed_mm_per_min.map(|feed| format!(" F{}", self.grid.feed_text(feed)));
        self.feed_written |= feed.is_some();
        self.motion = Some(motion);
        self.moves.lines.push(format!("G{motion}{words}{}", feed.unwrap_or_default()));
    }

    /// Restores what the moves have changed of the modal state.
    pub(crate) fn finish(mut self, after: &ModalState) -> GcodeMoves {
        let mut words = Vec::new();
        let motion = after.straight_g_word();
        if self.motion.is_some_and(|last| last != motion) {
            words.push(format!("G{motion}"));
        }
        if let Some(feed) = after.feed_per_min.filter(|_| self.feed_written) {
            words.push(format!("F{}", self.grid.exact_feed_text(feed)));
        }
        if !words.is_empty() {
            self.moves.lines.push(words.join(" "));
        }
        self.moves
    }
}

fn number_too_large(grid: Grid, step: usize, (word, mm): (char, f64)) -> GcodeError {
    GcodeError::NumberTooLarge {
        step,
        word,
        value: mm / grid.unit.millimetres(),
        limit: grid.limit(),
        dialect: grid.dialect.name(),
        decimals: grid.decimals,
    }
}
