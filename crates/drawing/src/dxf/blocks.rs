//! Blocks of a file, and the model itself.

use super::entity::Entity;
use std::collections::HashMap;
use traverse_geometry::Point;

/// A block by its place in [`Blocks`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct BlockId(usize);

/// The model, as if it were a block.
pub(super) const MODEL: BlockId = BlockId(0);

/// Entities that are drawn together.
#[derive(Debug)]
pub(super) struct Block {
    /// As its definition writes it.
    pub(super) name: String,
    /// The point that an INSERT places.
    pub(super) base: Point,
    /// In file order.
    pub(super) entities: Vec<Entity>,
    /// Whether the file holds it to be inserted; it is only spoken of otherwise, or lies in another file.
    pub(super) known: bool,
}

/// Blocks by name, upper and lower case alike.
#[derive(Debug)]
pub(super) struct Blocks {
    list: Vec<Block>,
    by_name: HashMap<String, BlockId>,
}

impl Default for Blocks {
    /// The model only.
    fn default() -> Self {
        Self { list: vec![Block::new("")], by_name: HashMap::new() }
    }
}

impl Block {
    fn new(name: &str) -> Self {
        Self { name: name.to_owned(), base: Point::origin(), entities: Vec::new(), known: false }
    }
}

impl Blocks {
    /// The block of that name, which may come later in the file.
    pub(super) fn id_of(&mut self, name: &str) -> BlockId {
        let next = BlockId(self.list.len());
        let id = *self.by_name.entry(name.to_lowercase()).or_insert(next);
        if id == next {
            self.list.push(Block::new(name));
        }
        id
    }

    /// The block.
    pub(super) fn get(&self, id: BlockId) -> &Block {
        &self.list[id.0]
    }

    /// The block, to be changed.
    pub(super) fn get_mut(&mut self, id: BlockId) -> &mut Block {
        &mut self.list[id.0]
    }

    /// All blocks, the model first.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Block> {
        self.list.iter_mut()
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.list.len()
    }
}

impl BlockId {
    /// Its place among all blocks.
    pub(super) fn index(self) -> usize {
        self.0
    }
}
