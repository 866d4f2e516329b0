//! The part of what is left that makes the longest chain, for everything that may be left. Sections that leave heights
//! uncovered only shorten a chain: those around them meet, but the chain does not know.

use crate::completion::{Counts, NONE};

/// Of what is left, the part whose chain is longest, and how long: what is noted while a table is filled.
pub(crate) struct LongestParts {
    pub(crate) part: Vec<u32>,
    length: Vec<i32>,
}

impl LongestParts {
    pub(crate) fn new(size: usize) -> Self {
        Self { part: vec![0; size], length: vec![0; size] }
    }

    /// The least length of a chain through all of a state, or the longest through what one copy less has.
    pub(crate) fn note(&mut self, counts: &Counts, state: usize, whole: i32) {
        // What can't be completed is no chain to count on.
        let whole = if whole == NONE { i32::MIN } else { whole };
        let mut longest = (whole, state as u32);
        for kind in (0..counts.stride.len()).filter(|&kind| counts.left(state, kind) > 0) {
            let less = counts.without(state, kind);
            if self.length[less] > longest.0 {
                longest = (self.length[less], self.part[less]);
            }
        }
        (self.length[state], self.part[state]) = longest;
    }
}
