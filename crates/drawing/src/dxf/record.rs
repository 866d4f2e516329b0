//! One record of a file, group by group: an entity, a block's head or a layer.

use super::aci::color_of_index;
use super::groups::{Group, Groups};
use crate::{Color, ReadError};
use std::num::NonZeroU64;

/// Components of a unit normal below this are rounding.
const NORMAL_TOLERANCE: f64 = 1e-9;

/// What every entity may say.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head<'a> {
    /// Its layer's name as in the file.
    pub(super) layer: &'a [u8],
    /// Its handle.
    pub(super) handle: Option<NonZeroU64>,
    /// Its colour.
    pub(super) color: ColorRule,
    /// Whether it is on a layout sheet.
    pub(super) paper_space: bool,
    /// Its extrusion direction.
    normal: [f64; 3],
}

/// Where an entity's colour comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ColorRule {
    /// From its layer.
    #[default]
    ByLayer,
    /// From the INSERT that it is drawn by.
    ByBlock,
    /// Its own; none when the number stands for no colour.
    Own(Option<Color>),
}

/// How an entity's own coordinates lie in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    /// Extrusion +Z: as they are.
    Up,
    /// Extrusion −Z: x runs to the left.
    Down,
    /// Any other: not in the plane.
    Aside,
}

/// The groups of one record.
#[derive(Debug)]
pub(super) struct Record<'r, 'a> {
    groups: &'r mut Groups<'a>,
    layer: Option<&'a [u8]>,
    handle: Option<NonZeroU64>,
    color_index: Option<i64>,
    true_color: Option<i64>,
    paper_space: bool,
    normal: [f64; 3],
}

impl<'r, 'a> Record<'r, 'a> {
    /// The record whose first group was read last.
    pub(super) fn new(groups: &'r mut Groups<'a>) -> Self {
        Self {
            groups,
            layer: None,
            handle: None,
            color_index: None,
            true_color: None,
            paper_space: false,
            normal: [0.0, 0.0, 1.0],
        }
    }

    /// The next group; none at the end of the record. What every entity may say is noted on the way. Groups that
    /// programs add between 102/{ and 102/} are passed over.
    pub(super) fn next_group(&mut self) -> Result<Option<Group<'a>>, ReadError> {
        let Some(mut group) = self.groups.next_in_record()? else { return Ok(None) };
        while group.code == 102 && group.value.starts_with(b"{") {
            while !(group.code == 102 && group.value == b"}") {
                let Some(next) = self.groups.next_in_record()? else { return Ok(None) };
                group = next;
            }
            let Some(next) = self.groups.next_in_record()? else { return Ok(None) };
            group = next;
        }
        match group.code {
            5 => self.handle = self.handle.or(group.handle()),
            8 => self.layer = self.layer.or(Some(group.value)),
            62 => self.color_index = self.color_index.or(group.integer().ok()),
            67 => self.paper_space |= group.integer().is_ok_and(|flag| flag == 1),
            // What is no number is no direction.
            210 => self.normal[0] = group.real().unwrap_or(f64::NAN),
            220 => self.normal[1] = group.real().unwrap_or(f64::NAN),
            230 => self.normal[2] = group.real().unwrap_or(f64::NAN),
            420 => self.true_color = self.true_color.or(group.integer().ok()),
            _ => {}
        }
        Ok(Some(group))
    }

    /// Passes over the rest of the record; says what every entity may say.
    pub(super) fn finish(mut self) -> Result<Head<'a>, ReadError> {
        while self.next_group()?.is_some() {}
        Ok(Head {
            layer: self.layer.unwrap_or(b"0"),
            handle: self.handle,
            color: color_rule(self.color_index, self.true_color),
            paper_space: self.paper_space,
            normal: self.normal,
        })
    }

    /// As [`Record::finish`], with the VERTEX records that follow, up to SEQEND.
    pub(super) fn finish_with(
        self,
        mut vertex: impl FnMut(Record<'_, 'a>) -> Result<(), ReadError>,
    ) -> Result<Head<'a>, ReadError> {
        let Self { groups, .. } = self;
        let head = Record { groups: &mut *groups, ..self }.finish()?;
        loop {
            let next = groups.next_group()?;
            if next.opens("VERTEX") {
                vertex(Record::new(groups))?;
            } else {
                if next.opens("SEQEND") {
                    Record::new(groups).finish()?;
                } else {
                    groups.put_back(next);
                }
                return Ok(head);
            }
        }
    }
}

impl Head<'_> {
    /// How the entity's coordinates lie.
    pub(super) fn facing(&self) -> Facing {
        let [x, y, z] = self.normal;
        if x.abs() <= NORMAL_TOLERANCE && y.abs() <= NORMAL_TOLERANCE {
            if z > 0.0 {
                return Facing::Up;
            } else if z < 0.0 {
                return Facing::Down;
            }
        }
        Facing::Aside
    }
}

/// A true colour goes before a number.
fn color_rule(index: Option<i64>, true_color: Option<i64>) -> ColorRule {
    if let Some(rgb) = true_color {
        let [.., red, green, blue] = rgb.to_be_bytes();
        return ColorRule::Own(Some(Color { red, green, blue }));
    }
    match index {
        None | Some(256) => ColorRule::ByLayer,
        Some(0) => ColorRule::ByBlock,
        // A layer that is switched off has a negative number.
        Some(index) => ColorRule::Own(color_of_index(index.saturating_abs())),
    }
}
