//! Rising before a link and sinking behind it: what makes a link, its retract and its plunge one move with heights.

use crate::codes::Distance;
use crate::link::{Heights, Link, RapidBlock};
use traverse_geometry::Path;

/// A rapid move along Z alone, written absolutely, its height before and behind known.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Vertical {
    pub(crate) block: RapidBlock,
    pub(crate) from_z: f64,
    pub(crate) to_z: f64,
    /// Whether its number may be changed: no comment protects it.
    pub(crate) is_free: bool,
}

/// Heights of a run: where it begins, travels and ends, in the program's coordinates, millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lift<'a> {
    pub(crate) from_z: f64,
    pub(crate) level_z: f64,
    pub(crate) to_z: f64,
    /// The block that rises, if there is one that may be changed.
    pub(crate) retract: Option<&'a Vertical>,
    /// Whether there is a block that sinks: it stays as it is, from whatever height.
    pub(crate) sinks: bool,
}

impl<'a> Lift<'a> {
    /// None: the link must stay, is not level, or its numbers are increments.
    pub(crate) fn of(link: &'a Link) -> Option<Self> {
        let Heights::Level(Some(level_z)) = link.heights else { return None };
        let last = link.blocks.last()?;
        let before = &link.before;
        let is_plain = |block: &RapidBlock| {
            block.distance == Distance::Absolute && block.words[2].is_none() && block.unit == before.unit
        };
        let can_change = link.fixed.is_none()
            && before.unit.is_some()
            && before.distance == Some(Distance::Absolute)
            && last.unit == before.unit
            && link.blocks.iter().all(is_plain);
        if !can_change {
            return None;
        }
        let retract = link.retract.as_ref().filter(|retract| {
            retract.is_free && retract.block.unit == before.unit && retract.to_z.total_cmp(&level_z).is_eq()
        });
        let plunge = link.plunge.as_ref().filter(|plunge| plunge.from_z.total_cmp(&level_z).is_eq());
        Some(Self {
            from_z: retract.map_or(level_z, |retract| retract.from_z),
            level_z,
            to_z: plunge.map_or(level_z, |plunge| plunge.to_z),
            retract,
            sinks: plunge.is_some(),
        })
    }

    /// `way`, seen from above, at a height: up to it, along it and down from it.
    pub(crate) fn path(&self, way: &Path, level_z: f64) -> Path {
        let mut path = Path::at_height(way.start, self.from_z);
        path.height_to(level_z);
        path.append(&way.clone().at_level(level_z));
        path.height_to(self.to_z);
        path
    }
}
