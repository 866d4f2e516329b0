//! Sections of a cutting layout: from drawings, and from part sets by a simple block builder.

mod blocks;
mod from_drawing;
mod part_set;

pub use blocks::{BlockRules, build_blocks};
pub use from_drawing::{
    SectionOptions, SectionsBy, SectionsError, SectionsFromDrawing, sections_from_drawing,
};
pub use part_set::{PartSet, PartSetError, Piece, read_part_set};
