//! The beginning of a layout: what is placed, seen by what of it matters to what is left.

/// The beginning of a layout.
#[derive(Debug)]
pub(crate) struct Beginning {
    pub(crate) before: u32,
    pub(crate) item: u32,
    /// What is left.
    pub(crate) state: usize,
    /// Of it, the part whose chain bounds best as far as is known.
    pub(crate) part: usize,
    /// Whether changes of the part have been tried.
    pub(crate) tightened: bool,
    /// Whether another is as good throughout.
    pub(crate) dropped: bool,
    pub(crate) end: i64,
    /// Where each item would stand next.
    pub(crate) next: Box<[i64]>,
    /// How far right everything placed reaches at some heights; with the free rule only.
    pub(crate) front: Box<[i64]>,
}
