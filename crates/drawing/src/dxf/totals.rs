//! What a drawing comes to when its blocks are drawn out, counted before any of it is.
//!
//! Blocks may be nested and repeated: a few lines of text can stand for 10¹⁸ entities. Every block is counted once,
//! innermost first. Cost: linear in the entities of the file; no recursion, so any depth will do.

use super::blocks::{BlockId, Blocks, MODEL};
use super::entity::Kind;
use crate::{ReadError, ReadOptions};

/// What a block comes to. Numbers end at the largest one.
#[derive(Clone, Copy, Debug, Default)]
struct Total {
    /// Entities of all types, with one more for every block that is drawn.
    entities: u64,
    /// Vertices at least: curves that arcs are fitted to may take more.
    vertices: u64,
}

#[derive(Clone, Copy, Debug)]
enum State {
    NotSeen,
    /// Being counted: it holds what is counted now.
    Open,
    Counted(Total),
}

/// So many names of a ring of blocks are shown.
const SHOWN_NAMES: usize = 8;

impl Total {
    fn add(&mut self, other: Self, times: u64) {
        self.entities = self.entities.saturating_add(other.entities.saturating_mul(times));
        self.vertices = self.vertices.saturating_add(other.vertices.saturating_mul(times));
    }
}

/// Refuses what comes to more than the options allow, and blocks that hold themselves.
pub(super) fn check_totals(blocks: &Blocks, options: &ReadOptions) -> Result<(), ReadError> {
    let mut states = vec![State::NotSeen; blocks.count()];
    let mut open = vec![(MODEL, 0, Total::default())];
    while let Some((block, next, total)) = open.last_mut() {
        let Some(entity) = blocks.get(*block).entities.get(*next) else {
            states[block.index()] = State::Counted(*total);
            open.pop();
            continue;
        };
        match &entity.kind {
            Kind::Insert(insert) if blocks.get(insert.block).known => match states[insert.block.index()] {
                State::Counted(inside) => {
                    total.add(
                        Total { entities: inside.entities.saturating_add(1), ..inside },
                        insert.copies(),
                    );
                }
                State::NotSeen => {
                    states[insert.block.index()] = State::Open;
                    open.push((insert.block, 0, Total::default()));
                    continue;
                }
                State::Open => {
                    let ring = open.iter().map(|&(block, ..)| block);
                    return Err(cycle(blocks, ring.skip_while(|&block| block != insert.block).collect()));
                }
            },
            Kind::Shape(_, shape) => {
                total.add(Total { entities: 1, vertices: shape.vertex_count() as u64 }, 1);
            }
            _ => total.add(Total { entities: 1, vertices: 0 }, 1),
        }
        *next += 1;
    }
    let State::Counted(total) = states[MODEL.index()] else { return Ok(()) };
    if total.entities > options.entity_limit as u64 {
        return Err(ReadError::TooManyEntities { limit: options.entity_limit });
    }
    if total.vertices > options.vertex_limit as u64 {
        return Err(ReadError::TooManyVertices { limit: options.vertex_limit });
    }
    Ok(())
}

fn cycle(blocks: &Blocks, mut ring: Vec<BlockId>) -> ReadError {
    ring.extend(ring.first().copied());
    let mut names: Vec<String> = ring.iter().map(|&block| blocks.get(block).name.clone()).collect();
    if names.len() > SHOWN_NAMES {
        let half = SHOWN_NAMES / 2;
        names.splice(half..names.len() - half, ["…".to_owned()]);
    }
    ReadError::BlockCycle { blocks: names }
}
