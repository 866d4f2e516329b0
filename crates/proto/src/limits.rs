//! How large a request may be.

/// How large a request may be. Told by GetLimits, explained in docs/limits.md, checked before anything costly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest request and largest answer, bytes, in the encoding that the caller uses.
    pub message_bytes: usize,
    /// Most vertices of one request, work area and holes included.
    pub vertex_count: usize,
    /// Most obstacles of one request.
    pub obstacle_count: usize,
    /// Most steps of a path to check.
    pub step_count: usize,
    /// Most sections of one layout, every copy counted.
    pub section_count: usize,
    /// Most parts of all sections of one request, copies not counted; and most placed parts of one answer.
    pub part_count: usize,
    /// Most entries of a matrix of effects that is answered.
    pub join_count: usize,
}

/// Longest id of an obstacle, a section or a part, bytes.
pub(crate) const ID_BYTES: usize = 256;

impl Default for Limits {
    fn default() -> Self {
        Self {
            message_bytes: 16 * 1024 * 1024,
            vertex_count: 250_000,
            obstacle_count: 50_000,
            step_count: 50_000,
            section_count: 20_000,
            part_count: 50_000,
            join_count: 400_000,
        }
    }
}

impl Limits {
    /// Most precedences, and most forbidden joins, of one request: one for each section.
    pub(crate) fn rule_count(&self) -> usize {
        self.section_count
    }
}
