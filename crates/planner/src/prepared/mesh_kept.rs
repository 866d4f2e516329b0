//! When a prepared scene has a mesh: after so many queries without an edit that one pays, until too much was added.

use super::mesh::Mesh;
use super::terrain::Terrain;
use crate::barriers::Barriers;
use std::ops::Range;
use traverse_solve::{Budget, Interrupt};

/// A mesh is made after so many queries without an edit: about what one costs by then.
const QUERIES_BEFORE_MESH: u32 = 64;

/// The share of a query's time that may go to a mesh; when it does not suffice, one is tried for after twice as many queries.
const SHARE_FOR_MESH: f64 = 0.25;

/// A mesh, or how far it is from being made.
#[derive(Default)]
pub(super) struct MeshKept {
    mesh: Option<Mesh>,
    /// There were edits since it was made.
    is_old: bool,
    /// Queries since the last edit.
    queries: u32,
    /// How often since then a mesh was tried for in vain, for want of time.
    tries: u32,
}

impl MeshKept {
    /// The mesh, if there is one.
    pub(super) fn get(&self) -> Option<&Mesh> {
        self.mesh.as_ref()
    }

    /// Takes note of features that were added.
    pub(super) fn note_added(&mut self, features: Range<usize>) {
        self.note_edit();
        if self.mesh.as_mut().is_some_and(|mesh| !mesh.add(features)) {
            self.mesh = None;
        }
    }

    /// Takes note of any other change.
    pub(super) fn note_edit(&mut self) {
        self.is_old = true;
        (self.queries, self.tries) = (0, 0);
    }

    /// Takes note of a query, and makes a mesh when it is time, as far as a share of the query's own suffices.
    pub(super) fn note_query(&mut self, terrain: &Terrain, barriers: &Barriers<'_>, budget: &Budget) {
        if self.mesh.is_some() && !self.is_old {
            return;
        }
        self.queries = self.queries.saturating_add(1);
        // Where none can be made, none is tried for until the next edit.
        let is_due = Some(self.queries) == QUERIES_BEFORE_MESH.checked_shl(self.tries);
        if is_due && self.make(terrain, barriers, &budget.share(SHARE_FOR_MESH, 0)).is_err() {
            self.tries += 1;
        }
    }

    /// Makes a mesh, where the scene is for one.
    ///
    /// # Errors
    /// The budget ended; the mesh is as it was.
    pub(super) fn make(
        &mut self,
        terrain: &Terrain,
        barriers: &Barriers<'_>,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        self.mesh = Mesh::of(terrain, barriers, budget)?;
        self.is_old = self.mesh.is_none();
        Ok(())
    }
}
