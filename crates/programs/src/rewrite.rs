//! Replaces the rapid moves of a program.
//!
//! Every change is checked on the rounded numbers before it counts. Cost: one look for each link, one plan for each
//! that is blocked or runs a detour; the text is copied once.

use crate::codes::Distance;
use crate::edit::{Edit, apply};
use crate::grid::Grid;
use crate::lift::Lift;
use crate::link::{Heights, Link};
use crate::modal::Feed;
use crate::outcome::{Done, Outcome};
use crate::program::Program;
use crate::rapid_planner::{RapidPlanner, Straight, Travel};
use crate::reason::Reason;
use crate::rounded::{Rounded, Rounding};
use crate::spelling::Spelling;
use crate::way_blocks::{Motions, edits, leaves_last};
use traverse_drawing::{ArcMotion, GcodeDialect, GcodeUnit, StraightMotion};
use traverse_geometry::{ArcOutput, CONTACT_TOLERANCE_MM, Path, Point};

/// How much more room ways are planned with, in last places: what rounding may use up.
pub(crate) const RESERVE_STEPS: f64 = 2.0;

/// Chords stand for arcs where arcs can't be fed, within this, millimetres.
const CHORD_TOLERANCE_MM: f64 = 0.05;

/// How a program is written.
#[derive(Clone, Debug, PartialEq)]
pub struct WriteOptions {
    /// How straight moves are written. Fed: every known rapid move becomes fed ones, for machines whose G0 does not run
    /// straight. Default: G0.
    pub straight: StraightMotion,
    /// How arcs are written. Default: as straight moves outside them, within 0.05 mm. Fed arcs become such moves where F
    /// can't be restored, and for Grbl while M3 or M4 is in force: a laser would burn.
    pub arcs: ArcMotion,
    /// Decimal places. Absent: as many as the program has, at least 3 in millimetres and 4 in inches.
    pub decimals: Option<u8>,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self {
            straight: StraightMotion::Rapid,
            arcs: ArcMotion::Chords { tolerance_mm: CHORD_TOLERANCE_MM },
            decimals: None,
        }
    }
}

/// A program, rewritten.
#[derive(Clone, Debug, PartialEq)]
pub struct Rewritten {
    /// Its text. Byte for byte what it was where nothing needed to change.
    pub text: Vec<u8>,
    /// What became of every link, in the order of [`Program::links`].
    pub outcomes: Vec<Outcome>,
}

/// Replaces the rapid moves of `program` by the shortest ways that `planner` knows.
#[must_use]
pub fn rewrite(program: &Program<'_>, planner: &dyn RapidPlanner, options: &WriteOptions) -> Rewritten {
    let mut all = Vec::new();
    let outcomes = program.links.iter().map(|link| {
        let (outcome, changes) = Linking { program, planner, options, link }.outcome();
        all.extend(changes);
        outcome
    });
    let outcomes = outcomes.collect();
    Rewritten { text: apply(program.bytes, &all), outcomes }
}

/// One link on its way into the new text.
pub(crate) struct Linking<'a> {
    pub(crate) program: &'a Program<'a>,
    pub(crate) planner: &'a dyn RapidPlanner,
    pub(crate) options: &'a WriteOptions,
    pub(crate) link: &'a Link,
}

