//! INSERT: a block drawn at a place, or at the places of an array.

use super::affine::Affine;
use super::blocks::{BlockId, Blocks};
use super::record::{Facing, Record};
use super::text::TextCoding;
use crate::{ReadError, WhyUnused};
use traverse_geometry::{Point, Vector};

/// A block drawn at a place, or at the places of an array.
#[derive(Clone, Debug)]
pub(super) struct Insert {
    /// Which block.
    pub(super) block: BlockId,
    /// How many columns and rows, at least one each.
    counts: [u64; 2],
    /// From column to column and from row to row, before turning.
    spacings: Vector,
    /// Where the base point comes to lie.
    place: Point,
    scale: Vector,
    rotation_deg: f64,
    facing: Facing,
}

impl Insert {
    /// How often the block is drawn.
    pub(super) fn copies(&self) -> u64 {
        self.counts[0].saturating_mul(self.counts[1])
    }

    /// Where the block's coordinates come to lie in that copy, counted row by row from 0 on.
    pub(super) fn placement(&self, copy: u64, base: Point) -> Affine {
        let (column, row) = (copy % self.counts[0], copy / self.counts[0]);
        let step = Vector::new(self.spacings.x * column as f64, self.spacings.y * row as f64);
        let seen_from = if self.facing == Facing::Down { -1.0 } else { 1.0 };
        Affine::scaling(seen_from, 1.0)
            .after(&Affine::shift(self.place.coords))
            .after(&Affine::rotation_deg(self.rotation_deg))
            .after(&Affine::shift(step))
            .after(&Affine::scaling(self.scale.x, self.scale.y))
            .after(&Affine::shift(-base.coords))
    }

    /// The same in a plane that faces so.
    pub(super) fn facing(self, facing: Facing) -> Self {
        Self { facing, ..self }
    }
}

/// Reads an INSERT; its ATTRIB entities come after it and are entities of their own.
pub(super) fn read_insert(
    record: &mut Record<'_, '_>,
    blocks: &mut Blocks,
    coding: TextCoding,
) -> Result<Result<Insert, WhyUnused>, ReadError> {
    let mut name = None;
    let (mut place, mut scale, mut spacings) = (Point::origin(), Vector::repeat(1.0), Vector::zeros());
    let (mut rotation_deg, mut counts) = (0.0, [1, 1]);
    while let Some(group) = record.next_group()? {
        match group.code {
            2 => name = Some(group.value),
            10 => place.x = group.real()?,
            20 => place.y = group.real()?,
            41 => scale.x = group.real()?,
            42 => scale.y = group.real()?,
            44 => spacings.x = group.real()?,
            45 => spacings.y = group.real()?,
            50 => rotation_deg = group.real()?,
            70 => counts[0] = group.integer()?.max(1).unsigned_abs(),
            71 => counts[1] = group.integer()?.max(1).unsigned_abs(),
            _ => {}
        }
    }
    let Some(name) = name else { return Ok(Err(WhyUnused::UnknownBlock)) };
    if scale.x == 0.0 || scale.y == 0.0 {
        return Ok(Err(WhyUnused::NoLength));
    }
    let block = blocks.id_of(&coding.decode(name));
    Ok(Ok(Insert { block, counts, spacings, place, scale, rotation_deg, facing: Facing::Up }))
}
