//! How much may be read, uses of elements counted each time.

use crate::{ReadError, ReadOptions};

/// What may still be read.
#[derive(Debug)]
pub(super) struct Budget {
    options: ReadOptions,
    elements: usize,
    vertices: usize,
    bytes: u64,
}

/// The text may be gone through this many times the byte limit: uses, and names of groups with each element.
const BYTES_SHARE: u64 = 2;

impl Budget {
    pub(super) fn new(options: &ReadOptions) -> Self {
        Self {
            options: *options,
            elements: options.entity_limit,
            vertices: options.vertex_limit,
            bytes: options.byte_limit.saturating_mul(BYTES_SHARE),
        }
    }

    /// One element more.
    pub(super) fn element(&mut self) -> Result<(), ReadError> {
        let limit = self.options.entity_limit;
        self.elements = self.elements.checked_sub(1).ok_or(ReadError::TooManyEntities { limit })?;
        Ok(())
    }

    /// So many vertices more.
    pub(super) fn vertices(&mut self, count: usize) -> Result<(), ReadError> {
        let limit = self.options.vertex_limit;
        self.vertices = self.vertices.checked_sub(count).ok_or(ReadError::TooManyVertices { limit })?;
        Ok(())
    }

    /// How many vertices may still come.
    pub(super) fn vertices_left(&self) -> usize {
        self.vertices
    }

    /// What to answer when more vertices would be needed than may still come.
    pub(super) fn too_many_vertices(&self) -> ReadError {
        ReadError::TooManyVertices { limit: self.options.vertex_limit }
    }

    /// So many bytes more that are gone through or copied.
    pub(super) fn bytes(&mut self, count: usize) -> Result<(), ReadError> {
        let limit = self.options.byte_limit;
        self.bytes = self.bytes.checked_sub(count as u64).ok_or(ReadError::TooMuchRepeated { limit })?;
        Ok(())
    }
}
