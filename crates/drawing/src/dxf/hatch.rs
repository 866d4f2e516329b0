//! HATCH: a filling.
//!
//! A filling itself is nothing that a machine meets, but its border may be, and a program may have deleted the curves
//! that it was made from. It is let go only when the file proves that its whole border is drawn: it is associative, and
//! each of its border paths names curves that stand in the same block on the same layer.

use super::blocks::Block;
use super::entity::Kind;
use super::record::Record;
use crate::{ReadError, WhyUnused};
use std::collections::HashMap;
use std::num::NonZeroU64;

/// What a filling says of its border.
#[derive(Debug, Default)]
pub(super) struct Hatch {
    /// Whether it follows its border when that is changed.
    associative: bool,
    /// Whether every path of its border names a curve.
    all_paths_named: bool,
    /// Handles of the curves of its border.
    border: Vec<NonZeroU64>,
}

/// Reads a HATCH. Nothing in it can be malformed: it is not drawn.
pub(super) fn read_hatch(record: &mut Record<'_, '_>) -> Result<Hatch, ReadError> {
    let mut hatch = Hatch { all_paths_named: true, ..Hatch::default() };
    // Handles of the path that is being read; none outside of paths.
    let mut path: Option<usize> = None;
    while let Some(group) = record.next_group()? {
        match group.code {
            71 if path.is_none() => hatch.associative |= group.integer().is_ok_and(|flag| flag == 1),
            // 92 begins a path, 75 follows the last one.
            75 | 92 => {
                let is_path = group.code == 92;
                hatch.all_paths_named &= path != Some(0) && (is_path || path.is_some());
                path = is_path.then_some(0);
            }
            330 => {
                if let Some(count) = &mut path {
                    *count += 1;
                    hatch.border.extend(group.handle());
                }
            }
            _ => {}
        }
    }
    hatch.all_paths_named &= path != Some(0);
    Ok(hatch)
}

/// Finds for every filling of a block whether its border is drawn in it too.
pub(super) fn settle_hatches(block: &mut Block) {
    if !block.entities.iter().any(|entity| matches!(entity.kind, Kind::Hatch(_))) {
        return;
    }
    let shapes = block.entities.iter().filter(|entity| matches!(entity.kind, Kind::Shape(..)));
    let drawn: HashMap<_, _> = shapes.filter_map(|entity| Some((entity.handle?, entity.layer))).collect();
    for entity in &mut block.entities {
        let Kind::Hatch(hatch) = &entity.kind else { continue };
        let is_drawn = hatch.associative
            && hatch.all_paths_named
            && !hatch.border.is_empty()
            && hatch.border.iter().all(|handle| drawn.get(handle) == Some(&entity.layer));
        let why = if is_drawn { WhyUnused::Filling } else { WhyUnused::Type };
        entity.kind = Kind::Unused("HATCH".into(), why);
    }
}