impl Linking<'_> {
    fn outcome(&self) -> (Outcome, Vec<Edit>) {
        let before = self.link.path();
        let before_mm = before.length();
        let travel = self.travel();
        let mut outcome = Outcome {
            before: before.clone(),
            before_mm,
            after_mm: before_mm,
            fed_mm: 0.0,
            hits: Vec::new(),
            done: Done::Unchanged,
        };
        if before_mm > 0.0 {
            match self.planner.look(&travel, &before) {
                Ok(found) => outcome.hits = found.hits,
                Err(reason) => return (Outcome { done: Done::Left(reason), ..outcome }, Vec::new()),
            }
        }
        let fed = self.options.straight != StraightMotion::Rapid;
        let lift = Lift::of(self.link).filter(|_| before_mm > 0.0 && !fed && self.planner.knows_heights());
        if let Some(lift) = lift {
            outcome.before = lift.path(&before, lift.level_z);
            outcome.before_mm = outcome.before.length();
            outcome.after_mm = outcome.before_mm;
            match self.lifted(&lift, &outcome) {
                Ok(Some(rewrite)) => return rewrite,
                Ok(None) => return (outcome, Vec::new()),
                Err(Reason::Interrupted) => {
                    return (Outcome { done: Done::Left(Reason::Interrupted), ..outcome }, Vec::new());
                }
                // What can't be planned with heights may be in the plane.
                Err(_) => {}
            }
        }
        if before_mm == 0.0 || (self.link.blocks.len() == 1 && outcome.hits.is_empty() && !fed) {
            return (outcome, Vec::new());
        }
        if let Some(reason) = &self.link.fixed {
            if !outcome.hits.is_empty() {
                outcome.done = Done::Left(reason.clone());
            }
            return (outcome, Vec::new());
        }
        match self.changed(&travel, &outcome) {
            Ok(None) => (outcome, Vec::new()),
            Ok(Some((rounded, changes))) => {
                let path = match lift {
                    Some(lift) => lift.path(&rounded.path, lift.level_z),
                    None => rounded.path,
                };
                outcome.after_mm = path.length();
                outcome.fed_mm = if fed { outcome.after_mm } else { rounded.fed_mm };
                outcome.done = Done::Changed(path);
                (outcome, changes)
            }
            Err(reason) => {
                if !outcome.hits.is_empty() || fed || reason == Reason::Interrupted {
                    outcome.done = Done::Left(reason);
                }
                (outcome, Vec::new())
            }
        }
    }

    pub(crate) fn travel(&self) -> Travel {
        let link = self.link;
        Travel {
            from: link.from,
            to: link.to(),
            z: link.heights.lowest(),
            ends_z: None,
            tool: link.tool,
            tool_is_known: link.tool_is_known,
            straight: Straight::Rapid,
            arcs: ArcOutput::Arcs,
        }
    }

    /// The new way; none when the old one is as good.
    fn changed(&self, travel: &Travel, now: &Outcome) -> Result<Option<(Rounded, Vec<Edit>)>, Reason> {
        let fed = self.options.straight != StraightMotion::Rapid;
        let travel = Travel { straight: if fed { Straight::Fed } else { Straight::Rapid }, ..*travel };
        let mut straight = Path::at(travel.from);
        straight.line_to(travel.to);
        let direct = self.planner.look(&travel, &straight)?.is_free();
        let before = self.planner.cost(&self.link.path());
        let gains = |way: &Path| {
            !now.hits.is_empty() || fed || self.planner.cost(way) < before - self.planner.least_gain()
        };
        let (least, most) = self.places();
        for places in least..=most {
            let grid = self.grid(travel.from, places)?;
            for arcs in self.arc_motions() {
                let output = match arcs {
                    ArcMotion::Fed { .. } => ArcOutput::Arcs,
                    ArcMotion::Chords { .. } => ArcOutput::Chords,
                };
                let travel = Travel { arcs: output, ..travel };
                let way = if direct {
                    straight.clone()
                } else {
                    self.planner.shortest(&travel, RESERVE_STEPS * grid.step_mm())?
                };
                if !gains(&way) {
                    return Ok(None);
                }
                let rounded = self.rounding(grid, arcs)?.round(&way)?;
                if self.is_sound(&travel, &rounded, grid)? {
                    if !gains(&rounded.path) {
                        return Ok(None);
                    }
                    let spelling = self.spelling(places)?;
                    let motions = Motions { straight: self.options.straight, arcs };
                    let changes = edits(self.program, self.link, &rounded, &spelling, motions)?;
                    return Ok(Some((rounded, changes)));
                }
            }
        }
        Err(Reason::Rounding)
    }

    pub(crate) fn rounding(&self, grid: Grid, arcs: ArcMotion) -> Result<Rounding, Reason> {
        Ok(Rounding {
            grid,
            dialect: self.program.dialect,
            arcs,
            centers: self.link.before.centers.unwrap_or(Distance::Incremental),
            zero: self.zero()?,
            leaves_last: leaves_last(self.link, self.options.straight),
        })
    }

    pub(crate) fn spelling(&self, places: u8) -> Result<Spelling, Reason> {
        let Program { bytes, survey, dialect, .. } = self.program;
        Ok(Spelling::of(bytes, self.last_block()?, survey, *dialect, places))
    }

    pub(crate) fn last_block(&self) -> Result<&crate::link::RapidBlock, Reason> {
        self.link.blocks.last().ok_or(Reason::Rounding)
    }

    /// Whether the rounded way keeps the clearance, and comes to where the last block relies on being.
    fn is_sound(&self, travel: &Travel, rounded: &Rounded, grid: Grid) -> Result<bool, Reason> {
        let arrives = self.arrives(travel, rounded, grid);
        Ok(self.keeps_clear(travel, &rounded.path, rounded.off_mm)? && arrives)
    }

    /// Whether a way that may run beside `path` by so much keeps the clearance.
    pub(crate) fn keeps_clear(&self, travel: &Travel, path: &Path, off_mm: f64) -> Result<bool, Reason> {
        let found = self.planner.look(travel, path)?;
        let room = found.margin_mm.is_none_or(|margin| margin >= off_mm - CONTACT_TOLERANCE_MM);
        Ok(found.is_free() && (room || off_mm == 0.0))
    }

    /// Whether the rounded way comes to where the last block relies on being.
    pub(crate) fn arrives(&self, travel: &Travel, rounded: &Rounded, grid: Grid) -> bool {
        let arrives = rounded.moves.last().is_none_or(|last| {
            let Some(block) = self.link.blocks.last() else { return false };
            let short = grid.point(last.end) - travel.to;
            let absolute = block.distance == Distance::Absolute;
            let carries =
                |word: usize, short: f64| (absolute && block.words[word].is_some()) || short.abs() < 1e-9;
            carries(0, short.x) && carries(1, short.y)
        });
        arrives && (!rounded.moves.is_empty() || leaves_last(self.link, self.options.straight))
    }

    /// Fed arcs where they are asked for and can be taken back, then chords.
    pub(crate) fn arc_motions(&self) -> Vec<ArcMotion> {
        let before = &self.link.before;
        let chords = ArcMotion::Chords { tolerance_mm: CHORD_TOLERANCE_MM };
        let feed_returns = match before.feed {
            Feed::Unset => true,
            Feed::Stands { unit, .. } => unit.is_some() && unit == before.unit,
            Feed::Unknown => false,
        };
        let may_be_laser = self.program.dialect == GcodeDialect::Grbl && before.spindle != Some(false);
        let can_feed = feed_returns
            && !may_be_laser
            && before.feed_mode == Some(94)
            && before.plane.is_some()
            && before.centers.is_some();
        match self.options.arcs {
            ArcMotion::Fed { .. } if can_feed => vec![self.options.arcs, chords],
            ArcMotion::Fed { .. } => vec![chords],
            ArcMotion::Chords { .. } => vec![self.options.arcs],
        }
    }

    /// The decimal places that are tried.
    pub(crate) fn places(&self) -> (u8, u8) {
        let unit = self.link.before.unit.unwrap_or_default();
        let most = self.program.dialect.most_decimals(unit);
        let usual = self.program.dialect.usual_decimals(unit);
        let own = self.program.survey.places[usize::from(unit == GcodeUnit::Inches)].max(usual);
        self.options.decimals.map_or((own, own.max(most)), |asked| (asked, asked))
    }

    pub(crate) fn grid(&self, from: Point, places: u8) -> Result<Grid, Reason> {
        let before = &self.link.before;
        let unit = before.unit.ok_or_else(not_known)?;
        let origin = match before.distance.ok_or_else(not_known)? {
            Distance::Absolute => self.zero()?,
            Distance::Incremental => from,
        };
        // What a controller of that dialect reads to the last place.
        let largest = match self.program.dialect {
            GcodeDialect::LinuxCnc => 1e12,
            GcodeDialect::Grbl => f64::from(1 << 23),
            GcodeDialect::Fanuc => 99_999_999.0,
        };
        if let Heights::Sloped { .. } = self.link.heights
            && before.distance != Some(Distance::Absolute)
        {
            return Err(Reason::SlopedIncrements);
        }
        Ok(Grid { unit, places, origin, largest })
    }

    fn zero(&self) -> Result<Point, Reason> {
        self.link.before.origin.map(Point::from).ok_or_else(not_known)
    }
}

fn not_known() -> Reason {
    Reason::Refused("what is in force before it is not known".to_owned())
}
