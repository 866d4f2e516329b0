//! Where the sections of the best layout stand, so that the answer need not place them again once the time is over.

/// A sequence of items with their left edges.
#[derive(Debug, Default)]
pub(crate) struct Places {
    items: Vec<usize>,
    left_edges: Vec<i64>,
}

impl Places {
    /// Keeps those of this sequence instead.
    pub(crate) fn keep(&mut self, items: &[usize], left_edges: &[i64]) {
        items.clone_into(&mut self.items);
        left_edges.clone_into(&mut self.left_edges);
    }

    /// The left edges of a sequence, if it is the one that was kept.
    pub(crate) fn of(&self, items: &[usize]) -> Option<&[i64]> {
        (self.items == items).then_some(self.left_edges.as_slice())
    }
}
