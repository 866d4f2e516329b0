//! What a move must keep away from: one edge and the distance asked for it.

use traverse_geometry::Edge;

/// An edge that no move may come nearer to than `limit`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocker {
    /// The edge, material on its left.
    pub(crate) edge: Edge,
    /// A move nearer than this collides, millimetres, positive: half a contact tolerance less than asked for.
    pub(crate) limit: f64,
    /// Whose barrier it belongs to: see [`crate::barriers`].
    pub(crate) owner: usize,
}

impl Blocker {
    /// Whether the straight or circular move `piece` comes too near.
    pub(crate) fn blocks(&self, piece: &Edge) -> bool {
        self.edge.distance(piece) < self.limit
    }
}
