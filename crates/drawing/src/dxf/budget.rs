//! How many vertices may still be kept.

use crate::ReadError;

/// Vertices that may still be kept of those that the options allow.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexBudget {
    left: usize,
    limit: usize,
}

impl VertexBudget {
    /// So many.
    pub(super) fn new(limit: usize) -> Self {
        Self { left: limit, limit }
    }

    /// So many are left.
    pub(super) fn left(&self) -> usize {
        self.left
    }

    /// Takes so many.
    pub(super) fn take(&mut self, count: usize) -> Result<(), ReadError> {
        self.left = self.left.checked_sub(count).ok_or(self.exceeded())?;
        Ok(())
    }

    /// What is said when they don't suffice.
    pub(super) fn exceeded(&self) -> ReadError {
        ReadError::TooManyVertices { limit: self.limit }
    }
}
