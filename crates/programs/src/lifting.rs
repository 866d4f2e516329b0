//! Plans a link with its retract and plunge as one move with heights, and writes it back: the retract's number, the
//! travel, and where the program has none a retract or a plunge of its own.

use crate::edit::Edit;
use crate::grid::Grid;
use crate::lift::Lift;
use crate::outcome::{Done, Outcome};
use crate::rapid_planner::Travel;
use crate::reason::Reason;
use crate::rewrite::{Linking, RESERVE_STEPS};
use crate::rounded::Rounded;
use crate::spelling::Spelling;
use crate::way_blocks::{Motions, edits};
use traverse_drawing::{ArcMotion, StraightMotion};
use traverse_geometry::{ArcOutput, Path};

/// Heights and places that differ by less are the same, millimetres.
const SAME_MM: f64 = 1e-9;

/// So much of a last place counts as rounding of doubles when a height is rounded up.
const SLACK_STEPS: f64 = 1e-6;

/// Outcome and edits of a link.
pub(crate) type Rewrite = (Outcome, Vec<Edit>);

impl Linking<'_> {
    /// The run at its best heights; none when it is as good already.
    ///
    /// # Errors
    /// Why no way with heights is known: then the link alone is looked at.
    pub(crate) fn lifted(&self, lift: &Lift<'_>, now: &Outcome) -> Result<Option<Rewrite>, Reason> {
        let link = self.link;
        let travel = Travel {
            z: Some(lift.from_z.min(lift.to_z)),
            ends_z: Some([lift.from_z, lift.to_z]),
            ..self.travel()
        };
        let before = self.planner.cost(&now.before);
        let gains =
            |way: &Path| !now.hits.is_empty() || self.planner.cost(way) < before - self.planner.least_gain();
        let (least, most) = self.places();
        for places in least..=most {
            let grid = self.grid(link.from, places)?;
            for arcs in self.arc_motions() {
                let output = match arcs {
                    ArcMotion::Fed { .. } => ArcOutput::Arcs,
                    ArcMotion::Chords { .. } => ArcOutput::Chords,
                };
                let travel = Travel { arcs: output, ..travel };
                let way = self.planner.shortest(&travel, RESERVE_STEPS * grid.step_mm())?;
                if !gains(&way) {
                    return Ok(None);
                }
                let level_z = lift.written_level(grid, &way);
                let stays = self.stays(lift, &way, level_z);
                let rounded = if stays {
                    let path = link.path();
                    Rounded { moves: Vec::new(), path, off_mm: 0.0, fed_mm: 0.0 }
                } else {
                    self.rounding(grid, arcs)?.round(&way.in_plane())?
                };
                let path = lift.path(&rounded.path, level_z);
                let arrives = stays || self.arrives(&travel, &rounded, grid);
                if !arrives || !self.keeps_clear(&travel, &path, rounded.off_mm)? {
                    continue;
                }
                if !gains(&path) {
                    return Ok(None);
                }
                let spelling = self.spelling(places)?;
                let mut changes = self.heights(lift, grid, level_z, &spelling)?;
                if !stays {
                    let motions = Motions { straight: StraightMotion::Rapid, arcs };
                    changes.extend(edits(self.program, link, &rounded, &spelling, motions)?);
                }
                // A retract of its own stands before the travel, which is inserted at the same place.
                changes.sort_by_key(|change| change.range.start);
                let outcome = Outcome {
                    after_mm: path.length(),
                    fed_mm: rounded.fed_mm,
                    done: Done::Changed(path),
                    ..now.clone()
                };
                return Ok(Some((outcome, changes)));
            }
        }
        Err(Reason::Rounding)
    }

    /// Whether the travel is the program's own seen from above, and a retract of its own can stand before all of it.
    fn stays(&self, lift: &Lift<'_>, way: &Path, level_z: f64) -> bool {
        let (way, own) = (way.in_plane(), self.link.path());
        let inserts = lift.retract.is_none() && level_z > lift.from_z;
        let same = |(a, b): (&traverse_geometry::PathStep, &traverse_geometry::PathStep)| {
            a.arc.is_none() && b.arc.is_none() && (a.end - b.end).norm() < SAME_MM
        };
        (self.link.blocks.len() == 1 || !inserts)
            && way.steps.len() == own.steps.len()
            && way.steps.iter().zip(&own.steps).all(same)
    }

    /// The edits that bring the travel to its height, and from it to where the run ends.
    fn heights(
        &self,
        lift: &Lift<'_>,
        grid: Grid,
        level_z: f64,
        spelling: &Spelling,
    ) -> Result<Vec<Edit>, Reason> {
        let last = self.last_block()?;
        let word = |z: f64| -> Result<String, Reason> {
            let count = grid.level(z).filter(|count| (grid.level_mm(*count) - z).abs() < SAME_MM);
            Ok(spelling.number(count.ok_or(Reason::Rounding)?))
        };
        let line = |z: f64| -> Result<Vec<u8>, Reason> {
            let mut text = Vec::new();
            spelling.line(&[spelling.code(0), format!("Z{}", word(z)?)], &mut text);
            Ok(text)
        };
        let mut changes = Vec::new();
        match lift.retract.map(|retract| retract.block.words[2]) {
            _ if (level_z - lift.level_z).abs() < SAME_MM => {}
            Some(z) => {
                let z = z.ok_or(Reason::Rounding)?;
                changes.push(Edit {
                    range: z.number as usize..z.end as usize,
                    text: word(level_z)?.into_bytes(),
                });
            }
            None => {
                let at = last.start as usize;
                changes.push(Edit { range: at..at, text: line(level_z)? });
            }
        }
        if !lift.sinks && (level_z - lift.to_z).abs() >= SAME_MM {
            if last.end == last.next {
                return Err(Reason::Rounding);
            }
            let at = last.next as usize;
            changes.push(Edit { range: at..at, text: line(lift.to_z)? });
        }
        Ok(changes)
    }
}

impl Lift<'_> {
    /// The height at which `way` travels: as the program has it already, or on the grid, rounded up.
    fn written_level(&self, grid: Grid, way: &Path) -> f64 {
        let heights = way.steps.iter().filter_map(|step| step.z_mm);
        let level = heights.fold(self.from_z.max(self.to_z), f64::max);
        let known = |z: f64| (level - z).abs() < SAME_MM;
        if known(self.level_z) {
            return self.level_z;
        }
        (level / grid.step_mm() - SLACK_STEPS).ceil() * grid.step_mm()
    }
}
